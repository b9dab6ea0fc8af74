#include "render/session/session.h"

#include "render/session/render.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <tuple>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto publish_interval = std::chrono::milliseconds(200);
constexpr int coarse_divisor = 4; // the first look has a sixteenth of the pixels

} // namespace

struct Session::Pane {
    // Guarded by Session::mutex_.
    RenderRequest request;
    std::uint64_t generation = 0; // 0: nothing asked for yet
    ReconstructionSettings reconstruction;
    std::shared_ptr<const Snapshot> latest;
    std::stop_source stop; // ends work on the present generation
    bool resting = false;  // limit reached or failed: nothing to do for this generation

    // What the newest reconstruction was made from.
    std::shared_ptr<const GradientImages> reconstructed;
    ReconstructionSettings reconstructed_with;

    // Used by the render thread alone.
    std::unique_ptr<Render> render;
    std::uint64_t render_generation = 0;
    int published_spp = 0;
    Clock::time_point published_at;
    double share = 0;         ///< seconds had, for the panes to take turns by; not lost by a restart
    std::uint64_t served = 0; ///< turn in which it was last chosen

    // Used by the reconstruction thread alone: where the solver stands, and with what.
    Reconstructor reconstructor;
    std::uint64_t solved_generation = 0;
    bool solved_coarse = false;
    ReconstructionSettings solved_with;

    bool needs_reconstruction() const {
        return latest && (latest->images != reconstructed || !(reconstructed_with == reconstruction));
    }

    /// Starts warm from the last snapshot of the same render, and else anew.
    Reconstructor& solver_for(const Snapshot& snapshot, const ReconstructionSettings& settings) {
        if (solved_generation != snapshot.generation || solved_coarse != snapshot.coarse ||
            solved_with != settings)
            reconstructor.forget();
        solved_generation = snapshot.generation;
        solved_coarse = snapshot.coarse;
        solved_with = settings;
        return reconstructor;
    }
};

Session::Session(int panes, int threads, std::function<void()> on_publish)
    : on_publish_(std::move(on_publish)), pool_(threads) {
    for (int i = 0; i < panes; ++i)
        panes_.push_back(std::make_unique<Pane>());
    render_thread_ = std::jthread([this](std::stop_token stop) { render_loop(stop); });
    reconstruct_thread_ = std::jthread([this](std::stop_token stop) { reconstruct_loop(stop); });
}

Session::~Session() {
    {
        const std::lock_guard lock(mutex_);
        for (const auto& pane : panes_)
            pane->stop.request_stop();
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
        pane.stop.request_stop();
        pane.stop = std::stop_source();
        pane.request = std::move(request);
        pane.generation = generation = ++generation_;
        pane.resting = false;
    }
    render_wake_.notify_one();
    return generation;
}

void Session::set_reconstruction(int pane_index, const ReconstructionSettings& settings) {
    {
        const std::lock_guard lock(mutex_);
        panes_[static_cast<std::size_t>(pane_index)]->reconstruction = settings;
    }
    reconstruct_wake_.notify_one();
}

void Session::set_paused(bool paused) {
    {
        const std::lock_guard lock(mutex_);
        paused_ = paused;
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

std::vector<std::string> Session::take_messages() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

/// The pane whose turn it is, of those with work to do: first those that have shown nothing of their request yet,
/// the one served longest ago before the others; then the one that has had the least time. Null: none. Needs the
/// lock.
Session::Pane* Session::next_pane() {
    if (paused_)
        return nullptr;
    Pane* next = nullptr;
    const auto order = [](const Pane& p) {
        const bool fresh = p.render_generation != p.generation;
        return std::tuple(!fresh, fresh ? 0 : p.share, p.served);
    };
    for (const auto& pane : panes_) {
        if (pane->generation == 0 || pane->resting || !pane->request.scene)
            continue;
        if (!next || order(*pane) < order(*next))
            next = pane.get();
    }
    if (next)
        next->served = ++turn_;
    return next;
}

/// The least share of the other panes at work, or the pane's own: where a restarted pane joins in.
double Session::joining_share(const Pane& joining) const {
    const std::lock_guard lock(mutex_);
    double least = std::numeric_limits<double>::max();
    for (const auto& pane : panes_)
        if (pane.get() != &joining && pane->generation != 0 && !pane->resting)
            least = std::min(least, pane->share);
    return least == std::numeric_limits<double>::max() ? joining.share : least;
}

/// While paused: a pane with passes that nobody has seen yet. Needs the lock.
Session::Pane* Session::unpublished_pane() {
    for (const auto& pane : panes_)
        if (paused_ && pane->render && pane->render_generation == pane->generation &&
            pane->published_spp < pane->render->spp())
            return pane.get();
    return nullptr;
}

void Session::render_loop(std::stop_token stop) {
    while (!stop.stop_requested()) { // wait() returns true, stopped or not, while there is work
        Pane* to_render = nullptr;
        Pane* to_publish = nullptr;
        {
            std::unique_lock lock(mutex_);
            const auto has_work = [&] { return (to_render = next_pane()) || (to_publish = unpublished_pane()); };
            if (!render_wake_.wait(lock, stop, has_work))
                return;
        }
        if (to_render) {
            render_pass(*to_render);
            continue;
        }
        try {
            publish(*to_publish, *to_publish->render, to_publish->render_generation, false);
        } catch (const std::exception& error) {
            to_publish->published_spp = to_publish->render->spp(); // do not try for ever
            report(error.what());
        }
    }
}

void Session::render_pass(Pane& pane) {
    RenderRequest request;
    std::uint64_t generation;
    std::stop_token stop;
    {
        const std::lock_guard lock(mutex_);
        request = pane.request;
        generation = pane.generation;
        stop = pane.stop.get_token();
    }
    try {
        if (pane.render_generation != generation) {
            pane.render = std::make_unique<Render>(request.scene, request.camera, request.size, request.settings);
            pane.render_generation = generation;
            pane.published_spp = 0;
            pane.share = joining_share(pane);
            return render_coarse(pane, request, generation); // the other panes' first looks come next
        }
        const double before = pane.render->seconds();
        if (!pane.render->pass(pool_, stop))
            return;
        pane.share += pane.render->seconds() - before;
        const bool last = request.spp_limit > 0 && pane.render->spp() >= request.spp_limit;
        if (last || pane.published_spp == 0 || Clock::now() - pane.published_at >= publish_interval)
            publish(pane, *pane.render, generation, false);
        if (last)
            rest(pane, generation);
    } catch (const std::exception& error) {
        pane.render_generation = 0;
        rest(pane, generation);
        report(fmt::format("{}, seed {}: {}", short_name(request.settings.method), request.settings.seed,
                           error.what()));
    }
}

/// Tells the user what went wrong in a worker.
void Session::report(std::string message) {
    {
        const std::lock_guard lock(mutex_);
        messages_.push_back(std::move(message));
    }
    if (on_publish_)
        on_publish_();
}

/// A first look: one sample a pixel of a small image, there at once. It is not stopped by a newer request: while a
/// camera is dragged, each frame makes one, and a picture somewhat late is better than none.
void Session::render_coarse(Pane& pane, const RenderRequest& request, std::uint64_t generation) {
    const glm::ivec2 size = (request.size + coarse_divisor - 1) / coarse_divisor;
    Render coarse(request.scene, request.camera, size, request.settings);
    coarse.pass(pool_);
    publish(pane, coarse, generation, true);
}

/// Nothing more to do for this generation.
void Session::rest(Pane& pane, std::uint64_t generation) {
    const std::lock_guard lock(mutex_);
    if (pane.generation == generation)
        pane.resting = true;
}

void Session::publish(Pane& pane, const Render& render, std::uint64_t generation, bool coarse) {
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->generation = generation;
    snapshot->coarse = coarse;
    snapshot->spp = render.spp();
    snapshot->seconds = render.seconds();
    snapshot->cpu_seconds = render.cpu_seconds();
    snapshot->settings = render.settings();
    snapshot->counters = render.counters();
    snapshot->images = std::make_shared<GradientImages>(render.images());
    if (ReuseMaps maps = render.reuse_maps(); !maps.reused.empty())
        snapshot->reuse = std::make_shared<ReuseMaps>(std::move(maps));
    {
        const std::lock_guard lock(mutex_);
        if (pane.generation != generation && !coarse)
            return;
        if (pane.latest && pane.latest->generation == generation && !pane.latest->coarse) {
            snapshot->reconstruction = pane.latest->reconstruction;
            snapshot->reconstruction_spp = pane.latest->reconstruction_spp;
        }
        pane.latest = std::move(snapshot);
    }
    if (!coarse) {
        pane.published_spp = render.spp();
        pane.published_at = Clock::now();
    }
    reconstruct_wake_.notify_one();
    if (on_publish_)
        on_publish_();
}

void Session::reconstruct_loop(std::stop_token stop) {
    std::size_t turn = 0; // panes in turn, so that none starves
    while (!stop.stop_requested()) {
        Pane* pane = nullptr;
        std::shared_ptr<const Snapshot> snapshot;
        ReconstructionSettings settings;
        std::stop_token generation_stop;
        {
            std::unique_lock lock(mutex_);
            const auto find = [&] {
                for (std::size_t i = 0; i < panes_.size() && !pane; ++i) {
                    Pane* candidate = panes_[(turn + i) % panes_.size()].get();
                    if (candidate->needs_reconstruction())
                        pane = candidate;
                }
                return pane != nullptr;
            };
            if (!reconstruct_wake_.wait(lock, stop, find))
                return;
            ++turn;
            snapshot = pane->latest;
            settings = pane->reconstruction;
            generation_stop = pane->stop.get_token();
        }
        reconstruct_snapshot(*pane, *snapshot, settings, generation_stop);
    }
}

void Session::reconstruct_snapshot(Pane& pane, const Snapshot& snapshot, const ReconstructionSettings& settings,
                                   std::stop_token stop) {
    auto result = std::make_shared<Reconstruction>();
    std::string failure;
    try {
        *result = pane.solver_for(snapshot, settings).reconstruct(*snapshot.images, settings, serial_for, stop);
    } catch (const std::exception& error) {
        failure = fmt::format("reconstruction of pass {}: {}", snapshot.spp, error.what());
    }
    {
        const std::lock_guard lock(mutex_);
        // A newer picture of another size or request has no use for this one.
        if (stop.stop_requested() || pane.latest->generation != snapshot.generation ||
            pane.latest->coarse != snapshot.coarse)
            return;
        pane.reconstructed = snapshot.images;
        pane.reconstructed_with = settings;
        if (!failure.empty()) {
            messages_.push_back(std::move(failure));
        } else {
            // The render may have gone on meanwhile: the newest snapshot gets this picture, labelled with its
            // pass.
            auto updated = std::make_shared<Snapshot>(*pane.latest);
            updated->reconstruction = std::move(result);
            updated->reconstruction_spp = snapshot.spp;
            pane.latest = std::move(updated);
        }
    }
    if (on_publish_)
        on_publish_();
}

} // namespace tessera
