// What a pane shows at once, before its render begins.
#include "render/session/session_pane.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace tessera {

namespace {

using Clock = std::chrono::steady_clock;
constexpr double looks_period = 1 / 15.0; // seconds for a first look of each pane, while a camera moves

} // namespace

/// A look: one sample a pixel of a small image. It is reconstructed before it is shown, as the next may be there
/// before another thread had done so.
void Session::look(Pane& pane, const RenderRequest& request, std::uint64_t generation, std::stop_token stop) {
    const Clock::time_point start = Clock::now();
    const int divisor = pane.looks.divisor(generation, request.size);
    const glm::ivec2 size = (request.size + divisor - 1) / divisor;
    Render coarse(request.scene, request.camera, size, request.settings);
    if (!coarse.pass(pool_, stop))
        return;
    const auto snapshot = snapshot_of(coarse, generation, divisor);
    {
        const std::lock_guard lock(mutex_);
        snapshot->reconstructed_with = pane.reconstruction;
    }
    auto made = std::make_shared<Reconstruction>(
        reconstruct(*snapshot->images, snapshot->reconstructed_with, pool_.loops(), stop));
    if (made->image.empty())
        return; // stopped
    snapshot->reconstruction = std::move(made);
    snapshot->reconstruction_spp = snapshot->spp;
    snapshot->reconstruction_seconds = snapshot->seconds;
    publish(pane, snapshot);
    pane.looks.count(generation, divisor, std::chrono::duration<double>(Clock::now() - start).count(),
                     look_budget());
}

/// Seconds that a pane's first look may take, so that all panes have one in time. Takes the lock.
double Session::look_budget() const {
    const std::lock_guard lock(mutex_);
    const auto in_use = std::count_if(panes_.begin(), panes_.end(),
                                      [](const auto& pane) { return pane->request.scene != nullptr; });
    return looks_period / static_cast<double>(std::max(in_use, std::ptrdiff_t{1}));
}

} // namespace tessera
