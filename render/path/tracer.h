#pragma once

#include "render/method/counters.h"
#include "render/path/vertex.h"
#include "render/scene/scene.h"

#include <optional>
#include <span>

namespace tessera {

/// Shoots the rays of paths and counts them.
struct Tracer {
    const Scene& scene;
    Counters& counters;

    /// Makes `vertex` what the ray meets first. False: it leaves the scene.
    bool closest(const Ray& ray, Vertex& vertex) const {
        ++counters.closest_hit_rays;
        Hit hit;
        if (!scene.intersector().closest(ray, hit))
            return false;
        make_vertex(scene, hit, ray, vertex);
        return true;
    }

    enum class Met : std::uint8_t { light, darkness, infinity };

    /// The same for a ray on which only a light is of interest: `vertex` is made where it meets one.
    Met closest_light(const Ray& ray, Vertex& vertex) const {
        if (!scene.lights().may_be_hit(ray))
            return Met::darkness;
        ++counters.closest_hit_rays;
        Hit hit;
        if (!scene.intersector().closest(ray, hit))
            return Met::infinity;
        if (scene.record(hit.shape).emitter_pdf_a <= 0)
            return Met::darkness;
        make_vertex(scene, hit, ray, vertex);
        return Met::light;
    }

    /// The light that a ray runs into; black: none. `scratch` is overwritten.
    LightPoint light_along(const Ray& ray, Vertex& scratch) const {
        switch (closest_light(ray, scratch)) {
        case Met::light:
            return scratch.light_toward(-ray.direction);
        case Met::infinity:
            return scene.lights().environment_toward(ray.direction);
        case Met::darkness:
            break;
        }
        return {};
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

    bool occluded(const Segment& segment) const {
        ++counters.occlusion_rays;
        return scene.intersector().occluded(segment);
    }

    /// The same for segments that share an end, as packets; writes 1 for a blocked one.
    void occluded(std::span<const Segment> segments, std::uint8_t* blocked) const {
        counters.occlusion_rays += segments.size();
        scene.intersector().occluded(segments, blocked);
    }
};

} // namespace tessera
