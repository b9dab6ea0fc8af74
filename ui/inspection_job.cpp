#include "ui/inspection_job.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace tessera {

void InspectionJob::update(ViewerState& state, const std::function<void()>& wake) {
    Inspector& inspector = state.inspector;
    if (const auto outcome = job_.poll()) {
        const auto& found = outcome->result;
        const bool is_same = found && inspector.inspection && inspector.pane == asked_.sample.pane &&
                             inspector.inspection->pixel == (*found)->pixel;
        state.space.fits = state.space.fits || !is_same; // but not at every pass that is followed
        inspector.pane = asked_.sample.pane;
        inspector.generation = asked_.generation;
        inspector.inspection = found.value_or(nullptr);
        if (!found)
            state.add_message(Message::Kind::error, outcome->error);
    }
    if (!inspector.active || !inspector.sample || !state.scene ||
        inspector.sample->pane >= static_cast<int>(state.panes.size()) || job_.running())
        return;
    const PaneState& pane = state.panes[static_cast<std::size_t>(inspector.sample->pane)];
    const Snapshot* snapshot = pane.snapshot.get();
    if (!snapshot || snapshot->generation != pane.generation || snapshot->coarse || snapshot->spp < 1)
        return;
    Asked wanted{snapshot->generation, *inspector.sample};
    if (!wanted.sample.pass) {
        wanted.sample.pass = asked_.sample.pass;
        if (!(wanted == asked_) || inspector.follows)
            wanted.sample.pass = snapshot->spp - 1;
    }
    if (!(wanted == asked_))
        start(state, wanted, wake);
}

void InspectionJob::start(const ViewerState& state, const Asked& asked, const std::function<void()>& wake) {
    asked_ = asked;
    const auto snapshot = state.panes[static_cast<std::size_t>(asked.sample.pane)].snapshot;
    const glm::ivec2 size(snapshot->images->primal.width(), snapshot->images->primal.height());
    const glm::ivec2 pixel = glm::clamp(asked.sample.pixel, glm::ivec2(0), size - 1);
    job_.start(
        [scene = state.scene, snapshot, size, pixel, pass = *asked.sample.pass](std::stop_token) {
            return std::make_shared<const Inspection>(
                inspect(*scene, snapshot->camera, size, snapshot->settings, *snapshot->plan, pass, pixel));
        },
        wake);
}

} // namespace tessera
