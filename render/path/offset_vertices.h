#pragma once

#include "render/path/vertex.h"
#include "render/trace/pixel_lanes.h"

#include <vector>

namespace tessera {

/// f cos and pdf_w of one scattering in every lane.
struct BsdfLanes {
    Vec3Lanes f_cos;
    FloatLanes pdf_w;
};

/// Vertices of offset paths side by side, a lane a pixel of the sampling set.
class OffsetVertices {
public:
    /// `count` lanes, all without a vertex.
    void reset(int count);
    /// Keeps a reference.
    void set(int lane, const Vertex& vertex);

    int count() const { return count_; }
    const Vertex& operator[](int lane) const { return *vertices_[static_cast<std::size_t>(lane)]; }

    LaneMask exists;
    Vec3Lanes position;
    Vec3Lanes geometric_normal;
    FloatLanes roughness;

    /// The BSDFs for light that arrives along unit directions (world); lanes that are not asked for hold anything.
    void evaluate(const Vec3Lanes& to_next, const LaneMask& asked, BsdfLanes& values) const;

private:
    int count_ = 0;
    std::vector<const Vertex*> vertices_;
    Vec3Lanes normal_; // of shading
    FloatLanes to_previous_z_;
    Vec3Lanes reflectance_;   // of diffuse ones
    std::vector<int> others_; // lanes that are not diffuse
};

/// The BSDF of one vertex, in many lanes: light that arrives along `to_next` leaves along unit directions
/// `to_previous`, all in its frame.
void evaluate(const Bsdf& bsdf, const Vec3Lanes& to_previous, glm::vec3 to_next, const LaneMask& asked, int count,
              BsdfLanes& values);

} // namespace tessera
