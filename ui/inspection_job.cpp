#include "ui/inspection_job.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace tessera {

void InspectionJob::take(ViewerState& state) {
    const auto outcome = job_.poll();
    if (!outcome)
        return;
    Inspector& inspector = state.inspector;
    const Found found = outcome->result.value_or(Found{});
    const bool is_same = found.inspection && inspector.inspection && inspector.slot == asked_.sample.slot &&
                         inspector.inspection->pixel == found.inspection->pixel;
    state.space.fits = state.space.fits || !is_same; // but not at every pass that is followed
    inspector.slot = asked_.sample.slot;
    inspector.generation = asked_.generation;
    inspector.scene_radius = found.scene_radius;
    inspector.inspection = found.inspection;
    state.redraw = true;
    if (!outcome->result)
        state.add_message(Message::Kind::error, outcome->error);
}

/// The pixel of a pane that is gone is looked at in the active one. A sample of a request of its own is forgotten
/// with the inspector: it would keep its scene, which may have been replaced.
void InspectionJob::drop_what_is_gone(ViewerState& state) {
    Inspector& inspector = state.inspector;
    if (!inspector.sample)
        return;
    if (!inspector.active && inspector.sample->origin) {
        inspector.sample.reset();
        inspector.inspection.reset();
        job_.cancel();
        asked_ = {};
    } else if (!inspector.sample->origin && !state.pane_in(inspector.sample->slot)) {
        inspector.sample->slot = state.active().slot;
    }
}

/// Null: its pane shows nothing yet that could be looked at.
std::shared_ptr<const PassOrigin> InspectionJob::origin_of(const ViewerState& state,
                                                           const SampleChoice& sample) const {
    if (sample.origin)
        return sample.origin;
    const PaneState* pane = state.pane_in(sample.slot);
    const Snapshot* s = pane ? pane->snapshot.get() : nullptr;
    if (!s || s->generation != pane->generation || s->coarse || s->spp < 1)
        return nullptr;
    const glm::ivec2 size(s->images->primal.width(), s->images->primal.height());
    return std::make_shared<const PassOrigin>(
        PassOrigin{state.scene, s->camera, size, s->settings, s->plan, s->generation});
}

void InspectionJob::update(ViewerState& state, const std::function<void()>& wake) {
    take(state);
    drop_what_is_gone(state);
    const Inspector& inspector = state.inspector;
    if (!inspector.active || !inspector.sample || !state.scene || job_.running())
        return;
    const std::shared_ptr<const PassOrigin> origin = origin_of(state, *inspector.sample);
    if (!origin)
        return;
    Asked wanted{origin->generation, *inspector.sample};
    if (!wanted.sample.pass) {
        wanted.sample.pass = asked_.sample.pass;
        if (!(wanted == asked_) || inspector.follows)
            wanted.sample.pass = state.pane_in(wanted.sample.slot)->snapshot->spp - 1;
    }
    if (wanted == asked_)
        return;
    asked_ = wanted;
    const glm::ivec2 pixel = glm::clamp(wanted.sample.pixel, glm::ivec2(0), origin->size - 1);
    job_.start(
        [origin, pixel, pass = *wanted.sample.pass](std::stop_token) {
            const PassOrigin& o = *origin;
            return Found{std::make_shared<const Inspection>(
                             inspect(*o.scene, o.camera, o.size, o.settings, *o.plan, pass, pixel)),
                         o.scene->radius()};
        },
        wake);
}

} // namespace tessera
