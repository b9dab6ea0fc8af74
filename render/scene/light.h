#pragma once

#include "recon/image.h"
#include "render/scene/mesh.h"

#include <vector>

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

/// The lights of a scene, chosen in proportion to their power, by an alias table over all emitting triangles: the
/// choice costs the same for one and for thousands.
class LightTable {
public:
    LightTable() = default;
    LightTable(const std::vector<Shape>& shapes, const std::vector<AreaLight>& lights);

    bool empty() const { return entries_.empty(); }
    std::size_t size() const { return entries_.size(); }

    /// A point on a light; not for an empty table.
    LightPoint sample(float pick, glm::vec2 u) const;

    /// pdf_a at any point of a light.
    float pdf_a(int area_light) const { return pdf_a_[static_cast<std::size_t>(area_light)]; }

private:
    struct Entry {
        glm::vec3 corner, edge1, edge2, normal;
        int area_light;
        float threshold; // alias method [Walker 1974, Vose 1991]: below it this entry, else `alias`
        std::uint32_t alias;
    };
    std::vector<Entry> entries_;
    std::vector<Rgb> radiance_;
    std::vector<float> pdf_a_;
};

} // namespace tessera
