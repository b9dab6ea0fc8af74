#pragma once

#include "recon/image.h"
#include "render/scene/mesh.h"
#include "render/trace/ray.h"

#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// A mesh that gives off the same radiance from every point and in every direction of its front side.
struct AreaLight {
    Rgb radiance{1};
};

/// A point chosen on a light, whoever chose it: emitter sampling, or a ray that happened to hit it.
struct LightPoint {
    glm::vec3 position;
    glm::vec3 normal; ///< unit, the side that gives light
    Rgb radiance;     ///< given off toward the receiver
    float pdf_a;      ///< density of emitter sampling at this point, per area; does not depend on the receiver
};

/// An emitting triangle.
struct LightTriangle {
    glm::vec3 corner, edge1, edge2;
    glm::vec3 normal; ///< unit, the side that gives light
    Rgb radiance;
    float pdf_a; ///< of choosing this triangle and a point on it, per area

    /// Whether it sends light toward a point, from anywhere on it.
    bool faces(glm::vec3 point) const { return glm::dot(point - corner, normal) > 0; }
    LightPoint sample(glm::vec2 u) const;
};

/// The lights of a scene, chosen in proportion to their power, by an alias table over all emitting triangles: the
/// choice costs the same for one and for thousands.
class LightTable {
public:
    LightTable() = default;
    LightTable(const std::vector<Shape>& shapes, const std::vector<AreaLight>& lights);

    bool empty() const { return entries_.empty(); }
    std::size_t size() const { return entries_.size(); }

    /// Chooses a triangle with random numbers in [0, 1)^2; not for an empty table.
    const LightTriangle& choose(glm::vec2 u) const;

    /// pdf_a at any point of a light.
    float pdf_a(int area_light) const { return pdf_a_[static_cast<std::size_t>(area_light)]; }

    /// Whether the ray meets the box around all lights: cheaper than tracing it, where only lights count.
    bool may_be_hit(const Ray& ray) const;

private:
    struct Entry {
        LightTriangle triangle;
        float threshold; // alias method [Walker 1974, Vose 1991]: below it this entry, else `alias`
        std::uint32_t alias;
    };
    std::vector<Entry> entries_;
    std::vector<float> pdf_a_;
    glm::vec3 low_{0}, high_{0};
};

} // namespace tessera
