// The panel of a followed folder of jobs. The window never waits for the folder.
#include "tests/ui/viewer_harness.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

using State = FollowedJob::State;

/// Returns a folder of 100000 jobs, of which `done` are done.
std::shared_ptr<const FollowedFolder> folder_with(std::size_t done) {
    FollowedFolder folder{"sweep", {}, {}, {}};
    for (std::size_t i = 0; i < 100000; ++i)
        folder.jobs.push_back({"box, seed " + std::to_string(i), i < done ? State::done : State::waiting});
    folder.jobs.back() = {"box, seed 99999", State::claimed, "host-1"};
    ChartPlot plot{"tile", "relMSE", ChartAxis::Scale::linear, ChartAxis::Scale::log, {}, {}};
    plot.series.push_back({"gpr", {{2, 0.1}, {4, 0.05}}, false, false, {Method::gpr, Norm::weighted, 0}});
    plot.series.push_back({"pt", {{0, 0.3}}, true, false, {Method::pt, Norm::none, 0}});
    folder.charts.push_back({"box: 8 spp", {plot, plot}});
    return std::make_shared<const FollowedFolder>(std::move(folder));
}

struct Reader {
    std::atomic<std::size_t> done = 1;
    std::atomic<int> looks = 0;
    std::atomic<bool> hangs = false, fails = false;

    std::shared_ptr<const FollowedFolder> look() {
        ++looks;
        while (hangs)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (fails)
            throw std::runtime_error("out: there is no such folder");
        return folder_with(done);
    }
};

ViewerOptions following(Reader& reader) {
    ViewerOptions options = ViewerHarness::two_panes();
    options.read_jobs = [&reader](const std::filesystem::path&) -> FolderReader {
        return [&reader] { return reader.look(); };
    };
    options.jobs = "out";
    return options;
}

TEST(JobsPanel, ShowsNewResults) {
    Reader reader;
    ViewerHarness h({1280, 720}, 1, following(reader));
    ASSERT_TRUE(h.wait_until([&] { return h.has("jobs.plots"); }));
    h.frames(2);
    h.save("jobs");
    const double before = h.brightness("jobs.bar");
    reader.done = 50000;
    const int looks = reader.looks;
    ASSERT_TRUE(h.wait_until([&] { return reader.looks > looks + 1; }));
    h.frames(2);
    EXPECT_GT(h.brightness("jobs.bar"), before + 10) << "half of the bar is filled";
    h.type(Key::escape);
    h.frames(2);
    EXPECT_FALSE(h.state().layout.show_jobs);
    h.type(Key::f, true, true);
    EXPECT_TRUE(h.state().layout.show_jobs) << "the panel is restored";
}

TEST(JobsPanel, ReportsErrorsAndContinuesToRead) {
    Reader reader;
    reader.fails = true;
    ViewerHarness h({1280, 720}, 1, following(reader));
    ASSERT_TRUE(h.wait_until([&] { return h.has("jobs.error"); }));
    EXPECT_FALSE(h.has("jobs.bar"));
    reader.fails = false;
    ASSERT_TRUE(h.wait_until([&] { return h.has("jobs.bar"); }));
    h.frames(1);
    EXPECT_FALSE(h.has("jobs.error"));
}

TEST(JobsPanel, TheWindowNeverWaitsForTheFolder) {
    Reader reader;
    reader.hangs = true;
    ViewerHarness h({1280, 720}, 1, following(reader));
    ASSERT_TRUE(h.wait_until([&] { return reader.looks > 0; }));
    h.load_scene(); // frames and renders continue
    EXPECT_TRUE(h.has("jobs.close"));
    EXPECT_EQ(reader.looks, 1);
    reader.hangs = false;
    ASSERT_TRUE(h.wait_until([&] { return h.has("jobs.bar"); }));
}

TEST(JobsPanel, TheDialogChoosesTheFolder) {
    Reader reader;
    ViewerOptions options = following(reader);
    options.jobs.clear();
    ViewerHarness h({1280, 720}, 1, options);
    h.frames(2);
    EXPECT_EQ(reader.looks, 0);
    h.type(Key::o, true, true);
    ASSERT_EQ(h.state().layout.choosing, FilePurpose::jobs);
    h.frames(2);
    h.click("file.open"); // opens the current folder, where the dialog begins
    ASSERT_TRUE(h.wait_until([&] { return h.has("jobs.bar"); }));
    EXPECT_FALSE(h.state().layout.choosing);
}

} // namespace

} // namespace tessera::test
