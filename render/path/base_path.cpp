#include "render/path/base_path.h"

#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// Next-event estimation at v: a point on a light, weighted against BSDF sampling by the balance heuristic
/// [Veach 1997, 9.2.2].
void sample_light(const Tracer& tracer, const Random& random, int index, BaseVertex& v) {
    const LightTable& lights = tracer.scene.lights();
    const Vertex& x = v.vertex;
    v.light_brings = Rgb(0);
    if (lights.empty() || x.bsdf.roughness() <= 0)
        return;
    if (!lights.sample(x.position, random, index, v.light))
        return;
    const std::optional<LightRay> seen = v.light.seen_from(x.position);
    if (!seen)
        return;
    v.to_light = x.to_local(seen->direction);
    const BsdfValue b = x.bsdf.evaluate(x.to_previous, v.to_light);
    if (is_black(b.f_cos) || tracer.occluded(tracer.toward_light(x, v.light, seen->direction)))
        return;
    v.light_pdf_w = seen->pdf_w;
    v.light_pdf_sum = seen->pdf_w + (v.light.can_be_hit() ? b.pdf_w : 0);
    v.light_brings = b.f_cos * seen->radiance / v.light_pdf_sum;
}

/// A light that BSDF sampling at v has met. `pdf_w` is that of emitter sampling there.
void add_hit(BaseVertex& v, Rgb radiance, float pdf_w) {
    v.hit_pdf_w = v.is_delta || is_black(radiance) ? 0 : pdf_w;
    v.hit_brings = radiance * (v.pdf_w / (v.pdf_w + v.hit_pdf_w));
}

/// BSDF sampling at v has left the scene.
void escape(const Tracer& tracer, BaseVertex& v, glm::vec3 direction) {
    if (!tracer.scene.lights().environment())
        return;
    const LightPoint light = tracer.scene.lights().environment_toward(direction);
    add_hit(v, light.radiance, light.pdf);
    v.escapes = true;
}

/// Samples the BSDF at the last vertex, x_index, and appends what lies in that direction; false: the path ends.
/// The vertex at max_depth is there for its emission alone.
bool extend(const Tracer& tracer, const Random& random, int index, int max_depth, BasePath& path) {
    BaseVertex& next = path.spare();
    BaseVertex& v = path[path.size() - 1];
    const Vertex& x = v.vertex;
    const auto s =
        x.bsdf.sample(x.to_previous, random.draw(index, Draw::lobe), random.draw_2d(index, Draw::direction));
    if (!s)
        return false;
    const glm::vec3 direction = x.to_world(s->to_next);
    const Ray ray = tracer.leave(x, direction);
    using Met = Tracer::Met;
    Met met = Met::light;
    if (index + 1 == max_depth)
        met = tracer.closest_light(ray, next.vertex);
    else if (!tracer.closest(ray, next.vertex))
        met = Met::infinity;
    if (met == Met::darkness)
        return false;
    v.to_next = s->to_next;
    v.f_cos = s->f_cos;
    v.pdf_w = s->pdf_w;
    v.is_delta = s->is_delta;
    v.scatter = s->scatter;
    if (met == Met::infinity) {
        escape(tracer, v, direction);
        return false;
    }
    const glm::vec3 d = next.vertex.position - x.position;
    const float distance2 = glm::dot(d, d);
    v.next_geometry = std::abs(glm::dot(next.vertex.geometric_normal, direction)) / distance2;
    if (!(v.next_geometry > 0) || !(distance2 > 0))
        return false;
    v.hit_pdf_w = 0;
    v.hit_brings = Rgb(0);
    if (next.vertex.emitter_pdf_a > 0) {
        const LightPoint light = next.vertex.light_toward(-direction);
        add_hit(v, light.radiance, light.pdf / v.next_geometry); // per area over geometry is per solid angle
    }
    next.escapes = false;
    next.light_brings = Rgb(0);
    path.keep();
    return true;
}

/// Sums the light from the far end to the camera, so that each vertex knows what arrives from beyond it.
void gather(BasePath& path) {
    Rgb toward_camera(0);
    for (int i = path.size() - 1; i >= 0; --i) {
        BaseVertex& v = path[i];
        v.arriving = toward_camera;
        toward_camera = v.light_brings;
        if (i + 1 < path.size() || v.escapes)
            toward_camera += v.f_cos * (v.hit_brings + v.arriving) / v.pdf_w;
    }
    path.radiance = toward_camera;
}

} // namespace

void trace_base_path(const Tracer& tracer, const Ray& camera_ray, int max_depth, const Random& random,
                     BasePath& path) {
    path.clear();
    path.very_direct = path.radiance = Rgb(0);
    ++tracer.counters.camera_paths;
    BaseVertex& primary = path.spare();
    if (!tracer.closest(camera_ray, primary.vertex)) {
        path.very_direct = tracer.scene.lights().environment_toward(camera_ray.direction).radiance;
        return;
    }
    primary.escapes = false;
    primary.light_brings = Rgb(0);
    path.keep();
    path.very_direct = primary.vertex.light_toward(-camera_ray.direction).radiance;
    // Emitter sampling at x_i makes i + 1 edges, and so does going on to x_{i+1} for its emission.
    for (int i = 1; i < max_depth; ++i) {
        sample_light(tracer, random, i, path[path.size() - 1]);
        if (!extend(tracer, random, i, max_depth, path))
            break;
    }
    tracer.counters.path_vertices += static_cast<std::uint64_t>(path.size());
    gather(path);
}

} // namespace tessera
