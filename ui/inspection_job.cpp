#include "ui/inspection_job.h"

#include "render/method/plan_replay.h"
#include "render/session/thread_priority.h"

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace tessera {

namespace {

bool is_within(glm::ivec2 pixel, glm::ivec2 size) {
    return glm::all(glm::greaterThanEqual(pixel, glm::ivec2(0))) && glm::all(glm::lessThan(pixel, size));
}

std::string outside_text(glm::ivec2 pixel, glm::ivec2 size) {
    return fmt::format("There is no pixel ({}, {}) to inspect: the picture has {} x {} pixels.", pixel.x, pixel.y,
                       size.x, size.y);
}

/// Where it was not kept, that of a late pass takes a while.
ReusePlan plan_of(const PassOrigin& o, int pass, glm::ivec2 pixel, std::stop_token stop) {
    return o.plan ? *o.plan : replay_plan(*o.scene, o.camera, o.size, o.settings, pass, pixel, stop);
}

} // namespace

void InspectionJob::take(ViewerState& state) {
    const auto outcome = job_.poll();
    if (!outcome)
        return;
    Inspector& inspector = state.inspector;
    if (inspector.sample != asked_.sample) { // another was chosen since
        asked_ = {};
        return;
    }
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
    if (!inspector.active && (inspector.sample->origin || job_.running()))
        give_up();
    if (!inspector.active && inspector.sample->origin) {
        inspector.sample.reset();
        inspector.inspection.reset();
    } else if (!inspector.sample->origin && !state.pane_in(inspector.sample->slot)) {
        inspector.sample->slot = state.active().slot;
    }
}

void InspectionJob::give_up() {
    job_.cancel();
    asked_ = {};
}

/// Null: its pane shows nothing yet that could be looked at. A given pass needs no picture.
std::shared_ptr<const PassOrigin> InspectionJob::origin_of(const ViewerState& state,
                                                           const SampleChoice& sample) const {
    if (sample.origin)
        return sample.origin;
    const PaneState& pane = *state.pane_in(sample.slot);
    if (sample.pass)
        return std::make_shared<const PassOrigin>(PassOrigin{
            state.scene, state.camera.camera(), state.request_size(), pane.settings.render, {}, pane.generation});
    const Snapshot* s = pane.snapshot.get();
    if (!s || s->generation != pane.generation || s->coarse() || s->spp < 1)
        return nullptr;
    const glm::ivec2 size(s->images->primal.width(), s->images->primal.height());
    return std::make_shared<const PassOrigin>(
        PassOrigin{state.scene, s->camera, size, s->settings, s->plan, s->generation});
}

/// The newest, where none is given; it then stays, unless the inspector follows.
int InspectionJob::pass_of(const ViewerState& state, const PassOrigin& origin, const SampleChoice& sample) const {
    if (sample.pass)
        return *sample.pass;
    if (asked_.is_of(origin, sample) && !state.inspector.follows)
        return asked_.pass;
    return state.pane_in(sample.slot)->snapshot->spp - 1;
}

void InspectionJob::update(ViewerState& state, const std::function<void()>& wake) {
    take(state);
    drop_what_is_gone(state);
    Inspector& inspector = state.inspector;
    if (!inspector.active || !inspector.sample || !state.scene)
        return;
    const SampleChoice sample = *inspector.sample;
    const std::shared_ptr<const PassOrigin> origin = origin_of(state, sample);
    // What is under way is given up for another sample only: else it might never come to an end.
    if (!origin || (job_.running() && asked_.is_of(*origin, sample)))
        return;
    if (sample.pass && !is_within(sample.pixel, origin->size)) {
        give_up();
        inspector.sample.reset();
        inspector.inspection.reset(); // where the picture was larger before
        return state.add_message(Message::Kind::error, outside_text(sample.pixel, origin->size));
    }
    const Asked wanted{origin->generation, sample, pass_of(state, *origin, sample)};
    if (!(wanted == asked_))
        start(origin, wanted, wake);
}

void InspectionJob::start(const std::shared_ptr<const PassOrigin>& origin, const Asked& wanted,
                          const std::function<void()>& wake) {
    asked_ = wanted;
    const glm::ivec2 pixel = glm::clamp(wanted.sample.pixel, glm::ivec2(0), origin->size - 1);
    job_.start(
        [origin, pixel, pass = wanted.pass](std::stop_token stop) {
            work_in_background();
            const PassOrigin& o = *origin;
            const ReusePlan plan = plan_of(o, pass, pixel, stop);
            if (stop.stop_requested())
                return Found{};
            return Found{std::make_shared<const Inspection>(
                             inspect(*o.scene, o.camera, o.size, o.settings, plan, pass, pixel)),
                         o.scene->radius()};
        },
        wake);
}

} // namespace tessera
