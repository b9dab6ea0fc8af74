// Data reach the disk before files that refer to them, and errors of the disk are reported.
#include "app/experiment/experiment_jobs.h"
#include "render/io/files.h"
#include "tests/load/temporary_folder.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

std::mutex synced_mutex;         // threads of other tests in this program write files
std::vector<std::string> synced; // names of synchronised files and folders, without parent folders
bool disk_is_broken = false;

} // namespace

/// Replaces the system's fsync() in this program, and records the names.
extern "C" int fsync(int file) {
    {
        const std::lock_guard lock(synced_mutex);
        synced.push_back(std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file)).filename());
    }
    if (disk_is_broken) {
        errno = EIO;
        return -1;
    }
    return static_cast<int>(::syscall(SYS_fsync, file));
}

namespace tessera::test {

namespace {

namespace fs = std::filesystem;

/// Returns the first index, not before `from`, of a name with this beginning, or the size of the list.
std::size_t find(const std::string& beginning, std::size_t from) {
    while (from < synced.size() && synced[from].rfind(beginning, 0) != 0)
        ++from;
    return from;
}

TEST(PowerCut, PicturesReachTheDiskBeforeTheirJobs) {
    const TemporaryFolder folder;
    ExperimentOptions options;
    options.scenes = {fs::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml"};
    options.settings.size = options.recipe.size = {16, 9};
    options.settings.threads = 1;
    options.effort = {1, Effort::Unit::spp};
    options.recipe.spp = 2;
    options.references = folder.path() / "refs";
    options.output = folder.path() / "out";
    options.keeps_images = true;
    Experiment experiment(options);
    synced.clear();
    ASSERT_EQ(run_jobs({&experiment}, options, [] {}), 0);
    const std::size_t picture = find("cornell-box-gpr-weighted.exr.", 0), name = find("images", picture),
                      results = find("cornell-box-", name + 1), folder_of_jobs = find("jobs", results);
    EXPECT_LT(picture, name);
    EXPECT_LT(name, results) << "the picture, its folder, then the results that refer to it";
    EXPECT_LT(results, folder_of_jobs);
    EXPECT_LT(folder_of_jobs, synced.size());
}

TEST(PowerCut, KeepsTheOldFileIfTheDiskFails) {
    const TemporaryFolder folder;
    folder.write("a.txt", "before");
    disk_is_broken = true;
    EXPECT_THROW(write_text(folder.path() / "a.txt", "after"), std::runtime_error);
    disk_is_broken = false;
    std::ifstream in(folder.path() / "a.txt");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "before");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

} // namespace

} // namespace tessera::test
