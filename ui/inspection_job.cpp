#include "ui/inspection_job.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace tessera {

void InspectionJob::take(ViewerState& state) {
    const auto outcome = job_.poll();
    if (!outcome)
        return;
    Inspector& inspector = state.inspector;
    const auto& found = outcome->result;
    const bool is_same = found && inspector.inspection && inspector.pane == asked_.sample.pane &&
                         inspector.inspection->pixel == (*found)->pixel;
    state.space.fits = state.space.fits || !is_same; // but not at every pass that is followed
    inspector.pane = asked_.sample.pane;
    inspector.generation = asked_.generation;
    inspector.origin = origin_;
    inspector.inspection = found.value_or(nullptr);
    state.redraw = true;
    if (!found)
        state.add_message(Message::Kind::error, outcome->error);
}

/// Null: its pane shows nothing yet that could be looked at.
std::shared_ptr<const PassOrigin> InspectionJob::origin_of(const ViewerState& state,
                                                           const SampleChoice& sample) const {
    if (sample.origin)
        return sample.origin;
    if (sample.pane >= static_cast<int>(state.panes.size()))
        return nullptr;
    const PaneState& pane = state.panes[static_cast<std::size_t>(sample.pane)];
    const Snapshot* s = pane.snapshot.get();
    if (!s || s->generation != pane.generation || s->coarse || s->spp < 1)
        return nullptr;
    const glm::ivec2 size(s->images->primal.width(), s->images->primal.height());
    return std::make_shared<const PassOrigin>(
        PassOrigin{state.scene, s->camera, size, s->settings, s->plan, s->generation});
}

void InspectionJob::update(ViewerState& state, const std::function<void()>& wake) {
    take(state);
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
            wanted.sample.pass = state.panes[static_cast<std::size_t>(wanted.sample.pane)].snapshot->spp - 1;
    }
    if (wanted == asked_)
        return;
    asked_ = wanted;
    origin_ = origin;
    const glm::ivec2 pixel = glm::clamp(wanted.sample.pixel, glm::ivec2(0), origin->size - 1);
    job_.start(
        [origin, pixel, pass = *wanted.sample.pass](std::stop_token) {
            const PassOrigin& o = *origin;
            return std::make_shared<const Inspection>(
                inspect(*o.scene, o.camera, o.size, o.settings, *o.plan, pass, pixel));
        },
        wake);
}

} // namespace tessera
