#include "render/io/available_memory.h"
#include "render/run/thread_pool.h"
#include "render/session/session_pane.h"

#include <chrono>
#include <exception>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto publish_interval = std::chrono::milliseconds(200);

} // namespace

Session::Session(int panes, int threads, std::function<void()> on_publish)
    : on_publish_(std::move(on_publish)), pool_(threads, ThreadPool::Priority::background) {
    for (int i = 0; i < panes; ++i)
        panes_.push_back(std::make_unique<Pane>());
    render_thread_ = std::jthread([this](std::stop_token stop) { render_loop(stop); });
    reconstruct_thread_ = std::jthread([this](std::stop_token stop) { reconstruct_loop(stop); });
}

Session::~Session() {
    {
        const std::lock_guard lock(mutex_);
        // There are no new stop sources, as a request has them: a thread that takes a token only now is to find it
        // stopped.
        for (const auto& pane : panes_) {
            pane->stop.request_stop();
            pane->solve_stop.request_stop();
        }
    }
    render_thread_.request_stop();
    reconstruct_thread_.request_stop();
    render_thread_.join();
    reconstruct_thread_.join();
}

std::uint64_t Session::submit(int pane_index, RenderRequest request) {
    std::uint64_t generation;
    {
        const std::lock_guard lock(mutex_);
        Pane& pane = *panes_[static_cast<std::size_t>(pane_index)];
        pane.end_work();
        std::swap(pane.request, request);
        pane.followed = -1;
        pane.generation = generation = ++generation_;
        pane.failed = false;
        pane.failure.clear();
        pane.pass_share = 0;
        pane.steps = 0;
    }
    render_wake_.notify_one();
    return generation;
}

std::uint64_t Session::follow(int pane_index, int other_index) {
    RenderRequest request; // what is large is given up without the lock
    std::shared_ptr<const Snapshot> latest;
    std::uint64_t generation;
    {
        const std::lock_guard lock(mutex_);
        Pane& pane = *panes_[static_cast<std::size_t>(pane_index)];
        const Pane& other = *panes_[static_cast<std::size_t>(other_index)];
        pane.end_work();
        std::swap(pane.request, request);
        pane.followed = other_index;
        pane.generation = generation = other.generation;
        if (other.latest && other.latest->generation == generation) {
            auto copy = std::make_shared<Snapshot>(*other.latest);
            copy->reconstruction.reset();
            latest = pane.take(copy);
        }
    }
    render_wake_.notify_one(); // its own render is to be freed
    reconstruct_wake_.notify_one();
    return generation;
}

/// The pane that renders what a pane shows: itself, or the one that it follows. Needs the lock.
const Session::Pane& Session::rendering(int pane) const {
    const int followed = panes_[static_cast<std::size_t>(pane)]->followed;
    return *panes_[static_cast<std::size_t>(followed < 0 ? pane : followed)];
}

void Session::withdraw(int pane_index) {
    RenderRequest request; // what is large is given up without the lock, here and below
    std::shared_ptr<const Snapshot> latest;
    std::shared_ptr<const GradientImages> reconstructed;
    {
        const std::lock_guard lock(mutex_);
        Pane& pane = *panes_[static_cast<std::size_t>(pane_index)];
        pane.end_work();
        std::swap(pane.request, request);
        std::swap(pane.latest, latest);
        std::swap(pane.reconstructed, reconstructed);
        pane.followed = -1;
        pane.generation = ++generation_; // what is still being made of the old request is dropped
    }
    render_wake_.notify_one();
}

void Session::set_reconstruction(int pane_index, const ReconstructionSettings& settings) {
    {
        const std::lock_guard lock(mutex_);
        Pane& pane = *panes_[static_cast<std::size_t>(pane_index)];
        if (!(pane.reconstruction == settings)) {
            pane.end_solve();
            pane.given_up.reset();
        }
        pane.reconstruction = settings;
    }
    reconstruct_wake_.notify_one();
}

std::optional<ReconstructionUnderWay> Session::reconstructing(int pane_index) const {
    const std::lock_guard lock(mutex_);
    const Pane& pane = *panes_[static_cast<std::size_t>(pane_index)];
    if (pane.solving_spp == 0)
        return std::nullopt;
    return ReconstructionUnderWay{pane.solving_spp,
                                  std::chrono::duration<double>(Clock::now() - pane.solving_since).count(),
                                  pane.solving_share};
}

void Session::give_up_reconstruction(int pane_index) {
    const std::lock_guard lock(mutex_);
    Pane& pane = *panes_[static_cast<std::size_t>(pane_index)];
    if (pane.solving_spp == 0 || !pane.latest)
        return;
    pane.end_solve();
    pane.given_up = pane.latest->images;
}

void Session::set_paused(bool paused) {
    {
        const std::lock_guard lock(mutex_);
        paused_ = paused;
        if (!paused)
            for (const auto& pane : panes_)
                pane->steps = 0;
    }
    render_wake_.notify_one();
    reconstruct_wake_.notify_one();
}

void Session::set_pace(const Pace& pace) {
    {
        const std::lock_guard lock(mutex_);
        pace_ = pace;
    }
    render_wake_.notify_one();
    reconstruct_wake_.notify_one();
}

void Session::step() {
    {
        const std::lock_guard lock(mutex_);
        for (const auto& pane : panes_)
            ++pane->steps;
    }
    render_wake_.notify_one();
}

bool Session::paused() const {
    const std::lock_guard lock(mutex_);
    return paused_;
}

std::shared_ptr<const Snapshot> Session::latest(int pane) const {
    const std::lock_guard lock(mutex_);
    return panes_[static_cast<std::size_t>(pane)]->latest;
}

bool Session::has_failed(int pane) const {
    const std::lock_guard lock(mutex_);
    return rendering(pane).failed;
}

std::string Session::failure(int pane) const {
    const std::lock_guard lock(mutex_);
    return rendering(pane).failure;
}

float Session::pass_share(int pane) const {
    const std::lock_guard lock(mutex_);
    return rendering(pane).pass_share;
}

std::vector<std::string> Session::take_messages() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

/// The pane whose turn it is, of those with work to do: first those that have shown nothing of their request yet,
/// then those that have had but previews, the one served longest ago before the others; then the one that has had
/// the least of what the pace shares out. A pane that began later than the others so catches up with them. Null:
/// none. Needs the lock.
Session::Pane* Session::next_pane() {
    Pane* next = nullptr;
    const auto order = [&](const Pane& p) {
        const double had = p.is_fresh()                      ? 0
                           : pace_.equal == Pace::Equal::spp ? p.render->spp()
                                                             : p.render->seconds();
        return std::tuple(!p.lacks_preview(), !p.is_fresh(), had, p.served);
    };
    for (const auto& pane : panes_) {
        if (pane->wants_pass(pace_, paused_) && (!next || order(*pane) < order(*next)))
            next = pane.get();
    }
    if (next)
        next->served = ++turn_;
    return next;
}

/// The film of a pane that has been withdrawn; null: none. Needs the lock.
std::unique_ptr<Render> Session::withdrawn_render() {
    for (const auto& pane : panes_)
        if (pane->render && !pane->request.scene)
            return std::move(pane->render);
    return nullptr;
}

/// A pane that rests with passes that nobody has seen yet. Needs the lock.
Session::Pane* Session::unpublished_pane() {
    for (const auto& pane : panes_)
        if (!pane->wants_pass(pace_, paused_) && pane->has_unseen_passes())
            return pane.get();
    return nullptr;
}

void Session::render_loop(std::stop_token stop) {
    work_in_background();
    while (!stop.stop_requested()) { // wait() returns true, stopped or not, while there is work
        Pane* to_render = nullptr;
        Pane* to_publish = nullptr;
        std::unique_ptr<Render> to_free;
        {
            std::unique_lock lock(mutex_);
            const auto has_work = [&] {
                return (to_free = withdrawn_render()) || (to_publish = unpublished_pane()) ||
                       (to_render = next_pane());
            };
            if (!render_wake_.wait(lock, stop, has_work))
                return;
        }
        if (to_render)
            render_pass(*to_render, stop);
        if (to_publish)
            publish_passes(*to_publish);
    }
}

/// One pass of a pane, or one preview before the first. `session_stop` ends what no request would.
void Session::render_pass(Pane& pane, std::stop_token session_stop) {
    RenderRequest request;
    std::uint64_t generation;
    std::stop_token stop;
    {
        const std::lock_guard lock(mutex_);
        request = pane.request;
        generation = pane.generation;
        stop = pane.stop.get_token();
    }
    if (!request.scene)
        return; // withdrawn since it was chosen
    try {
        if (pane.render_generation != generation) {
            pane.render.reset(); // there are never two films
            if (pane.previews.divisor(generation, request.size) > 0) {
                // A first preview is not stopped by a newer request: while a camera is dragged, each frame makes
                // one, and a picture somewhat late is better than none.
                preview(pane, request, generation, pane.previews.is_first(generation) ? session_stop : stop);
                return; // the other panes are next
            }
            pane.render = std::make_unique<Render>(request.scene, request.camera, request.size, request.settings);
            pane.render_generation = generation;
            pane.published_spp = 0;
            return; // the other panes' previews come first, and there may be a pause
        }
        if (!pane.render->pass(pool_, stop, &pane.pass_share))
            return;
        count_step(pane, generation);
        if (pane.published_spp == 0 || Clock::now() - pane.published_at >= publish_interval)
            publish_passes(pane);
    } catch (const std::exception& error) {
        pane.render_generation = 0;
        give_up(pane, generation, message_of(error));
        report(fmt::format("{}, seed {}: {}", short_name(request.settings.method), request.settings.seed,
                           message_of(error)));
    }
}

/// Tells the user what went wrong in a worker.
void Session::report(std::string message) {
    {
        const std::lock_guard lock(mutex_);
        messages_.push_back(std::move(message));
    }
    tell();
}

/// Leaves the pane at rest until its next request.
void Session::give_up(Pane& pane, std::uint64_t generation, const std::string& why) {
    const std::lock_guard lock(mutex_);
    if (pane.generation != generation)
        return;
    pane.failed = true;
    pane.failure = why;
}

/// Counts that one of the steps asked for, if there are any, is done.
void Session::count_step(Pane& pane, std::uint64_t generation) {
    const std::lock_guard lock(mutex_);
    if (pane.generation == generation && pane.steps > 0)
        --pane.steps;
}

} // namespace tessera
