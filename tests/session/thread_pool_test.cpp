#include "render/run/thread_pool.h"

#include <atomic>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {

TEST(ThreadPool, RunsEveryIterationOnce) {
    for (int threads : {1, 2, 5}) {
        ThreadPool pool(threads);
        EXPECT_EQ(pool.size(), threads);
        for (int count : {0, 1, 3, 1000}) {
            std::vector<std::atomic<int>> done(static_cast<std::size_t>(count));
            pool.parallel_for(count, [&](int i, int worker) {
                EXPECT_LT(worker, threads);
                ++done[static_cast<std::size_t>(i)];
            });
            for (const auto& d : done)
                EXPECT_EQ(d, 1);
        }
    }
}

TEST(ThreadPool, ThrowsTheErrorOfABodyAndStaysUsable) {
    ThreadPool pool(3);
    EXPECT_THROW(pool.parallel_for(100,
                                   [](int i, int) {
                                       if (i == 50)
                                           throw std::runtime_error("fifty");
                                   }),
                 std::runtime_error);
    std::atomic<int> sum = 0;
    pool.parallel_for(10, [&](int i, int) { sum += i; });
    EXPECT_EQ(sum, 45);
}

TEST(ThreadPool, StopsOnRequest) {
    ThreadPool pool(2);
    std::stop_source stop;
    std::atomic<int> done = 0;
    pool.parallel_for(
        1000000,
        [&](int, int) {
            if (++done == 10)
                stop.request_stop();
        },
        stop.get_token());
    EXPECT_LT(done, 1000);
}

TEST(ThreadPool, LoopsOfSeveralCallersTakeTurns) {
    ThreadPool pool(2);
    std::atomic<int> sum = 0;
    std::vector<std::jthread> callers;
    for (int c = 0; c < 4; ++c)
        callers.emplace_back([&] {
            for (int n = 0; n < 200; ++n)
                pool.parallel_for(7, [&](int, int) { ++sum; });
        });
    callers.clear();
    EXPECT_EQ(sum, 4 * 200 * 7);
}

TEST(ThreadPool, RunsLoopsWithoutWorkerIndex) {
    ThreadPool pool(3);
    for (const ParallelFor& loops : {pool.loops(), pool.row_loops()}) {
        for (std::size_t count : {0u, 1u, 2u, 11u, 12u, 13u, 100u, 1000u}) {
            std::vector<std::atomic<int>> runs(count);
            loops(static_cast<int>(count), [&](int i) { ++runs[static_cast<std::size_t>(i)]; });
            for (const auto& times : runs)
                EXPECT_EQ(times, 1) << count;
        }
        std::atomic<int> done = 0;
        const auto fail_once = [&](int i) {
            ++done;
            if (i == 500)
                throw std::runtime_error("no");
        };
        EXPECT_THROW(loops(1000, fail_once), std::runtime_error);
        done = 0;
        loops(500, fail_once);
        EXPECT_EQ(done, 500);
    }
}

TEST(ThreadPool, CountsTheCpuSecondsOfAllItsWorkers) {
    ThreadPool pool(3);
    std::mutex mutex;
    double spent = 0; // CPU time of the loop bodies, seconds
    const double before = pool.cpu_seconds();
    pool.parallel_for(30, [&](int, int) {
        const double start = thread_cpu_seconds();
        while (thread_cpu_seconds() - start < 0.005)
            ;
        const std::lock_guard lock(mutex);
        spent += thread_cpu_seconds() - start;
    });
    EXPECT_GE(pool.cpu_seconds() - before, spent);
    EXPECT_LT(pool.cpu_seconds() - before, 1.5 * spent);
}

} // namespace tessera::test
