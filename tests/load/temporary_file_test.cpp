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

/// What the names of this machine's and container's temporary files have before the process:
/// "a.exr.PLACE-PID-1.tmp".
std::string place() {
    const std::string name = TemporaryFile("a.exr").path().string();
    return name.substr(6, name.rfind(std::to_string(getpid()) + "-") - 6);
}

std::set<std::string> names_in(const TemporaryFolder& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        names.insert(entry.path().filename().string());
    return names;
}

TEST(TemporaryFile, RemovesWhatAKilledProcessLeftOfTheSameFile) {
    const TemporaryFolder folder;
    const std::string ended = place() + std::to_string(ended_process()),
                      living = place() + std::to_string(getpid());
    folder.write("a.exr." + ended + "-7.tmp", "left");
    const std::set<std::string> others = {"a.exr", "a.exr." + living + "-700000.tmp", "b.exr." + ended + "-7.tmp",
                                          "a.exr." + ended + "-7.tmp.txt", "a.exr." + ended + ".tmp"};
    for (const std::string& name : others)
        folder.write(name, "another's");
    { const TemporaryFile file(folder.path() / "a.exr"); }
    EXPECT_EQ(names_in(folder), others);
}

/// Its process is not to be seen from here, whether it lives or not.
TEST(TemporaryFile, LeavesWhatAnotherMachineOrContainerWrites) {
    const TemporaryFolder folder;
    const std::string ended = std::to_string(ended_process());
    std::string elsewhere = place();
    elsewhere[0] = elsewhere[0] == '0' ? '1' : '0';
    const std::set<std::string> others = {"a.exr." + elsewhere + ended + "-7.tmp", "a.exr." + ended + "-7.tmp"};
    for (const std::string& name : others)
        folder.write(name, "another's");
    { const TemporaryFile file(folder.path() / "a.exr"); }
    EXPECT_EQ(names_in(folder), others);
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
