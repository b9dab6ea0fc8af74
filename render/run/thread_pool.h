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

/// Lowers the priority of the calling thread, so that threads that draw for the user get a core at once. Does
/// nothing if the system refuses.
void lower_priority();

/// Lowers the priority further than lower_priority(). On a core that a background thread wants, the calling
/// thread gets about a quarter of the time.
void lower_priority_further();

/// Returns the CPU time of the calling thread, in seconds.
double thread_cpu_seconds();

/// Threads that run the iterations of one loop at a time. They are not TBB's, so that the thread sanitizer sees
/// every synchronisation.
class ThreadPool {
public:
    /// Priority of the pool's own threads; `background` calls lower_priority().
    enum class Priority { normal, background };

    /// Throws std::runtime_error if the system cannot start so many threads.
    /// @param threads  threads that work on a loop, including the caller; 0: one per hardware thread
    explicit ThreadPool(int threads = 0, Priority priority = Priority::normal);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    int size() const { return static_cast<int>(threads_.size()) + 1; }

    /// Returns the CPU time of the calling thread plus that of the pool's own threads in loops, in seconds. Its
    /// increase is the cost of a task that alone uses the pool.
    double cpu_seconds() const;

    /// Calls body(i, worker) for i in [0, count), with worker in [0, size()), and returns when all are done. After
    /// a stop request, no further iteration begins. Rethrows the first exception of a body. Loops of several
    /// callers run one after another; a body must not start a loop on the same pool.
    void parallel_for(int count, const std::function<void(int i, int worker)>& body, std::stop_token stop = {});

    /// Returns parallel_for() without the worker's index. The pool must outlive it.
    ParallelFor loops();

    /// Returns a loop for iterations of equal cost that read the same data as their neighbours, such as rows of an
    /// image. A worker takes runs of iterations, long ones first and single ones at the end.
    ParallelFor row_loops();

private:
    struct Loop;
    void work(int worker, Priority priority);
    void end_threads();

    std::mutex callers_;       // held by the caller of the running loop
    mutable std::mutex mutex_; // guards all members below except threads_
    std::condition_variable wake_;
    std::condition_variable done_;
    Loop* loop_ = nullptr;
    std::uint64_t generation_ = 0;
    bool quit_ = false;
    double own_cpu_seconds_ = 0; // of threads_
    std::vector<std::thread> threads_;
};

} // namespace tessera
