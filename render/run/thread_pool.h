#pragma once

#include "recon/parallel.h"

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace tessera {

/// Makes the calling thread give way to those of normal priority: what draws for the user comes first, and gets a
/// core as soon as it has something to do. Where that cannot be done, nothing happens.
void work_in_background();

/// Makes the calling thread give way also to those that work in background: where these want all cores, it has
/// about a quarter of the time.
void work_behind_others();

/// CPU time that the calling thread has had, seconds.
double thread_cpu_seconds();

/// Threads that run the iterations of one loop at a time. Own threads, not TBB's, so that the thread sanitizer
/// sees every synchronisation.
class ThreadPool {
public:
    /// Whether the pool's own threads give way to others (work_in_background).
    enum class Priority { normal, background };

    /// `threads` >= 1 threads work on a loop, the caller among them; 0: one a hardware thread. Throws
    /// std::runtime_error where the system starts fewer.
    explicit ThreadPool(int threads = 0, Priority priority = Priority::normal);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    int size() const { return static_cast<int>(threads_.size()) + 1; }

    /// CPU time that the calling thread has had, and the pool's own threads in loops, seconds. The difference over
    /// a piece of work that alone uses the pool is what that work has cost, whatever else the process does.
    double cpu_seconds() const;

    /// Runs body(i, worker) for i in [0, count), worker in [0, size()); returns when all are done. Once `stop` is
    /// asked for, iterations not yet begun are left out. The first exception thrown by a body is thrown again
    /// here. Loops of several callers run one after another; a body must not start a loop on the same pool.
    void parallel_for(int count, const std::function<void(int i, int worker)>& body, std::stop_token stop = {});

    /// The pool's loops for those who need not know the worker, as loaders. The pool must live as long.
    ParallelFor loops();

    /// The same for bodies of about the same cost that read what their neighbours read, too, as the rows of a
    /// picture are worked on: a worker takes some neighbours at a time, many at first and single ones in the end.
    ParallelFor row_loops();

private:
    struct Loop;
    void work(int worker, Priority priority);
    void end_threads();

    std::mutex callers_;       // held by the caller whose loop runs
    mutable std::mutex mutex_; // guards what follows
    std::condition_variable wake_;
    std::condition_variable done_;
    Loop* loop_ = nullptr;
    std::uint64_t generation_ = 0;
    bool quit_ = false;
    double own_cpu_seconds_ = 0; // of threads_
    std::vector<std::thread> threads_;
};

} // namespace tessera
