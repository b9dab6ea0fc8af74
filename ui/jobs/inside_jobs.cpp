#include "render/inspect/inspection.h"
#include "render/run/first_hits.h"
#include "render/run/thread_pool.h"
#include "render/scene/scene.h"
#include "ui/jobs/jobs.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
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

/// Returns the LearnedReuse of the pass: the stored one, or one learned again, which takes long for a late pass.
LearnedReuse learned_reuse_of(const PassOrigin& o, int pass, glm::ivec2 pixel, std::stop_token stop) {
    return o.learned ? *o.learned : replay_learning(*o.scene, o.camera, o.size, o.settings, pass, pixel, stop);
}

} // namespace

void InspectionJob::take(ViewerState& state) {
    const auto outcome = job_.take();
    if (!outcome)
        return;
    const Request& asked = outcome->request;
    Inspector& inspector = state.inspector;
    if (inspector.sample != asked.sample) // another sample has been chosen
        return job_.cancel();
    const Found found = outcome->result.value_or(Found{});
    const bool is_same = found.inspection && inspector.inspection && inspector.slot == asked.sample.slot &&
                         inspector.inspection->pixel == found.inspection->pixel;
    state.space.fits = state.space.fits || !is_same; // not after each pass of the same pixel
    inspector.slot = asked.sample.slot;
    inspector.generation = asked.generation;
    inspector.scene_radius = found.scene_radius;
    inspector.inspection = found.inspection;
    state.wishes.redraw = true;
    if (!outcome->result)
        state.add_message(Message::Kind::error, outcome->error);
}

/// Moves a sample of a closed pane to the active pane. Drops a sample that has its own PassOrigin when the
/// inspector closes, because it would keep a scene alive that may have been replaced.
void InspectionJob::drop_stale_sample(ViewerState& state) {
    Inspector& inspector = state.inspector;
    if (!inspector.sample)
        return;
    if (!inspector.active && (inspector.sample->origin || job_.running()))
        job_.cancel();
    if (!inspector.active && inspector.sample->origin) {
        inspector.sample.reset();
        inspector.inspection.reset();
    } else if (!inspector.sample->origin && !state.pane_in(inspector.sample->slot)) {
        inspector.sample->slot = state.active().slot;
    }
}

/// Whether the last request was for this sample of this render, in any pass.
bool InspectionJob::has_asked(const PassOrigin& origin, const SampleChoice& sample) const {
    return job_.asked() && job_.asked()->generation == origin.generation && job_.asked()->sample == sample;
}

/// Returns the render from which the sample is traced again. Null: the newest pass is wanted, and the pane shows
/// no pass of its current request.
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
        PassOrigin{state.scene, s->camera, size, s->settings, s->learned, s->generation});
}

/// Returns the given pass, or the newest. The newest is updated after each pass only if the inspector follows.
int InspectionJob::pass_of(const ViewerState& state, const PassOrigin& origin, const SampleChoice& sample) const {
    if (sample.pass)
        return *sample.pass;
    if (has_asked(origin, sample) && !state.inspector.follows)
        return job_.asked()->pass;
    return state.pane_in(sample.slot)->snapshot->spp - 1;
}

void InspectionJob::update(ViewerState& state, const std::function<void()>& wake) {
    take(state);
    drop_stale_sample(state);
    Inspector& inspector = state.inspector;
    if (!inspector.active || !inspector.sample || !state.scene)
        return;
    const SampleChoice sample = *inspector.sample;
    const std::shared_ptr<const PassOrigin> origin = origin_of(state, sample);
    // Only another sample cancels the inspection under way. A newer pass of the same sample does not, because the
    // inspection might never be complete.
    if (!origin || (job_.running() && has_asked(*origin, sample)))
        return;
    if (sample.pass && !is_within(sample.pixel, origin->size)) {
        job_.cancel();
        inspector.sample.reset();
        inspector.inspection.reset();
        return state.add_message(Message::Kind::error, outside_text(sample.pixel, origin->size));
    }
    ask(origin, {origin->generation, sample, pass_of(state, *origin, sample)}, wake);
}

void InspectionJob::ask(const std::shared_ptr<const PassOrigin>& origin, const Request& request,
                        const std::function<void()>& wake) {
    const glm::ivec2 pixel = glm::clamp(request.sample.pixel, glm::ivec2(0), origin->size - 1);
    job_.ask(
        request,
        [origin, pixel, pass = request.pass](std::stop_token stop) {
            lower_priority();
            const PassOrigin& o = *origin;
            const LearnedReuse learned = learned_reuse_of(o, pass, pixel, stop);
            if (stop.stop_requested())
                return Found{};
            return Found{std::make_shared<const Inspection>(
                             inspect(*o.scene, o.camera, o.size, o.settings, learned, pass, pixel)),
                         o.scene->radius()};
        },
        wake);
}

void SlowMotionJob::update(ViewerState& state, float seconds, const std::function<void()>& wake) {
    SlowMotion& slow = state.slow_motion;
    if (const auto outcome = job_.take()) {
        if (outcome->result) {
            slow.take(*outcome->result, outcome->request.sample.slot, outcome->request.generation);
            state.space.fits = state.wishes.redraw = true;
        } else {
            state.add_message(Message::Kind::error, outcome->error);
        }
    }
    if (!slow.active) {
        if (slow.view_before) // restores the view of the pictures
            state.display.view = *std::exchange(slow.view_before, std::nullopt);
        job_.cancel();
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

/// Chooses a tile of the active pane, at the first of these pixels that exists: the slow motion's in another pane,
/// the inspector's, the pixel under the mouse, the middle.
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
    else if (state.layout.cursor && state.layout.cursor->pane == state.active_pane)
        pixel = glm::ivec2(state.layout.cursor->place * size);
    slow.start({state.active().slot, pixel, {}});
}

void SlowMotionJob::ask(ViewerState& state, const std::function<void()>& wake) {
    SlowMotion& slow = state.slow_motion;
    const PaneState& pane = state.active(); // as in choose()
    const auto snapshot = pane.snapshot;
    if (!snapshot || snapshot->generation != pane.generation || snapshot->coarse() || snapshot->spp < 1)
        return;
    const glm::ivec2 size(snapshot->images->primal.width(), snapshot->images->primal.height());
    slow.sample->pixel = glm::clamp(slow.sample->pixel, glm::ivec2(0), size - 1); // the picture may have shrunk
    job_.ask(
        {snapshot->generation, *slow.sample},
        [scene = state.scene, snapshot, size, pixel = slow.sample->pixel](std::stop_token) {
            return std::make_shared<const TileInspection>(inspect_tile(
                *scene, snapshot->camera, size, snapshot->settings, *snapshot->learned, snapshot->spp - 1, pixel));
        },
        wake);
}

namespace {

constexpr int points_across = 48; // more points are slow to draw without a GPU
constexpr std::size_t max_lights = 64;

/// Returns the centres of area lights and the positions of point lights, at most max_lights.
std::vector<glm::vec3> light_positions(const SceneDescription& scene) {
    std::vector<glm::vec3> lamps;
    for (const Shape& shape : scene.shapes) {
        const std::vector<glm::vec3>& p = shape.mesh.positions;
        if (shape.area_light < 0 || lamps.size() == max_lights)
            continue;
        if (shape.quadric) {
            const Quadric::Bounds box = shape.quadric->bounds();
            lamps.push_back((box.low + box.high) * 0.5f);
        }
        if (p.empty())
            continue;
        glm::vec3 min = p[0], max = p[0];
        for (glm::vec3 q : p) {
            min = glm::min(min, q);
            max = glm::max(max, q);
        }
        lamps.push_back((min + max) * 0.5f);
    }
    for (const PointLight& light : scene.point_lights)
        if (lamps.size() < max_lights)
            lamps.push_back(light.position);
    return lamps;
}

} // namespace

std::shared_ptr<const Surroundings> SurroundingsJob::find(const Scene& scene, const View& view,
                                                          std::stop_token stop) {
    lower_priority();
    auto around = std::make_shared<Surroundings>();
    around->camera = view.camera;
    around->size = view.size;
    around->lamps = light_positions(scene.description());
    const FirstHits hits = trace_first_hits(scene, view.camera, view.size, false, stop);
    const Projection projection(view.camera, view.size);
    for (int y = 0; y < hits.depth.height(); ++y)
        for (int x = 0; x < hits.depth.width(); ++x) {
            const Ray ray = projection.ray(glm::vec2(x, y) + 0.5f);
            if (hits.depth(x, y) <= 0)
                continue;
            around->points.push_back(ray.origin + hits.depth(x, y) * ray.direction);
            around->albedo.push_back(hits.albedo(x, y));
        }
    return around;
}

void SurroundingsJob::update(ViewerState& state, const std::function<void()>& wake) {
    if (const auto outcome = job_.take(); outcome && !outcome->result) {
        state.add_message(Message::Kind::error,
                          "Tracing the surroundings of the paths has failed: " + outcome->error);
    } else if (outcome) {
        const bool first = state.space.surroundings == nullptr;
        state.space.surroundings = *outcome->result;
        state.space.fits = state.space.fits || first;
        state.wishes.redraw = true;
    }
    if (!state.scene || job_.running() || !(state.inspector.active || state.slow_motion.active))
        return;
    // A sample that has its own PassOrigin is shown in the scene and with the camera of that render.
    const auto& sample = state.inspector.sample;
    const PassOrigin* origin =
        state.inspector.active && !state.slow_motion.active && sample ? sample->origin.get() : nullptr;
    const glm::vec2 whole(origin ? origin->size : state.request_size());
    const std::shared_ptr<const Scene> scene = origin ? origin->scene : state.scene;
    const View view{scene,
                    origin ? origin->camera : state.camera.camera(),
                    {points_across, std::max(static_cast<int>(points_across * whole.y / whole.x), 1)}};
    if (!job_.asked() || view.scene != job_.asked()->scene) {
        state.space.surroundings = nullptr;
        state.space.fits = true;
    }
    job_.ask(view, [scene, view](std::stop_token stop) { return find(*scene, view, stop); }, wake);
}

} // namespace tessera
