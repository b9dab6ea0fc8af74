#include "render/io/files.h"
#include "tests/load/temporary_folder.h"

#include <set>

#include <gtest/gtest.h>
#include <sys/wait.h>

namespace tessera::test {

namespace {

/// The number of a process that is no more.
pid_t ended_process() {
    const pid_t child = fork();
    if (child == 0)
        _exit(0);
    waitpid(child, nullptr, 0);
    return child;
}

TEST(TemporaryFile, RemovesWhatAKilledProcessLeftOfTheSameFile) {
    const TemporaryFolder folder;
    const std::string ended = std::to_string(ended_process()), living = std::to_string(getpid());
    folder.write("a.exr." + ended + "-7.tmp", "left");
    const std::set<std::string> others = {"a.exr", "a.exr." + living + "-700000.tmp", "b.exr." + ended + "-7.tmp",
                                          "a.exr." + ended + "-7.tmp.txt", "a.exr." + ended + ".tmp"};
    for (const std::string& name : others)
        folder.write(name, "another's");
    { const TemporaryFile file(folder.path() / "a.exr"); }
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        names.insert(entry.path().filename().string());
    EXPECT_EQ(names, others);
}

TEST(TemporaryFile, LookingWhetherAFileCanBeWrittenTouchesNoOther) {
    const TemporaryFolder folder;
    const std::set<std::string> others = {"a.exr", "a.exr.part", "a.exr.checkpoint", "a.exr.tmp"};
    for (const std::string& name : others)
        folder.write(name, "another run's");
    check_writable(folder.path() / "a.exr");
    EXPECT_THROW(check_writable(folder.path() / "none/a.exr"), std::runtime_error);
    EXPECT_THROW(check_writable(folder.path()), std::runtime_error);
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        names.insert(entry.path().filename().string());
        EXPECT_EQ(entry.file_size(), 13u) << entry.path();
    }
    EXPECT_EQ(names, others);
}

} // namespace

} // namespace tessera::test
