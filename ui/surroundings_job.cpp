#include "ui/surroundings_job.h"

#include "render/session/first_hits.h"
#include "render/session/thread_priority.h"

#include <algorithm>

#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr int points_across = 48; // more of them would take a software driver most of its time
constexpr std::size_t most_lamps = 64;

/// The middles of the surfaces that give light, and the points.
std::vector<glm::vec3> lamps_of(const SceneDescription& scene) {
    std::vector<glm::vec3> lamps;
    for (const Shape& shape : scene.shapes) {
        const std::vector<glm::vec3>& p = shape.mesh.positions;
        if (shape.area_light < 0 || p.empty() || lamps.size() == most_lamps)
            continue;
        glm::vec3 min = p[0], max = p[0];
        for (glm::vec3 q : p) {
            min = glm::min(min, q);
            max = glm::max(max, q);
        }
        lamps.push_back((min + max) * 0.5f);
    }
    for (const PointLight& light : scene.point_lights)
        if (lamps.size() < most_lamps)
            lamps.push_back(light.position);
    return lamps;
}

} // namespace

std::shared_ptr<const Surroundings> SurroundingsJob::find(const Scene& scene, const View& view,
                                                          std::stop_token stop) {
    work_in_background();
    auto around = std::make_shared<Surroundings>();
    around->camera = view.camera;
    around->size = view.size;
    around->lamps = lamps_of(scene.description());
    const FirstHits hits = trace_first_hits(scene, view.camera, view.size, stop);
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
    if (const auto outcome = job_.poll(); outcome && !outcome->result) {
        state.add_message(Message::Kind::error, "What lies around the paths: " + outcome->error);
    } else if (outcome) {
        const bool first = state.space.surroundings == nullptr;
        state.space.surroundings = *outcome->result;
        state.space.fits = state.space.fits || first;
        state.redraw = true;
    }
    if (!state.scene || job_.running() || !(state.inspector.active || state.slow_motion.active))
        return;
    // A sample of an earlier request is seen among what was there then.
    const auto& sample = state.inspector.sample;
    const PassOrigin* origin =
        state.inspector.active && !state.slow_motion.active && sample ? sample->origin.get() : nullptr;
    const glm::vec2 whole(origin ? origin->size : state.request_size());
    const std::shared_ptr<const Scene> scene = origin ? origin->scene : state.scene;
    const View view{scene,
                    origin ? origin->camera : state.camera.camera(),
                    {points_across, std::max(static_cast<int>(points_across * whole.y / whole.x), 1)}};
    if (view == asked_)
        return;
    if (scene != asked_.scene.lock()) {
        state.space.surroundings = nullptr;
        state.space.fits = true;
    }
    asked_ = view;
    job_.start([scene, view](std::stop_token stop) { return find(*scene, view, stop); }, wake);
}

} // namespace tessera
