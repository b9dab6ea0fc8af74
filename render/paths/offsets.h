#pragma once

#include "recon/image.h"
#include "render/paths/tracer.h"
#include "render/trace/rays.h"

#include <limits>
#include <memory>
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
    const Vertex& operator[](int lane) const { return *vertices_[lane]; }

    LaneMask exists;
    Vec3Lanes position;
    Vec3Lanes geometric_normal;
    FloatLanes roughness;

    /// Vertex::evaluate() for light that arrives along unit directions (world); lanes that are not asked for hold
    /// anything.
    void evaluate(const Vec3Lanes& to_next, const LaneMask& asked, BsdfLanes& values) const;

private:
    int count_ = 0;
    std::vector<const Vertex*> vertices_;
    Vec3Lanes normal_; // of shading
    FloatLanes to_previous_z_;
    Vec3Lanes reflectance_;   // of diffuse ones
    std::vector<int> others_; // lanes that are not diffuse
    std::vector<int> guided_; // lanes whose vertices have a guide
};

/// The BSDF of one vertex, in many lanes: light that arrives along `to_next` leaves along unit directions
/// `to_previous`, all in its frame. Each pdf is Vertex::evaluate()'s.
void evaluate(const Vertex& x, const Vec3Lanes& to_previous, glm::vec3 to_next, const LaneMask& asked, int count,
              BsdfLanes& values);

/// What became of one light path x of a base path of pixel k in each offset pixel m, a lane a pixel
/// (METHODS.md, "The weight"):
///   ratio = r_m = P_m(y_m) |J| / P_k(x), where y_m is the shifted path, P the density with which a pixel's
///   samplers
///           make a path, summed over strategies, and J the shift's Jacobian; no unit, 0: the shift failed
///   value = c_m = f_m(y_m) |J| / P_k(x), radiance; divided by the survival of the roulette on path length
/// [Bekaert 2002, 4; Bauszat 2017, eq. 8]. The base's own ratio is 1, and not in its lane, which stays 0.
struct OffsetRow {
    FloatLanes ratio;
    Vec3Lanes value;

    /// A path that carries nothing counts as failed: the same is said of base paths, so that both sides agree. So
    /// does one that is beyond what floats hold.
    void set(int m, float new_ratio, Rgb new_value) {
        constexpr float largest = 3e38f; // a NaN fails every comparison
        const bool is_lit = (new_value.r > 0) | (new_value.g > 0) | (new_value.b > 0);
        const bool counts =
            is_lit & (new_ratio > 0) & (new_ratio + new_value.r + new_value.g + new_value.b <= largest);
        ratio[m] = counts ? new_ratio : 0.0f;
        value.x[m] = counts ? new_value.r : 0.0f;
        value.y[m] = counts ? new_value.g : 0.0f;
        value.z[m] = counts ? new_value.b : 0.0f;
    }
    void fail(int m) {
        ratio[m] = 0;
        value.set(m, Rgb(0));
    }
};

/// How offset paths leave y_1, a lane a pixel; anything where the path fails.
struct FirstScatter {
    static constexpr float infinite = std::numeric_limits<float>::infinity();

    Vec3Lanes direction; ///< unit, world
    Vec3Lanes f_cos;     ///< infinite: a delta scatter
};

/// The rows of all light paths, as slots (LightPaths).
class OffsetPaths {
public:
    /// All have failed as yet.
    /// @param keeps_scatters  whether anybody wants to know of first_scatter()
    void reset(int slots, int offsets, bool keeps_scatters = false) {
        offsets_ = offsets;
        used_scatters_ = 0;
        scatter_of_slot_.assign(keeps_scatters ? static_cast<std::size_t>(slots) : 0, -1);
        while (rows_.size() < static_cast<std::size_t>(slots))
            rows_.push_back(std::make_unique<OffsetRow>());
        for (int slot = 0; slot < slots; ++slot)
            for (int m = 0; m < padded(offsets); ++m)
                row(slot).fail(m);
    }

    int offsets() const { return offsets_; }
    OffsetRow& row(int slot) { return *rows_[slot]; }
    const OffsetRow& row(int slot) const { return *rows_[slot]; }
    float ratio(int slot, int m) const { return row(slot).ratio[m]; }
    Rgb value(int slot, int m) const { return row(slot).value[m]; }

    bool keeps_scatters() const { return !scatter_of_slot_.empty(); }
    /// The scatter at y_1 that those of the slots [first, end) have which have none yet; to be filled in. Only
    /// where scatters are kept.
    FirstScatter& add_first_scatter(int first_slot, int end_slot);
    /// Which first scatter the slot goes through; -1: none is known.
    int scatter_index(int slot) const { return scatter_of_slot_[slot]; }
    const FirstScatter& first_scatter(int index) const { return *scatters_[index]; }

private:
    int offsets_ = 0;
    std::vector<std::unique_ptr<OffsetRow>> rows_; // never shrinks
    std::vector<int> scatter_of_slot_;
    std::vector<std::unique_ptr<FirstScatter>> scatters_; // never shrinks
    int used_scatters_ = 0;
};

/// How the vertices of offset paths see one point that they are joined to, a lane a pixel.
struct SightLanes {
    LaneMask valid;       ///< asked for, and the point is to be seen from the right side
    Vec3Lanes direction;  ///< unit, world, toward the point
    FloatLanes geometry;  ///< |cos| at the point over the squared distance: solid angle over area
    FloatLanes distance2; ///< squared, to the point; infinite for directions
};

/// Joins vertices to a point on a surface.
/// @param one_sided  only from the side of `normal`
void connect_to_point(const OffsetVertices& y, const LaneMask& asked, glm::vec3 point, glm::vec3 normal,
                      bool one_sided, SightLanes& sight);

/// What arrives at the vertices from a point on a light, a lane a pixel.
struct LightLanes {
    Vec3Lanes radiance;
    FloatLanes pdf_w; ///< of emitter sampling there (LightRay::pdf_w)
};

/// Joins vertices to a point on a light, or at infinity to a direction.
void connect_to_light(const OffsetVertices& y, const LaneMask& asked, const LightPoint& light, SightLanes& sight,
                      LightLanes& arriving);

/// Sets the stretches from vertices to a point on a surface, which lies in the unit directions `direction`.
void edges_to_point(const Tracer& tracer, const OffsetVertices& y, const Vec3Lanes& direction, glm::vec3 point,
                    glm::vec3 normal, SegmentLanes& segments);
/// Sets the stretches from vertices to a light, which may be at infinity.
void edges_to_light(const Tracer& tracer, const OffsetVertices& y, const Vec3Lanes& direction,
                    const LightPoint& light, SegmentLanes& segments);

/// New edges of offset paths, a lane a pixel, that may be blocked. They all end in the same point, a light
/// (perhaps at infinity) or a base vertex, so that their rays are traced together; a blocked one fails the slots
/// [first_slot, end_slot).
struct EdgeGroup {
    SegmentLanes segments;
    LaneMask exists;
    int first_slot, end_slot;
};

/// The edges of all shifts of a base path.
class PendingEdges {
public:
    void reset(int offsets);

    /// A group to be filled in: none exists as yet.
    EdgeGroup& add(int first_slot, int end_slot);

    /// Traces all edges. Fails the slots of occluded edges, and marks their lanes in `lost`.
    void resolve(const Tracer& tracer, OffsetPaths& paths, LaneMask& lost);

private:
    int offsets_ = 0;
    std::vector<std::unique_ptr<EdgeGroup>> groups_; // never shrinks
    std::size_t used_ = 0;
    LaneMask blocked_;
};

} // namespace tessera
