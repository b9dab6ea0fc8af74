// Without Open Image Denoise, the session reports it and shows another reconstruction. Only a worker waits.

#include "recon/picture/oidn.h"
#include "render/scene/scene.h"
#include "render/session/session.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/scene_builder.h"

#include <chrono>
#include <cstdlib>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tessera::test {
namespace {

using namespace std::chrono_literals;

// The library's path is a pipe without a writer until the calls return. Opening it blocks.
TEST(Session, OnlyAWorkerWaitsForTheDenoiserLibrary) {
    const TemporaryFolder folder;
    const std::string pipe = (folder.path() / "libOpenImageDenoise.so").string();
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    ASSERT_EQ(setenv("TESSERA_OIDN", pipe.c_str(), 1), 0);
    Session session(1, 1);
    session.set_pace({Pace::Equal::time, 2, 0});
    const std::shared_ptr<const Scene> scene = all_test_scenes().front().scene;
    auto calls = std::async(std::launch::async, [&] {
        session.submit(0, {scene, scene->camera(), {64, 48}, {}});
        session.set_reconstruction(0, {Norm::oidn});
    });
    // The limit is a minute, because other tests run in parallel. Opening a writer unblocks the reader.
    EXPECT_EQ(calls.wait_for(60s), std::future_status::ready);
    std::vector<std::string> messages;
    const auto shown = [&] {
        const auto s = session.latest(0);
        return s && !s->coarse() && s->reconstruction_spp == 2 && s->reconstructed_with.norm == Norm::guided;
    };
    for (int i = 0; i < 12000 && !(shown() && !messages.empty()); ++i) {
        if (const int writer = open(pipe.c_str(), O_WRONLY | O_NONBLOCK); writer >= 0) // a reader is waiting
            close(writer);
        for (std::string& message : session.take_messages())
            messages.push_back(std::move(message));
        std::this_thread::sleep_for(10ms);
    }
    EXPECT_TRUE(shown());
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_NE(messages[0].find(oidn_problem()), std::string::npos) << messages[0];
}

} // namespace
} // namespace tessera::test
