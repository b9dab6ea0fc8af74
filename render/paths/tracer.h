#pragma once

#include "render/paths/path_guiding.h"
#include "render/film/counters.h"
#include "render/film/pixel_features.h"
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

/// A point of a path on a surface, with everything that a scattering there needs: textures are looked up once.
struct Vertex {
    glm::vec3 position;
    glm::vec3 geometric_normal; ///< unit, of the triangle, on its front side
    Frame frame;                ///< of shading; on a two-sided material on the side of to_previous
    Bsdf bsdf;
    glm::vec3 to_previous;                 ///< unit, in `frame`
    Rgb emitted{0};                        ///< radiance given off on the front side; black: no light
    float emitter_pdf_a = 0;               ///< density of emitter sampling here, per area; 0: no light
    const DirectionGuide* guide = nullptr; ///< what a share of the directions is drawn from; null: none

    glm::vec3 to_local(glm::vec3 world) const { return frame.to_local(world); }
    glm::vec3 to_world(glm::vec3 local) const { return frame.to_world(local); }

    // The BSDF as paths sample it from here: with the guide, if there is one. Every pdf is that of both together.

    /// @param to_next  unit, in `frame`
    BsdfValue evaluate(glm::vec3 to_next) const {
        BsdfValue v = bsdf.evaluate(to_previous, to_next);
        if (guide)
            v.pdf_w = guided_pdf_w(v.pdf_w, to_world(to_next));
        return v;
    }
    DeltaValue evaluate_delta(Scatter scatter) const {
        DeltaValue v = bsdf.evaluate_delta(to_previous, scatter);
        v.probability *= guide ? 1 - guide->share : 1;
        return v;
    }
    std::optional<BsdfSample> sample(float lobe, glm::vec2 u) const { return sample_from(to_previous, lobe, u); }
    /// As if it were seen from another direction, unit, in `frame`.
    std::optional<BsdfSample> sample_from(glm::vec3 to_viewer, float lobe, glm::vec2 u) const {
        return guide ? sample_guided(to_viewer, lobe, u) : bsdf.sample(to_viewer, lobe, u);
    }
    /// Of a direction (unit, world), where there is a guide, by what the BSDF alone has.
    float guided_pdf_w(float bsdf_pdf_w, glm::vec3 direction) const {
        return (1 - guide->share) * bsdf_pdf_w + guide->share * guide->map.pdf_w(direction);
    }

    /// The light of this vertex toward a unit direction (world, away from the surface); black from behind.
    LightPoint light_toward(glm::vec3 direction) const;

private:
    std::optional<BsdfSample> sample_guided(glm::vec3 to_viewer, float lobe, glm::vec2 u) const;
};

/// Whoever sees a vertex that many share, and has no width of its own (TextureView).
inline constexpr float no_width = -1;

/// Makes `vertex` the one at `hit` on `ray`. (In place: a vertex is large, and paths are made of them.)
/// @param view   how wide what is looked up in textures is; null: they are not filtered
/// @param width  what a pixel that sees the hit along the ray itself has where the ray begins, or no_width
void make_vertex(const Scene& scene, const Hit& hit, const Ray& ray, Vertex& vertex,
                 const TextureView* view = nullptr, float width = no_width);

/// Shoots the rays of paths and counts them; knows the lights as emitter sampling sees them.
struct Tracer {
    const Scene& scene;
    Counters& counters;
    PathSettings settings;
    TextureView view{};
    const PathGuiding* guiding = nullptr; ///< null: paths are not guided
    std::vector<Hit>* hits = nullptr;     ///< vertices' own are added, as they are made; null: nobody asks

    /// The light of the environment from a unit direction; black: none.
    LightPoint environment_toward(glm::vec3 direction) const {
        return scene.lights().environment_toward(direction);
    }

    /// How wide what is looked up in textures is, as make_vertex() has it.
    struct TextureLookup {
        const TextureView* view;
        float width;
    };
    /// Of what rays from surfaces meet.
    /// @param is_in_mirrors  it is seen by the camera in mirrors alone: it is spared where x_1 is, as light is
    ///                       divided by its albedo
    TextureLookup lookup(float width = no_width, bool is_in_mirrors = false) const {
        const bool is_spared = is_in_mirrors && view.spares_first() && sees_the_same_in_mirrors();
        return {view.filter() == TextureFilter::off || is_spared ? nullptr : &view, width};
    }
    /// Of x_1, of which the width where camera rays begin is known.
    TextureLookup first_lookup() const {
        return view.spares_first() ? TextureLookup{nullptr, no_width} : lookup(view.first_width());
    }
    /// That of the pixel which sees what lies beyond a vertex, by that of the vertex.
    float width_beyond(float width, float distance, bool is_delta) const {
        const bool is_its_own = width >= 0 && is_delta && view.filter() == TextureFilter::path;
        return is_its_own ? width + view.angle() * distance : no_width;
    }

    /// Makes `vertex` what the ray meets first. False: it leaves the scene.
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

    enum class Met : std::uint8_t { light, darkness, infinity };

    /// Traces a ray on which only a light is of interest, or what may be a mirror if so asked: `vertex` is made
    /// where it meets one.
    Met closest_light(const Ray& ray, Vertex& vertex, RayKind kind, TextureLookup lookup,
                      bool or_mirror = false) const {
        if (!or_mirror && !scene.lights().may_be_hit(ray))
            return Met::darkness;
        ++counters.rays[static_cast<std::size_t>(kind)];
        Hit hit;
        if (!scene.intersector().closest(ray, hit))
            return Met::infinity;
        const ShapeRecord& shape = scene.record(hit.shape);
        if (shape.emitter_pdf_a <= 0 && !(or_mirror && shape.material->may_be_mirror()))
            return Met::darkness;
        if (hits) [[unlikely]]
            hits->push_back(hit);
        make_vertex(scene, hit, ray, vertex, lookup.view, lookup.width);
        return Met::light;
    }

    /// The light that a ray runs into; black: none. `scratch` is overwritten.
    LightPoint light_along(const Ray& ray, Vertex& scratch, RayKind kind, TextureLookup lookup) const {
        switch (closest_light(ray, scratch, kind, lookup)) {
        case Met::light:
            return scratch.light_toward(-ray.direction);
        case Met::infinity:
            return environment_toward(ray.direction);
        case Met::darkness:
            break;
        }
        return {};
    }

    /// Very direct light: what lights give off along a camera ray, at what it meets, and at what is seen there in
    /// mirrors.
    Rgb very_direct_along(Ray ray) const;

    /// Whether all that look into a mirror from one point see the same there, whatever numbers they draw: not
    /// where surfaces are there for one ray and not for another.
    bool sees_the_same_in_mirrors() const { return !scene.has_masks(); }
    /// About the albedo of a pixel that sees x_index in mirrors, which leave `throughput` of its light.
    /// @param seen  x_index; null: mirrors show nothing. That, another mirror, and what has no light path with an
    /// edge beyond it, count as next to black. Never 0, so that light can be divided by it.
    Rgb albedo_in_mirrors(Rgb throughput, int index, const Vertex* seen) const {
        const bool has_light = seen && !seen->bsdf.is_mirror() && index < settings.max_depth;
        const Rgb albedo = has_light ? throughput * seen->bsdf.albedo(seen->to_previous) : Rgb(0);
        return glm::max(albedo, Rgb(1e-4f));
    }

    /// The ray that leaves a vertex in a unit direction (world).
    Ray leave(const Vertex& from, glm::vec3 direction) const {
        return {scene.intersector().off_surface(from.position, from.geometric_normal, direction), direction};
    }

    /// The stretch between two surfaces, which lie in the unit direction `direction` of each other.
    Segment between(glm::vec3 from, glm::vec3 from_normal, glm::vec3 to, glm::vec3 to_normal,
                    glm::vec3 direction) const {
        return {scene.intersector().off_surface(from, from_normal, direction),
                scene.intersector().off_surface(to, to_normal, -direction)};
    }

    /// The stretch from a surface to a light that lies in the unit direction `direction` of it.
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

    /// Whether new edges of shifts, which share an end or are parallel, are blocked; traced in packets.
    void occluded(const SegmentLanes& segments, const LaneMask& asked, int count, LaneMask& blocked) const {
        std::uint64_t rays = 0;
        for (int lane = 0; lane < count; ++lane)
            rays += asked[lane] != 0;
        counters.rays[static_cast<std::size_t>(RayKind::shift_edge)] += rays;
        scene.intersector().occluded(segments, asked, count, blocked);
    }
};

/// Takes a feature sample along a camera ray. It follows mirrors and clear glass, and chooses between reflection
/// and refraction with `random`.
FeatureSample feature_sample_along(const Tracer& tracer, Ray ray, const Random& random);

} // namespace tessera
