#include "render/paths/base_path.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

// Conventions of base paths. Vertices are x_1, x_2, ...; the camera is x_0. The throughput of a vertex is
//   f |cos| / (pdf_w q),
// where f |cos| is BSDF times cosine (BaseVertex::f_cos), pdf_w the pdf of BSDF sampling per solid angle (a
// probability for delta scatters), and q the survival probability of Russian roulette on path length. The
// throughput of a path is the product over its vertices.
//   It includes: the cosine at x_i, the choice of the lobe (in pdf_w), directions drawn from guides (in pdf_w),
//   and q. It excludes: the camera ray, which has weight 1; the MIS weight of the last step, which is a factor of
//   LightSample::brings and BaseVertex::hit_contribution; the weight of Russian roulette on reuse, which
//   PathReuse::share() applies; and division by the albedo of x_1 (demodulation), which Pass::albedo_of() and
//   coefficient() do.
// The roulette at x_i decides on the next step only, not on the light sample at x_i. So the contribution of that
// sample is the throughput of x_1 to x_{i-1} times LightSample::brings.

namespace tessera {

void BasePath::reset(const Random& numbers) {
    very_direct = direct = indirect = Rgb(0);
    albedo = Rgb(1);
    random = numbers;
    pixel_width = pixel_angle = own_width = 0;
    mirrors = 0;
    size_ = 0;
}

BaseVertex& BasePath::spare() {
    const auto n = static_cast<std::size_t>(size_);
    if (vertices_.size() == n)
        vertices_.emplace_back();
    if (lights_.size() == n)
        lights_.emplace_back();
    lights_[n].brings = Rgb(0);
    vertices_[n].escapes = false;
    return vertices_[n];
}

bool draw_light(const Tracer& tracer, const Vertex& x, const Random& random, int index, LightSample& drawn,
                Segment& way) {
    drawn.brings = Rgb(0);
    if (tracer.scene.lights().empty() || x.bsdf.roughness() <= 0)
        return false;
    if (!tracer.scene.lights().sample(x.position, random, index, drawn.light))
        return false;
    const std::optional<LightRay> seen = drawn.light.seen_from(x.position);
    if (!seen)
        return false;
    drawn.to_light = x.to_local(seen->direction);
    const BsdfValue b = x.evaluate(drawn.to_light);
    if (is_black(b.f_cos))
        return false;
    // The balance heuristic of emitter and BSDF sampling, theory (3) and (4) [Veach 1997, 9.2.2].
    drawn.f_cos = b.f_cos;
    drawn.pdf_w = seen->pdf_w;
    drawn.fixed_pdf_w = seen->fixed_pdf_w;
    drawn.pdf_sum = seen->pdf_w + (drawn.light.can_be_hit() ? b.pdf_w : 0);
    drawn.brings = b.f_cos * seen->radiance / drawn.pdf_sum;
    way = tracer.toward_light(x, drawn.light, seen->direction);
    return true;
}

namespace {

/// Estimates the direct light at x_index, the last vertex, by emitter sampling.
void sample_light(const Tracer& tracer, int index, RayKind kind, BasePath& path) {
    LightSample& drawn = path.light(path.size() - 1);
    Segment way;
    if (!draw_light(tracer, path[path.size() - 1].vertex, path.random, index, drawn, way))
        return;
    if (tracer.occluded(way, kind))
        drawn.brings = Rgb(0);
    else
        complete_light(tracer, drawn);
}

/// Stores the radiance of an emitter that BSDF sampling at v hits, with its MIS weight, theory (3) and (4).
/// @param pdf_w  of emitter sampling, per solid angle
void add_hit(BaseVertex& v, Rgb radiance, float pdf_w) {
    v.hit_pdf_w = v.is_delta || is_black(radiance) ? 0 : pdf_w;
    v.hit_contribution = radiance * (v.pdf_w / (v.pdf_w + v.hit_pdf_w));
}

/// Stores the environment's radiance for a path that leaves the scene at v.
void escape(const Tracer& tracer, BaseVertex& v, glm::vec3 direction) {
    if (!tracer.scene.lights().environment())
        return;
    const LightPoint light = tracer.environment_toward(direction);
    add_hit(v, light.radiance, light.pdf);
    v.escapes = true;
}

/// Returns the survival probability of Russian roulette on path length at x_index. It depends on this scattering
/// only, as in SmallVCM [Georgiev 2012], and not on the throughput so far: the end of a suffix must not depend on
/// the pixel, because all pixels that reuse the suffix must agree on its light paths. Refraction scales radiance
/// by the squared relative index and back at the other side; the probability cancels that factor. With a
/// guide, f cos / pdf is no measure of the loss, so the albedo replaces it. Delta scatters are the exception: no
/// guide draws them, and their pdf is lower in proportion, so as many paths continue as without a guide.
float path_survival(const PathSettings& settings, int index, const Vertex& x, const BsdfSample& s) {
    if (settings.roulette_depth == 0 || index < settings.roulette_depth)
        return 1;
    if (x.bsdf.is_mirror()) // no pixel reuses views in mirrors, and no filter smooths them
        return 1;
    if (x.guide && !s.is_delta) {
        const Rgb albedo = x.bsdf.albedo(x.to_previous);
        return std::clamp(std::max({albedo.r, albedo.g, albedo.b}), 0.1f, 0.95f);
    }
    const float relative = s.scatter == Scatter::transmit ? x.bsdf.relative_index(x.to_previous) : 1;
    return std::clamp(std::max({s.f_cos.r, s.f_cos.g, s.f_cos.b}) * relative * relative / s.pdf_w, 0.1f, 0.95f);
}

/// Samples the BSDF at the last vertex, x_index, and appends the next vertex. Returns false if the path ends. A
/// path uses the vertex at max_depth for its emission only.
bool extend(const Tracer& tracer, int index, RayKind kind, BasePath& path) {
    BaseVertex& next = path.spare();
    BaseVertex& v = path[path.size() - 1];
    const Vertex& x = v.vertex;
    const auto s = x.sample(path.random.draw(index, Draw::lobe), path.random.draw_2d(index, Draw::direction));
    if (!s)
        return false;
    v.survival = path_survival(tracer.settings, index, x, *s);
    if (v.survival < 1 && path.random.draw(index, Draw::path_survival) >= v.survival)
        return false;
    const glm::vec3 direction = x.to_world(s->to_next);
    const Ray ray = tracer.leave(x, direction);
    const Tracer::TextureLookup seen =
        tracer.lookup(tracer.width_beyond(path.own_width, 0, s->is_delta), path.mirrors == index);
    using Met = Tracer::Met;
    Met met = Met::light;
    if (index + 1 == tracer.settings.max_depth)
        met = tracer.trace_emission(ray, next.vertex, kind, seen);
    else if (!tracer.closest(ray, next.vertex, kind, seen))
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
    path.own_width = tracer.width_beyond(path.own_width, std::sqrt(distance2), s->is_delta);
    v.hit_pdf_w = 0;
    v.hit_contribution = Rgb(0);
    if (next.vertex.emitter_pdf > 0) {
        const LightPoint light = next.vertex.light_toward(-direction);
        add_hit(v, light.radiance, light.pdf_w(x.position, v.next_geometry));
    }
    path.keep();
    path.mirrors += path.mirrors == index && next.vertex.bsdf.is_mirror();
    return true;
}

/// Moves emission that is visible in mirrors from the path's light paths to directly visible emission. Sets the
/// path's albedo to that of the surface in the mirrors: demodulated radiance is as smooth there as on surfaces
/// that are visible without mirrors.
void look_into_mirrors(const Tracer& tracer, BasePath& path) {
    Rgb throughput(1);
    int i = 0;
    for (; i < path.mirrors; ++i) {
        BaseVertex& v = path[i];
        if (i + 1 == path.size() && !v.escapes)
            break;
        throughput *= v.throughput();
        path.very_direct += throughput * v.hit_contribution;
        v.hit_contribution = Rgb(0);
    }
    if (path.mirrors > 0 && tracer.mirrors_are_deterministic())
        path.albedo = tracer.albedo_in_mirrors(throughput, i + 1, i < path.size() ? &path[i].vertex : nullptr);
}

/// Sums radiance from the last vertex to the first, so each vertex stores the radiance that arrives from beyond.
void gather(BasePath& path) {
    Rgb toward_camera(0);
    for (int i = path.size() - 1; i >= 0; --i) {
        BaseVertex& v = path[i];
        v.arriving = toward_camera;
        Rgb here = path.light(i).brings;
        Rgb beyond(0);
        if (i + 1 < path.size() || v.escapes) {
            here += v.throughput() * v.hit_contribution;
            beyond = v.throughput() * v.arriving;
        }
        toward_camera = here + beyond;
        path.direct = here;
        path.indirect = beyond;
    }
}

/// Kinds of a path's rays, for the counters.
struct Purpose {
    RayKind bounce, light;
};

/// Extends a path from x_1, its only vertex. Samples light at x_1 to x_last.
void trace_onward(const Tracer& tracer, int last, Purpose purpose, BasePath& path) {
    // Emitter sampling at x_i makes a light path of i + 1 edges; so does a hit of an emitter at x_{i+1}.
    for (int i = 1; i <= last; ++i) {
        sample_light(tracer, i, purpose.light, path);
        if (!extend(tracer, i, purpose.bounce, path))
            break;
    }
    look_into_mirrors(tracer, path);
    gather(path);
}

/// Sets x_1 to the first hit of the camera ray. Returns false if there is none.
bool begin_path(const Tracer& tracer, const Ray& camera_ray, PixelWidth pixel_width, const Random& random,
                BasePath& path) {
    path.reset(random);
    BaseVertex& primary = path.spare();
    const Ray ray = tracer.visible_part(camera_ray);
    if (!tracer.closest(ray, primary.vertex, RayKind::camera, tracer.first_lookup())) {
        path.very_direct = tracer.visible_environment(camera_ray.direction);
        return false;
    }
    path.keep();
    path.mirrors = primary.vertex.bsdf.is_mirror();
    path.pixel_width = pixel_width.at(glm::distance(camera_ray.origin, primary.vertex.position));
    path.pixel_angle = pixel_width.angle;
    path.own_width = path.pixel_width;
    path.albedo = primary.vertex.bsdf.albedo(primary.vertex.to_previous);
    path.very_direct = primary.vertex.light_toward(-camera_ray.direction).radiance;
    return true;
}

} // namespace

void trace_base_path(const Tracer& tracer, const Ray& camera_ray, PixelWidth pixel_width, const Random& random,
                     BasePath& path) {
    ++tracer.counters.camera_paths;
    if (!begin_path(tracer, camera_ray, pixel_width, random, path))
        return;
    trace_onward(tracer, tracer.settings.max_depth - 1, {RayKind::bounce, RayKind::light}, path);
    tracer.counters.path_vertices += static_cast<std::uint64_t>(path.size());
}

void trace_first_vertex(const Tracer& tracer, const Ray& camera_ray, PixelWidth pixel_width, const Random& random,
                        BasePath& path) {
    if (!begin_path(tracer, camera_ray, pixel_width, random, path))
        return;
    for (int i = 1; i < tracer.settings.max_depth && path.mirrors == i; ++i)
        if (!extend(tracer, i, RayKind::bounce, path))
            break;
    look_into_mirrors(tracer, path);
    path.cut();
}

void replay_base_path(const Tracer& tracer, const BasePath& seen, const Random& random, int last, BasePath& path) {
    path.reset(random);
    path.spare().vertex = seen[0].vertex;
    path.mirrors = seen[0].vertex.bsdf.is_mirror();
    path.pixel_width = path.own_width = seen.pixel_width;
    path.pixel_angle = seen.pixel_angle;
    path.keep();
    trace_onward(tracer, std::min(last, tracer.settings.max_depth - 1),
                 {RayKind::shift_bounce, RayKind::shift_edge}, path);
}

/// Applies the join rule to the step from a vertex. @param apart  s_i of the vertex
LightPaths::Step LightPaths::step_from(const BasePath& path, const JoinRule& rule, int vertex, float apart) const {
    const BaseVertex& v = path[vertex];
    const float roughness = v.is_delta ? 0 : v.vertex.bsdf.roughness();
    if (v.escapes)
        return {apart, rule.covers(roughness, rule.turn(apart, std::numeric_limits<float>::infinity()))};
    const Vertex& next = path[vertex + 1].vertex;
    const float distance = glm::distance(v.vertex.position, next.position);
    const bool is_connectable = rule.covers(roughness, rule.turn(apart, distance));
    return {apart, is_connectable, is_connectable && rule.reaches_beyond(next.bsdf.roughness(), apart, distance)};
}

void LightPaths::reset(const BasePath& path, const ShiftSettings& settings) {
    carried_.clear();
    steps_.clear();
    join_ = 0;
    last_alive_ = -1;
    first_shared_ = settings.shift == ShiftKind::reconnection ? emitter_slot(1) : 0;
    const bool joins = settings.shift != ShiftKind::replay;
    const JoinRule rule(settings, path.pixel_angle);
    float apart = rule.apart(path.pixel_width);
    const int count = path.size();
    Rgb throughput(1);
    for (int i = 0; i < count; ++i) {
        const BaseVertex& v = path[i];
        carried_.push_back(throughput * path.light(i).brings);
        if (i + 1 == count && !v.escapes) {
            carried_.emplace_back(0);
            steps_.push_back({apart});
            break;
        }
        throughput *= v.throughput();
        carried_.push_back(throughput * v.hit_contribution);
        steps_.push_back(step_from(path, rule, i, apart));
        if (joins && i > 0 && step_joins(i - 1) && !v.is_delta) {
            join_ = i;
            carried_.push_back(throughput * v.arriving);
            break;
        }
        if (i + 1 < count)
            apart = rule.apart(apart, glm::distance(v.vertex.position, path[i + 1].vertex.position));
    }
    for (int slot = 0; slot < slot_count(); ++slot)
        if (!is_black(carried(slot)))
            last_alive_ = slot;
}

} // namespace tessera
