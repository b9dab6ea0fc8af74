#include "render/run/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <ctime>
#include <exception>
#include <stdexcept>
#include <string>

#include <sys/resource.h>

namespace tessera {

namespace {

/// Raises the nice value of the calling thread by `steps`.
void lower_priority(int steps) {
    constexpr int lowest = 19;
    errno = 0;
    const int nice = getpriority(PRIO_PROCESS, 0); // on Linux: of the calling thread
    if (errno == 0)
        setpriority(PRIO_PROCESS, 0, std::min(nice + steps, lowest));
}

} // namespace

void lower_priority() {
    lower_priority(10);
}

void lower_priority_further() {
    lower_priority(15);
}

double thread_cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct ThreadPool::Loop {
    int count;
    const std::function<void(int, int)>& body;
    std::stop_token stop;
    std::atomic<int> next{0};
    int workers_inside = 0;   // guarded by ThreadPool::mutex_
    std::exception_ptr error; // guarded by ThreadPool::mutex_

    void run(int worker, std::mutex& mutex) {
        for (int i = next++; i < count && !stop.stop_requested(); i = next++) {
            try {
                body(i, worker);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!error)
                    error = std::current_exception();
                next = count;
            }
        }
    }
};

ThreadPool::ThreadPool(int threads, Priority priority) {
    const int wanted = threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    try {
        for (int worker = 1; worker < wanted; ++worker)
            threads_.emplace_back([=, this] { work(worker, priority); });
    } catch (const std::exception&) { // too many threads, or no memory for their stacks
        const int started = size();
        end_threads();
        throw std::runtime_error("the system started only " + std::to_string(started) + " threads of the " +
                                 std::to_string(wanted) + " asked for");
    }
}

ThreadPool::~ThreadPool() {
    end_threads();
}

void ThreadPool::end_threads() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

void ThreadPool::parallel_for(int count, const std::function<void(int, int)>& body, std::stop_token stop) {
    const std::lock_guard callers(callers_);
    Loop loop{count, body, std::move(stop), {}, 0, {}};
    {
        const std::lock_guard lock(mutex_);
        loop_ = &loop;
        ++generation_;
    }
    wake_.notify_all();
    loop.run(0, mutex_);
    std::unique_lock lock(mutex_);
    loop_ = nullptr; // threads that have not joined the loop yet skip it
    done_.wait(lock, [&] { return loop.workers_inside == 0; });
    if (loop.error)
        std::rethrow_exception(loop.error);
}

void ThreadPool::work(int worker, Priority priority) {
    if (priority == Priority::background)
        lower_priority();
    std::uint64_t seen = 0;
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return quit_ || (loop_ && generation_ != seen); });
        if (quit_)
            return;
        seen = generation_;
        Loop& loop = *loop_;
        ++loop.workers_inside;
        lock.unlock();
        const double before = thread_cpu_seconds();
        loop.run(worker, mutex_);
        const double after = thread_cpu_seconds();
        lock.lock();
        own_cpu_seconds_ += after - before;
        if (--loop.workers_inside == 0)
            done_.notify_all();
    }
}

double ThreadPool::cpu_seconds() const {
    const std::lock_guard lock(mutex_);
    return thread_cpu_seconds() + own_cpu_seconds_;
}

ParallelFor ThreadPool::loops() {
    return [this](int count, const std::function<void(int)>& body) {
        parallel_for(count, [&body](int i, int) { body(i); });
    };
}

ParallelFor ThreadPool::row_loops() {
    return [this](int count, const std::function<void(int)>& body) {
        std::vector<int> begins; // first iteration of each run, then the end
        for (int begin = 0; begin < count; begin += std::max(1, (count - begin) / (4 * size())))
            begins.push_back(begin);
        begins.push_back(count);
        parallel_for(static_cast<int>(begins.size()) - 1, [&](int run, int) {
            for (int i = begins[run], end = begins[run + 1]; i < end; ++i)
                body(i);
        });
    };
}

} // namespace tessera
