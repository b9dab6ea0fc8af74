#include "render/io/files.h"
#include "tests/load/temporary_folder.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

namespace tessera::test {

namespace {

/// Returns the id of a process that has ended.
pid_t ended_process() {
    const pid_t child = fork();
    if (child == 0)
        _exit(0);
    waitpid(child, nullptr, 0);
    return child;
}

/// Returns the part "PLACE-" of the name "a.exr.PLACE-PID-1.tmp", which identifies this machine and container.
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

TEST(TemporaryFile, RemovesLeftoversOfAKilledProcess) {
    const TemporaryFolder folder;
    const std::string ended = place() + std::to_string(ended_process()),
                      living = place() + std::to_string(getpid());
    folder.write("a.exr." + ended + "-7.tmp", "left");
    const std::set<std::string> others = {"a.exr", "a.exr." + living + "-700000.tmp", "b.exr." + ended + "-7.tmp",
                                          "a.exr." + ended + "-7.tmp.txt", "a.exr." + ended + ".tmp"};
    for (const std::string& name : others)
        folder.write(name, "another's");
    {
        const TemporaryFile file(folder.path() / "a.exr");
    }
    EXPECT_EQ(names_in(folder), others);
}

/// Process ids of other machines and containers say nothing about running processes here.
TEST(TemporaryFile, KeepsFilesOfOtherMachinesAndContainers) {
    const TemporaryFolder folder;
    const std::string ended = std::to_string(ended_process());
    std::string elsewhere = place();
    elsewhere[0] = elsewhere[0] == '0' ? '1' : '0';
    const std::set<std::string> others = {"a.exr." + elsewhere + ended + "-7.tmp", "a.exr." + ended + "-7.tmp"};
    for (const std::string& name : others)
        folder.write(name, "another's");
    {
        const TemporaryFile file(folder.path() / "a.exr");
    }
    EXPECT_EQ(names_in(folder), others);
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(TemporaryFile, FollowsSymbolicLinks) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "far");
    std::filesystem::create_symlink("far/a.txt", folder.path() / "there");
    std::filesystem::create_symlink("there", folder.path() / "here");
    for (const char* text : {"new", "newer"}) {
        check_writable(folder.path() / "here");
        write_text(folder.path() / "here", text);
        EXPECT_EQ(text_of(folder.path() / "far/a.txt"), text);
    }
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "here"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "there"));
    EXPECT_EQ(names_in(folder), (std::set<std::string>{"far", "here", "there"}));
    std::filesystem::create_symlink("b", folder.path() / "a");
    std::filesystem::create_symlink("a", folder.path() / "b");
    EXPECT_THROW(write_text(folder.path() / "a", "lost"), std::exception);
    EXPECT_THROW(check_writable(folder.path() / "a"), std::exception);
}

TEST(TemporaryFile, WritesToDevicesAndPipesInPlace) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("/dev/null", folder.path() / "null");
    check_writable(folder.path() / "null");
    write_text(folder.path() / "null", "nothing");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
    const std::filesystem::path pipe = folder.path() / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0666), 0);
    check_writable(pipe);                  // has no reader
    const std::string whole(1 << 20, 'x'); // larger than a pipe's buffer
    std::string read;
    std::thread reader([&] { read = text_of(pipe); });
    write_text(pipe, whole);
    reader.join();
    EXPECT_TRUE(read == whole);
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(TemporaryFile, RefusesToReadPipesAndDevices) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder.path() / "pipe").c_str(), 0666), 0);
    for (const std::filesystem::path& path : {folder.path() / "pipe", std::filesystem::path("/dev/zero")})
        EXPECT_THROW(read_bytes(path), std::runtime_error);
}

TEST(TemporaryFile, CheckWritableTouchesNoOtherFile) {
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
