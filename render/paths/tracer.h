#pragma once

#include "render/film/counters.h"
#include "render/film/pixel_features.h"
#include "render/paths/path_guiding.h"
#include "render/sampling/sampling.h"
#include "render/scene/light.h"
#include "render/scene/scene.h"
#include "render/scene/texture_view.h"
#include "render/settings/settings.h"
#include "render/surface/bsdf.h"

#include <optional>
#include <vector>

namespace tessera {

class Scene;
struct Hit;
struct Ray;

/// Vertex of a path on a surface, with everything that scattering needs. Textures are already evaluated.
struct Vertex {
    glm::vec3 position;
    glm::vec3 geometric_normal; ///< unit, on the front side of the surface
    Frame frame;                ///< shading frame; on a two-sided material on the side of to_previous
    Bsdf bsdf;
    glm::vec3 to_previous;                  ///< unit, in `frame`
    Rgb emitted{0};                         ///< emitted radiance on the front side; black: no emitter
    float emitter_pdf = 0;                  ///< LightPoint::pdf of the emitter here; 0: no emitter
    const Quadric* emitting_ball = nullptr; ///< LightPoint::ball of the emitter here
    const DirectionGuide* guide = nullptr;  ///< null: the BSDF draws all directions

    glm::vec3 to_local(glm::vec3 world) const { return frame.to_local(world); }
    glm::vec3 to_world(glm::vec3 local) const { return frame.to_world(local); }

    // The BSDF as paths sample it. Every pdf includes the guide, theory (22).

    /// Returns f cos and the pdf per solid angle. @param to_next  unit, in `frame`
    BsdfValue evaluate(glm::vec3 to_next) const {
        BsdfValue v = bsdf.evaluate(to_previous, to_next);
        if (guide)
            v.pdf_w = guided_pdf_w(v.pdf_w, to_world(to_next));
        return v;
    }
    /// Returns the delta part; with a guide its probability is multiplied by 1 - s.
    DeltaValue evaluate_delta(Scatter scatter) const {
        DeltaValue v = bsdf.evaluate_delta(to_previous, scatter);
        v.probability *= guide ? 1 - guide->share : 1;
        return v;
    }
    std::optional<BsdfSample> sample(float lobe, glm::vec2 u) const { return sample_from(to_previous, lobe, u); }
    /// Samples as if the viewer were in direction `to_viewer`, a unit vector in `frame`.
    std::optional<BsdfSample> sample_from(glm::vec3 to_viewer, float lobe, glm::vec2 u) const {
        return guide ? sample_guided(to_viewer, lobe, u) : bsdf.sample(to_viewer, lobe, u);
    }
    /// Returns p_s of theory (22) for a unit direction (world). The vertex must have a guide.
    float guided_pdf_w(float bsdf_pdf_w, glm::vec3 direction) const {
        return (1 - guide->share) * bsdf_pdf_w + guide->share * guide->map.pdf_w(direction);
    }

    /// Returns the emission toward a unit direction (world, away from the surface); black from behind.
    LightPoint light_toward(glm::vec3 direction) const;

private:
    std::optional<BsdfSample> sample_guided(glm::vec3 to_viewer, float lobe, glm::vec2 u) const;
};

/// Pixel width for a vertex that several pixels reuse: its footprint must not depend on the pixel (TextureView).
inline constexpr float no_width = -1;

/// Sets `vertex` to the surface at `hit` on `ray`. It writes in place, because a vertex is large.
/// @param view   footprints for filtered textures; null: textures are not filtered
/// @param width  width at the ray's origin of the pixel that sees the hit, scene units; or no_width
void make_vertex(const Scene& scene, const Hit& hit, const Ray& ray, Vertex& vertex,
                 const TextureView* view = nullptr, float width = no_width);

/// Traces and counts the rays of paths, and evaluates the emission that they meet.
struct Tracer {
    const Scene& scene;
    Counters& counters;
    PathSettings settings;
    TextureView view{};
    const PathGuiding* guiding = nullptr; ///< null: paths are not guided
    std::vector<Hit>* hits = nullptr;     ///< receives the hit of each new vertex; null: not recorded

    /// Returns the environment in a unit direction (world); black: none.
    LightPoint environment_toward(glm::vec3 direction) const {
        return scene.lights().environment_toward(direction);
    }

    /// Arguments of make_vertex() for filtered textures.
    struct TextureLookup {
        const TextureView* view;
        float width;
    };
    /// Returns the lookup for a ray from a surface.
    /// @param is_in_mirrors  the camera sees the hit through mirrors only. It is then filtered only if x_1 is,
    ///                       because radiance is divided by its albedo.
    TextureLookup lookup(float width = no_width, bool is_in_mirrors = false) const {
        const bool is_spared = is_in_mirrors && view.first_unfiltered() && mirrors_are_deterministic();
        return {view.filter() == TextureFilter::off || is_spared ? nullptr : &view, width};
    }
    /// Returns the lookup for a camera ray.
    TextureLookup first_lookup() const {
        return view.first_unfiltered() ? TextureLookup{nullptr, no_width} : lookup(view.initial_width());
    }
    /// Returns the pixel width at the next vertex: grown by the distance after a delta scatter with
    /// TextureFilter::path, else no_width. @param width  at this vertex
    float width_beyond(float width, float distance, bool is_delta) const {
        const bool is_its_own = width >= 0 && is_delta && view.filter() == TextureFilter::path;
        return is_its_own ? width + view.angle() * distance : no_width;
    }

    /// Returns the part of a camera ray from which everything is visible. If the scene hides emitters, that is the
    /// part beyond the emitters in front of the first other surface, as in Mitsuba 3.
    Ray visible_part(const Ray& camera_ray) const {
        return scene.hides_emitters() && scene.lights().has_surfaces() ? beyond_emitters(camera_ray) : camera_ray;
    }
    /// Returns the environment that a camera sees in a unit direction (world); black: none, or it is hidden.
    Rgb visible_environment(glm::vec3 direction) const {
        return scene.hides_emitters() ? Rgb(0) : environment_toward(direction).radiance;
    }

    /// Sets `vertex` to the first hit of a ray. Returns false if the ray leaves the scene.
    bool closest(const Ray& ray, Vertex& vertex, RayKind kind, TextureLookup lookup) const {
        ++counters.rays[static_cast<std::size_t>(kind)];
        Hit hit;
        if (!scene.intersector().closest(ray, hit))
            return false;
        if (hits) [[unlikely]]
            hits->push_back(hit);
        make_vertex(scene, hit, ray, vertex, lookup.view, lookup.width);
        if (guiding && vertex.bsdf.roughness() >= PathGuiding::least_roughness)
            vertex.guide = guiding->at(vertex.position, vertex.frame.normal);
        return true;
    }

    /// Result of trace_emission(): an emitter (or mirror), a surface that is neither, or no surface.
    enum class Met : std::uint8_t { light, darkness, infinity };

    /// Traces a ray of which only the emission is needed. Sets `vertex` if it returns Met::light.
    /// @param or_mirror  accepts surfaces that may be mirrors, too
    Met trace_emission(const Ray& ray, Vertex& vertex, RayKind kind, TextureLookup lookup,
                       bool or_mirror = false) const {
        if (!or_mirror && !scene.lights().may_be_hit(ray))
            return Met::darkness;
        ++counters.rays[static_cast<std::size_t>(kind)];
        Hit hit;
        if (!scene.intersector().closest(ray, hit))
            return Met::infinity;
        const ShapeRecord& shape = scene.record(hit.shape);
        if (shape.emitter_pdf <= 0 && !(or_mirror && shape.material->may_be_mirror()))
            return Met::darkness;
        if (hits) [[unlikely]]
            hits->push_back(hit);
        make_vertex(scene, hit, ray, vertex, lookup.view, lookup.width);
        return Met::light;
    }

    /// Returns the emission at the end of a ray; black: none. Overwrites `scratch`.
    LightPoint light_along(const Ray& ray, Vertex& scratch, RayKind kind, TextureLookup lookup) const {
        switch (trace_emission(ray, scratch, kind, lookup)) {
        case Met::light:
            return scratch.light_toward(-ray.direction);
        case Met::infinity:
            return environment_toward(ray.direction);
        case Met::darkness:
            break;
        }
        return {};
    }

    /// Returns the directly visible emission along a camera ray: at its first hit, and in mirrors.
    Rgb very_direct_along(Ray ray) const;

    Ray beyond_emitters(Ray ray) const;

    /// Returns whether all rays from one point into a mirror see the same surface. Opacity masks, which some rays
    /// pass, prevent that.
    bool mirrors_are_deterministic() const { return !scene.has_masks(); }
    /// Returns the approximate albedo of a pixel that sees x_index through mirrors with this throughput. It is
    /// positive, because radiance is divided by it: 1e-4 if x_index (`seen`) is null, a mirror, or has no edge
    /// beyond it by max_depth.
    Rgb albedo_in_mirrors(Rgb throughput, int index, const Vertex* seen) const {
        const bool has_light = seen && !seen->bsdf.is_mirror() && index < settings.max_depth;
        const Rgb albedo = has_light ? throughput * seen->bsdf.albedo(seen->to_previous) : Rgb(0);
        return glm::max(albedo, Rgb(1e-4f));
    }

    /// Returns the ray that leaves a vertex in a unit direction (world).
    Ray leave(const Vertex& from, glm::vec3 direction) const {
        return {scene.intersector().off_surface(from.position, from.geometric_normal, direction), direction};
    }

    /// Returns the segment between two surface points. @param direction  unit, from the first to the second
    Segment between(glm::vec3 from, glm::vec3 from_normal, glm::vec3 to, glm::vec3 to_normal,
                    glm::vec3 direction) const {
        return {scene.intersector().off_surface(from, from_normal, direction),
                scene.intersector().off_surface(to, to_normal, -direction)};
    }

    /// Returns the segment from a surface to a light in the unit direction `direction`.
    Segment toward_light(const Vertex& from, const LightPoint& light, glm::vec3 direction) const {
        if (!light.is_at_infinity())
            return between(from.position, from.geometric_normal, light.position, light.normal, direction);
        const float way_out = 1.01f * (glm::distance(from.position, scene.center()) + scene.radius());
        const glm::vec3 start = scene.intersector().off_surface(from.position, from.geometric_normal, direction);
        return {start, start + way_out * direction};
    }

    bool occluded(const Segment& segment, RayKind kind) const {
        ++counters.rays[static_cast<std::size_t>(kind)];
        return scene.intersector().occluded(segment);
    }

    /// Finds which new edges of shifts are occluded. They share an end or are parallel, so they are traced in
    /// packets. Traces those of the first `count` that are set in `lanes`.
    void occluded(const SegmentLanes& segments, const LaneMask& lanes, int count, LaneMask& blocked) const {
        std::uint64_t rays = 0;
        for (int lane = 0; lane < count; ++lane)
            rays += lanes[lane] != 0;
        counters.rays[static_cast<std::size_t>(RayKind::shift_edge)] += rays;
        scene.intersector().occluded(segments, lanes, count, blocked);
    }
};

/// Takes a feature sample along a camera ray. It follows mirrors and clear glass, and chooses between reflection
/// and refraction with `random`.
FeatureSample feature_sample_along(const Tracer& tracer, Ray ray, const Random& random);

} // namespace tessera
