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

/// Identifies an object without keeping it alive. A new object differs from a destroyed one even at the same
/// address.
class Identity {
public:
    Identity() = default; ///< no object; equal to the identity of a null pointer
    template <class T>
    Identity(const std::shared_ptr<T>& object) : object_(object) {}

    bool operator==(const Identity& other) const {
        return !object_.owner_before(other.object_) && !other.object_.owner_before(object_);
    }

private:
    std::weak_ptr<const void> object_;
};

/// Runs work that takes longer than a frame on a thread of its own. take() polls for the outcome. A new request
/// cancels the one under way, whose outcome is dropped. The destructor requests all work to stop, and waits for
/// it. To be used from one thread.
/// @tparam Request  description of the work; ask() needs operator==
template <class Request, class Result>
class BackgroundJob {
public:
    struct Outcome {
        Request request;
        std::optional<Result> result; ///< empty: the work has thrown
        std::string error;            ///< what() of the exception
    };
    using Work = std::function<Result(std::stop_token)>;

    /// Starts the work, unless the request equals the last one, which may be under way, done or failed.
    void ask(Request request, Work work, std::function<void()> on_done) {
        if (!(asked_ == request))
            start(std::move(request), std::move(work), std::move(on_done));
    }

    /// Starts the work, even for an equal request. `on_done` is called from the job's thread once take() has the
    /// outcome; it may be empty.
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

    /// Requests the work under way to stop. take() still returns its outcome.
    void stop() {
        if (job_)
            job_->thread.request_stop();
    }

    /// Requests the work under way to stop, and drops its outcome and the request.
    void cancel() {
        stop();
        asked_.reset();
        drop_ended();
        if (job_)
            cancelled_.push_back(std::move(job_));
    }

    bool running() const { return job_ != nullptr; }
    bool stopping() const { return job_ && job_->thread.get_stop_token().stop_requested(); }

    /// Returns the last request, which may be done; empty: none since the last cancel().
    const std::optional<Request>& asked() const { return asked_; }

    /// Returns the outcome once, and empty before and after. Never waits.
    std::optional<Outcome> take() {
        drop_ended();
        return job_ && job_->finished ? wait() : std::nullopt;
    }

    /// Waits for the outcome and returns it. Returns empty if no work is under way.
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
        std::optional<Result> result; // `result` and `error` are written before `finished`
        std::string error;
        std::atomic<bool> finished{false};
        std::jthread thread; // last, so that it is joined before the other members are destroyed
    };
    void drop_ended() {
        std::erase_if(cancelled_, [](const auto& job) { return job->finished.load(); });
    }

    std::optional<Request> asked_;
    std::unique_ptr<Job> job_;
    std::vector<std::unique_ptr<Job>> cancelled_; // until they have ended
};

} // namespace tessera
