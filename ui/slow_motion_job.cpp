#include "ui/slow_motion_job.h"

#include <utility>

#include <glm/common.hpp>

namespace tessera {

void SlowMotionJob::update(ViewerState& state, float seconds, const std::function<void()>& wake) {
    SlowMotion& slow = state.slow_motion;
    if (const auto outcome = job_.poll()) {
        if (outcome->result) {
            slow.take(*outcome->result, asked_.sample.slot, asked_.generation);
            state.space.fits = state.redraw = true;
        } else {
            state.add_message(Message::Kind::error, outcome->error);
        }
    }
    if (!slow.active) {
        if (slow.view_before) // the picture goes back to where it was
            state.view = *std::exchange(slow.view_before, std::nullopt);
        asked_ = {};
        slow.tile = nullptr;
        return;
    }
    if (!state.scene)
        return;
    choose(state);
    if (slow.advance(seconds))
        slow.start({slow.slot, slow.next_pixel(state.request_size()), {}});
    if (!job_.running())
        ask(state, wake);
}

/// A tile of the active pane: where it was in another, else the inspector's, else under the mouse, else in the
/// middle.
void SlowMotionJob::choose(ViewerState& state) {
    SlowMotion& slow = state.slow_motion;
    if (slow.sample && slow.sample->slot == state.active().slot)
        return;
    const glm::vec2 size(state.request_size());
    glm::ivec2 pixel(size * 0.5f);
    const Inspector& inspector = state.inspector;
    if (slow.sample)
        pixel = slow.sample->pixel;
    else if (inspector.sample)
        pixel = inspector.sample->pixel;
    else if (state.cursor && state.cursor->pane == state.active_pane)
        pixel = glm::ivec2(state.cursor->place * size);
    slow.start({state.active().slot, pixel, {}});
}

void SlowMotionJob::ask(ViewerState& state, const std::function<void()>& wake) {
    SlowMotion& slow = state.slow_motion;
    const PaneState& pane = state.active(); // see choose
    const auto snapshot = pane.snapshot;
    if (!snapshot || snapshot->generation != pane.generation || snapshot->coarse() || snapshot->spp < 1)
        return;
    const glm::ivec2 size(snapshot->images->primal.width(), snapshot->images->primal.height());
    slow.sample->pixel = glm::clamp(slow.sample->pixel, glm::ivec2(0), size - 1); // the picture may have shrunk
    const Asked wanted{snapshot->generation, *slow.sample};
    if (wanted == asked_)
        return;
    asked_ = wanted;
    job_.start(
        [scene = state.scene, snapshot, size, pixel = slow.sample->pixel](std::stop_token) {
            return std::make_shared<const TileInspection>(inspect_tile(
                *scene, snapshot->camera, size, snapshot->settings, *snapshot->plan, snapshot->spp - 1, pixel));
        },
        wake);
}

} // namespace tessera
