#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tessera {

/// One piece of work on a thread of its own, newest first: a new one gives the last up. The end waits for all.
template <class Result>
class BackgroundJob {
public:
    /// What came of it.
    struct Outcome {
        std::optional<Result> result;
        std::string error; ///< if there is no result
    };
    using Work = std::function<Result(std::stop_token)>;

    /// Nothing more is heard of a job under way, which is told to stop. `on_done` is called from the new job's
    /// thread once poll() has its outcome; it may be empty.
    void start(Work work, std::function<void()> on_done) {
        cancel();
        job_ = std::make_unique<Job>();
        Job* job = job_.get();
        job->thread = std::jthread([job, work = std::move(work), done = std::move(on_done)](std::stop_token stop) {
            try {
                job->outcome.result = work(stop);
            } catch (const std::exception& error) {
                job->outcome.error = error.what();
            }
            job->finished = true;
            if (done)
                done();
        });
    }

    void cancel() {
        forget_ended();
        if (!job_)
            return;
        job_->thread.request_stop();
        given_up_.push_back(std::move(job_));
    }

    bool running() const { return job_ != nullptr; }

    /// The outcome, once; never waits.
    std::optional<Outcome> poll() {
        forget_ended();
        return job_ && job_->finished ? wait() : std::nullopt;
    }

    /// The outcome, once it is there; nothing where no job is under way.
    std::optional<Outcome> wait() {
        if (!job_)
            return std::nullopt;
        job_->thread.join();
        Outcome outcome = std::move(job_->outcome);
        job_.reset();
        return outcome;
    }

private:
    struct Job {
        Outcome outcome; // written before `finished`
        std::atomic<bool> finished{false};
        std::jthread thread; // last: ends first
    };
    void forget_ended() {
        std::erase_if(given_up_, [](const auto& job) { return job->finished.load(); });
    }

    std::unique_ptr<Job> job_;
    std::vector<std::unique_ptr<Job>> given_up_; // until they have ended by themselves
};

} // namespace tessera
