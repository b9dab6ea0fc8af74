#include "render/paths/tracer.h"

#include "render/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <new>

namespace tessera {

namespace {

/// Interpolates an attribute of the corners at barycentric coordinates.
template <class T>
T interpolate(T a, T b, T c, glm::vec2 barycentric) {
    return (1 - barycentric.x - barycentric.y) * a + barycentric.x * b + barycentric.y * c;
}

/// Computes the derivatives of the position by u and v in the shape's space.
void shape_derivatives(const ShapeRecord& shape, const Hit& hit, glm::vec3& by_u, glm::vec3& by_v) {
    if (shape.quadric) {
        const auto [local_by_u, local_by_v] = shape.quadric->derivatives(hit.local);
        by_u = shape.quadric->vector(local_by_u);
        by_v = shape.quadric->vector(local_by_v);
        return;
    }
    const glm::uvec3 t = shape.triangles[hit.triangle];
    const glm::vec3 edge1 = shape.positions[t.y] - shape.positions[t.x];
    const glm::vec3 edge2 = shape.positions[t.z] - shape.positions[t.x];
    by_u = edge1; // without uvs, u and v are barycentric coordinates
    by_v = edge2;
    if (shape.uvs) {
        const glm::vec2 d1 = shape.uvs[t.y] - shape.uvs[t.x], d2 = shape.uvs[t.z] - shape.uvs[t.x];
        const float determinant = d1.x * d2.y - d1.y * d2.x;
        by_u = (d2.y * edge1 - d1.y * edge2) / determinant;
        by_v = (d1.x * edge2 - d2.x * edge1) / determinant;
    }
}

/// Computes the derivatives of the position by u and v. Returns false if the uvs are degenerate.
bool position_derivatives(const ShapeRecord& shape, const Hit& hit, glm::vec3& by_u, glm::vec3& by_v) {
    shape_derivatives(shape, hit, by_u, by_v);
    if (hit.placement) {
        by_u = hit.placement->vector(by_u);
        by_v = hit.placement->vector(by_v);
    }
    return std::isfinite(glm::dot(by_u, by_u) + glm::dot(by_v, by_v));
}

/// Returns the frame around a unit shading normal with its tangent along u. Without usable uvs the tangent
/// depends on the triangle's normal only, as in Mitsuba 3.
Frame frame_along_u(const ShapeRecord& shape, const Hit& hit, glm::vec3 geometric_normal, glm::vec3 normal) {
    glm::vec3 by_u, by_v;
    if (!shape.has_uv() || !position_derivatives(shape, hit, by_u, by_v))
        by_u = Frame(geometric_normal).tangent;
    return {normal, by_u};
}

/// Returns the unit shading normal, interpolated on a mesh, without bump or normal map. Sets `geometric_normal` to
/// the surface's normal on its front side.
glm::vec3 shading_normal(const ShapeRecord& shape, const Hit& hit, glm::vec3& geometric_normal) {
    geometric_normal = hit.geometric_normal;
    if (!shape.normals)
        return geometric_normal;
    const glm::uvec3 t = shape.triangles[hit.triangle];
    const glm::vec3 n0 = shape.normals[t.x], n1 = shape.normals[t.y], n2 = shape.normals[t.z];
    const glm::vec3 sum = n0 + n1 + n2;
    const float side =
        hit.placement ? hit.placement->side(sum, geometric_normal) : glm::dot(sum, geometric_normal);
    if (side < 0)
        geometric_normal = -geometric_normal; // as in front_normal()
    glm::vec3 n = interpolate(n0, n1, n2, hit.barycentric);
    if (hit.placement)
        n = hit.placement->of_normals * n;
    const float length = glm::length(n);
    return length > 0 ? n * (1 / length) : geometric_normal;
}

/// Returns -1 if a two-sided material is seen from its back, else 1.
float side_shown(const ShapeRecord& shape, glm::vec3 normal, glm::vec3 direction) {
    return shape.material->two_sided && glm::dot(normal, direction) > 0 ? -1.0f : 1.0f;
}

Frame shading_frame(const ShapeRecord& shape, const Hit& hit, glm::vec3 geometric_normal, glm::vec3 normal) {
    return shape.has_frame_along_u ? frame_along_u(shape, hit, geometric_normal, normal) : Frame(normal);
}

/// Returns `normal` changed by a bump or normal map: unit, on the same side.
glm::vec3 bend(const Relief& relief, const SurfacePoint& at, glm::vec3 normal, glm::vec3 by_u, glm::vec3 by_v) {
    glm::vec3 bent;
    if (relief.kind == Relief::Kind::bump) {
        // The surface moves along its normal by the height h: dp/du + n dh/du, with dp/du projected to the
        // tangent plane of the shading normal [Blinn 1978].
        const glm::vec2 gradient = relief.scale * relief.map.gradient(at);
        bent = glm::cross(by_u + normal * (gradient.x - glm::dot(normal, by_u)),
                          by_v + normal * (gradient.y - glm::dot(normal, by_v)));
    } else {
        const glm::vec3 coded = 2.0f * relief.map.evaluate(at) - 1.0f;
        const glm::vec3 tangent = glm::normalize(by_u - normal * glm::dot(normal, by_u));
        bent = coded.x * tangent + coded.y * glm::cross(normal, tangent) + coded.z * normal;
    }
    const float length = glm::length(bent);
    if (!(length > 0) || !std::isfinite(length))
        return normal;
    return bent * std::copysign(1 / length, glm::dot(bent, normal));
}

/// Returns Bsdf::terminator for a normal bent by an angle with this cosine [Estevez 2019, 12.3].
float terminator_of(const Relief& relief, float cosine) {
    const float tan2 = std::max(1 / (cosine * cosine) - 1, 0.0f);
    return relief.use_shadowing_function ? std::min(0.125f * tan2, 1.0f) : 0;
}

/// Returns the footprint of a beam on a surface: one side is the beam's width, the other is longer by 1 / cosine
/// [Igehy 1999].
TextureView::Sides sides_of(const TextureView::Beam& beam, glm::vec3 normal) {
    constexpr float least_cosine = 1e-3f;
    const float cosine = glm::dot(beam.direction, normal);
    const glm::vec3 tilt = beam.direction - cosine * normal;
    const float sine = glm::length(tilt);
    const glm::vec3 along = sine > 1e-4f ? tilt / sine : Frame(normal).tangent;
    const float width = TextureView::footprint_pixels * beam.width;
    return {along * (width / std::max(std::abs(cosine), least_cosine)), glm::cross(normal, along) * width};
}

void set_footprint(const TextureView::Sides& sides, glm::vec3 by_u, glm::vec3 by_v,
                   SurfacePoint::Footprint& footprint) {
    footprint.along = coordinates_along(sides.a, by_u, by_v);
    footprint.across = coordinates_along(sides.b, by_u, by_v);
}

/// Returns the position of a hit by its coordinates on the shape.
glm::vec3 position_on_shape(const ShapeRecord& shape, const Hit& hit) {
    glm::vec3 p;
    if (shape.quadric) {
        p = shape.quadric->position(hit.local);
    } else {
        const glm::uvec3 t = shape.triangles[hit.triangle];
        p = interpolate(shape.positions[t.x], shape.positions[t.y], shape.positions[t.z], hit.barycentric);
    }
    return hit.placement ? hit.placement->point(p) : p;
}

} // namespace

LightPoint Vertex::light_toward(glm::vec3 direction) const {
    const bool front = glm::dot(geometric_normal, direction) > 0;
    const auto kind = emitting_ball ? LightPoint::Kind::ball : LightPoint::Kind::surface;
    return {kind, position, geometric_normal, front ? emitted : Rgb(0), emitter_pdf, nullptr, emitting_ball};
}

std::optional<BsdfSample> Vertex::sample_guided(glm::vec3 to_viewer, float lobe, glm::vec2 u) const {
    const float share = guide->share;
    if (lobe >= share) {
        auto s = bsdf.sample(to_viewer, (lobe - share) / (1 - share), u);
        if (s)
            s->pdf_w = s->is_delta ? (1 - share) * s->pdf_w : guided_pdf_w(s->pdf_w, to_world(s->to_next));
        return s;
    }
    const DirectionMap::Sample drawn = guide->map.sample(lobe / share, u);
    const glm::vec3 to_next = to_local(drawn.direction);
    const BsdfValue v = bsdf.evaluate(to_viewer, to_next);
    if (is_black(v.f_cos))
        return {};
    const float pdf_w = (1 - share) * v.pdf_w + share * drawn.pdf_w;
    const bool transmits = to_next.z * to_viewer.z < 0;
    return std::make_optional<BsdfSample>(to_next, v.f_cos, pdf_w, false,
                                          transmits ? Scatter::transmit : Scatter::reflect);
}

Ray Tracer::beyond_emitters(Ray ray) const {
    constexpr int most = 64; // emitters, not tuned
    Hit hit;
    Vertex emitter;
    for (int i = 0; i < most && scene.intersector().closest(ray, hit); ++i) {
        if (scene.record(hit.shape).emitter_pdf <= 0)
            break;
        ++counters.rays[static_cast<std::size_t>(RayKind::camera)];
        make_vertex(scene, hit, ray, emitter);
        ray = leave(emitter, ray.direction);
    }
    return ray;
}

Rgb Tracer::very_direct_along(Ray ray) const {
    ray = visible_part(ray);
    Rgb sum(0), throughput(1);
    Vertex x;
    RayKind kind = RayKind::camera;
    TextureLookup seen = first_lookup();
    float width = view.initial_width();
    for (int edges = 1; edges <= settings.max_depth; ++edges) {
        const bool may_go_on = edges < settings.max_depth && scene.has_mirrors();
        const Met met = trace_emission(ray, x, kind, seen, may_go_on);
        if (met == Met::darkness)
            break;
        if (met == Met::infinity)
            return sum + throughput * (edges == 1 ? visible_environment(ray.direction)
                                                  : environment_toward(ray.direction).radiance);
        sum += throughput * x.light_toward(-ray.direction).radiance;
        const DeltaValue mirrored = may_go_on && x.bsdf.is_mirror()
                                        ? x.bsdf.evaluate_delta(x.to_previous, Scatter::reflect)
                                        : DeltaValue{};
        if (is_black(mirrored.value))
            break;
        throughput *= mirrored.value;
        width = width_beyond(width, glm::distance(ray.origin, x.position), true);
        seen = lookup(width, true);
        kind = RayKind::bounce;
        ray = leave(x, x.to_world(mirrored.to_next));
    }
    return sum;
}

void make_vertex(const Scene& scene, const Hit& hit, const Ray& ray, Vertex& v, const TextureView* view,
                 float width) {
    const ShapeRecord& shape = scene.record(hit.shape);
    v.position = ray.origin + hit.distance * ray.direction;
    // Over long distances, the point along the ray is less exact than Intersector::off_surface() assumes.
    if (shape.quadric || hit.distance > 8 * scene.radius()) [[unlikely]]
        v.position = position_on_shape(shape, hit);
    v.guide = nullptr;
    const glm::vec3 normal = shading_normal(shape, hit, v.geometric_normal);
    SurfacePoint at(hit.barycentric);
    if (shape.quadric) [[unlikely]] {
        at.uv = shape.quadric_uses_uv ? shape.quadric->uv(hit.local) : glm::vec2(0);
    } else if (shape.uvs) {
        const glm::uvec3 t = shape.triangles[hit.triangle];
        at.uv = interpolate(shape.uvs[t.x], shape.uvs[t.y], shape.uvs[t.z], hit.barycentric);
    }
    if (shape.attributed) {
        at.mesh = shape.attributed;
        at.on_mesh = {hit.triangle, hit.barycentric};
    } else if (glm::vec3 by_u, by_v; view && shape.has_uv() && position_derivatives(shape, hit, by_u, by_v)) {
        const bool is_own = width >= 0;
        const auto beam = [&] {
            return is_own ? TextureView::Beam{ray.direction, width + view->angle() * hit.distance}
                          : view->from_camera(v.position);
        };
        set_footprint(view->sides() ? *view->sides() : sides_of(beam(), v.geometric_normal), by_u, by_v,
                      at.footprint);
    }
    const float shown = side_shown(shape, normal, ray.direction);
    const Material& material = shown < 0 && shape.material->back ? *shape.material->back : *shape.material;
    // Constructed in place: a copy would wait for the stores just made.
    new (&v.bsdf) Bsdf(material.resolve(at));
    v.bsdf.terminator = -1;
    glm::vec3 bent = normal;
    if (material.relief) {
        glm::vec3 by_u, by_v;
        if (position_derivatives(shape, hit, by_u, by_v)) {
            bent = bend(*material.relief, at, normal, by_u, by_v);
            v.bsdf.terminator = terminator_of(*material.relief, glm::dot(normal, bent));
            v.bsdf.turns_relief = material.relief->turns_to_viewer;
        }
    }
    const bool is_mirrored = shown < 0 && material.relief && material.relief->is_mirrored_behind;
    const glm::vec3 facing = is_mirrored ? bent - 2 * glm::dot(bent, normal) * normal : shown * bent;
    const Frame frame = shading_frame(shape, hit, v.geometric_normal, facing);
    if (v.bsdf.has_relief())
        v.bsdf.interpolated_normal = frame.to_local(shown * normal);
    v.to_previous = frame.to_local(-ray.direction);
    v.frame = frame;
    // Emitter sampling evaluates points. Emission that both strategies can find must not be filtered either.
    v.emitted = !shape.emission_map  ? shape.emitted
                : view && width >= 0 ? shape.emission_map->filtered(at)
                                     : shape.emission_map->evaluate(at);
    v.emitter_pdf = shape.emitter_pdf;
    v.emitting_ball = nullptr;
    if (shape.quadric && shape.emitter_pdf > 0) [[unlikely]] {
        if (shape.quadric->is_ball())
            v.emitting_ball = shape.quadric;
        else
            v.emitter_pdf *= shape.quadric->pdf_a(hit.local);
    }
}

FeatureSample feature_sample_along(const Tracer& tracer, Ray ray, const Random& random) {
    constexpr int most_bounces = 8; // through glass; paths in mirrors follow base paths to max_depth
    FeatureSample sample{Rgb(0), {Rgb(1)}};
    SurfaceFeatures& features = sample.features;
    const glm::vec3 camera = ray.origin;
    ray = tracer.visible_part(ray);
    float length = glm::distance(camera, ray.origin);
    Vertex x;
    bool is_seen_in_mirrors = true; // and through no glass
    Tracer::TextureLookup seen = tracer.first_lookup();
    float width = tracer.view.initial_width();
    for (int i = 1; tracer.closest(ray, x, RayKind::feature, seen); ++i) {
        const float distance = glm::distance(ray.origin, x.position);
        length += distance;
        const bool is_mirror = x.bsdf.is_mirror() && tracer.mirrors_are_deterministic();
        if (is_seen_in_mirrors)
            sample.albedo = i > 1 || is_mirror ? tracer.albedo_in_mirrors(features.albedo, i, &x)
                                               : x.bsdf.albedo(x.to_previous);
        is_seen_in_mirrors = is_seen_in_mirrors && is_mirror;
        const bool is_mirror_or_glass = x.bsdf.roughness() <= 0;
        const int bounce_limit =
            is_seen_in_mirrors ? std::max(tracer.settings.max_depth, most_bounces) : most_bounces;
        const auto s = is_mirror_or_glass && i < bounce_limit
                           ? x.sample(random.draw(i, Draw::lobe), random.draw_2d(i, Draw::direction))
                           : std::nullopt;
        if (!s) {
            features.albedo *= x.bsdf.albedo(x.to_previous);
            features.normal = x.to_world({0, 0, 1});
            features.nearness = length > 0 ? 1 / length : 0;
            features.roughness = x.bsdf.roughness();
            break;
        }
        features.albedo *= s->f_cos / s->pdf_w;
        width = tracer.width_beyond(width, distance, s->is_delta);
        seen = tracer.lookup(width, is_seen_in_mirrors);
        ray = tracer.leave(x, x.to_world(s->to_next));
    }
    return sample;
}

} // namespace tessera
