#include "ui/jobs/background_job.h"

#include <memory>
#include <semaphore>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace tessera {
namespace {

using Job = BackgroundJob<int, int>;

/// Runs until a stop is requested, and then returns a result.
int until_stopped(std::stop_token stop) {
    while (!stop.stop_requested())
        std::this_thread::yield();
    return -1;
}

TEST(BackgroundJob, EqualRequestsRunOnce) {
    Job job;
    int started = 0;
    const auto work = [&](std::stop_token) { return ++started; };
    job.ask(3, work, {});
    job.ask(3, work, {}); // under way
    const auto outcome = job.wait();
    ASSERT_TRUE(outcome && outcome->result);
    EXPECT_EQ(outcome->request, 3);
    job.ask(3, work, {}); // done
    EXPECT_FALSE(job.running());
    EXPECT_FALSE(job.take());
    EXPECT_EQ(started, 1);
    job.cancel(); // drops the request
    job.ask(3, work, {});
    EXPECT_EQ(*job.wait()->result, 2);
    job.start(3, work, {}); // starts even an equal request
    EXPECT_EQ(*job.wait()->result, 3);
}

TEST(BackgroundJob, ANewRequestCancelsTheOlderOne) {
    Job job;
    job.ask(1, until_stopped, {});
    job.ask(2, [](std::stop_token) { return 20; }, {});
    EXPECT_EQ(job.asked(), 2);
    const auto outcome = job.wait();
    EXPECT_EQ(outcome->request, 2);
    EXPECT_EQ(outcome->result, 20);
    EXPECT_FALSE(job.wait()); // the first has no outcome
}

TEST(BackgroundJob, StoppedWorkHasAnOutcome) {
    Job job;
    job.start(1, until_stopped, {});
    EXPECT_FALSE(job.stopping());
    job.stop();
    EXPECT_TRUE(job.stopping());
    EXPECT_EQ(job.wait()->result, -1);
    EXPECT_FALSE(job.stopping());
}

TEST(BackgroundJob, FailuresAreReportedAndNotRetried) {
    Job job;
    const auto fails = [](std::stop_token) -> int { throw std::runtime_error("no such thing"); };
    job.ask(1, fails, {});
    const auto outcome = job.wait();
    EXPECT_FALSE(outcome->result);
    EXPECT_EQ(outcome->error, "no such thing");
    job.ask(1, fails, {});
    EXPECT_FALSE(job.running());
}

TEST(BackgroundJob, TheOutcomeIsAvailableInOnDone) {
    Job job;
    std::binary_semaphore told(0);
    job.ask(1, [](std::stop_token) { return 10; }, [&] { told.release(); });
    told.acquire();
    const auto outcome = job.take();
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->result, 10);
}

TEST(Identity, ADestroyedObjectDiffersFromANewOne) {
    auto object = std::make_shared<int>(1);
    const Identity first(object);
    EXPECT_EQ(first, Identity(object));
    EXPECT_NE(first, Identity());
    object.reset();
    EXPECT_NE(first, Identity(object)); // although both are empty
    EXPECT_EQ(Identity(object), Identity());
}

} // namespace
} // namespace tessera
