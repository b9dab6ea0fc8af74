#pragma once

#include "render/io/available_memory.h"

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

/// Which object something was made of, without keeping it alive. An object that takes the place of one that is
/// gone differs from it.
class Identity {
public:
    Identity() = default; ///< of no object, as of a null pointer
    template <class T>
    Identity(const std::shared_ptr<T>& object) : object_(object) {}

    bool operator==(const Identity& other) const {
        return !object_.owner_before(other.object_) && !other.object_.owner_before(object_);
    }

private:
    std::weak_ptr<const void> object_;
};

/// How the viewer does what takes longer than a frame: asked for a request, it works on a thread of its own, and
/// is polled every frame for what came of it. The latest request wins: nothing more is heard of an older one. The
/// destructor tells all work to stop, and waits for it.
template <class Request, class Result>
class BackgroundJob {
public:
    /// What came of a request.
    struct Outcome {
        Request request;
        std::optional<Result> result;
        std::string error; ///< if there is no result
    };
    using Work = std::function<Result(std::stop_token)>;

    /// Starts the work, unless this is what was asked for last, be it under way, done or failed.
    void ask(Request request, Work work, std::function<void()> on_done) {
        if (!(asked_ == request))
            start(std::move(request), std::move(work), std::move(on_done));
    }

    /// Starts the work in any case. `on_done` is called from the job's thread once take() has the outcome; it may
    /// be empty.
    void start(Request request, Work work, std::function<void()> on_done) {
        cancel();
        asked_ = std::move(request);
        job_ = std::make_unique<Job>();
        Job* job = job_.get();
        job->thread = std::jthread([job, work = std::move(work), done = std::move(on_done)](std::stop_token stop) {
            try {
                job->result = work(stop);
            } catch (const std::exception& error) {
                job->error = message_of(error);
            }
            job->finished = true;
            if (done)
                done();
        });
    }

    /// Tells the work under way to stop. Its outcome is still awaited.
    void stop() {
        if (job_)
            job_->thread.request_stop();
    }

    /// Gives up the work under way, and forgets what was asked for.
    void cancel() {
        stop();
        asked_.reset();
        forget_ended();
        if (job_)
            given_up_.push_back(std::move(job_));
    }

    bool running() const { return job_ != nullptr; }
    bool stopping() const { return job_ && job_->thread.get_stop_token().stop_requested(); }

    /// What was asked for last, also once it is done; empty: nothing since the last cancel().
    const std::optional<Request>& asked() const { return asked_; }

    /// The outcome, once; never waits.
    std::optional<Outcome> take() {
        forget_ended();
        return job_ && job_->finished ? wait() : std::nullopt;
    }

    /// The outcome, once it is there; nothing where no job is under way.
    std::optional<Outcome> wait() {
        if (!job_)
            return std::nullopt;
        job_->thread.join();
        Outcome outcome{*asked_, std::move(job_->result), std::move(job_->error)};
        job_.reset();
        return outcome;
    }

private:
    struct Job {
        std::optional<Result> result; // written before `finished`, as the next
        std::string error;
        std::atomic<bool> finished{false};
        std::jthread thread; // last: ends first
    };
    void forget_ended() {
        std::erase_if(given_up_, [](const auto& job) { return job->finished.load(); });
    }

    std::optional<Request> asked_;
    std::unique_ptr<Job> job_;
    std::vector<std::unique_ptr<Job>> given_up_; // until they have ended by themselves
};

} // namespace tessera
