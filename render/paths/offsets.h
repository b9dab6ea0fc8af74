#pragma once

#include "recon/image.h"
#include "render/paths/tracer.h"
#include "render/trace/rays.h"

#include <limits>
#include <memory>
#include <vector>

namespace tessera {

/// f cos and pdf per solid angle of one scatter in every lane.
struct BsdfLanes {
    Vec3Lanes f_cos;
    FloatLanes pdf_w;
};

/// Vertices of offset paths, one lane for each pixel of the sampling set.
class OffsetVertices {
public:
    /// Sets the number of lanes, and removes all vertices.
    void reset(int count);
    /// Sets the vertex of a lane. Keeps a reference to it.
    void set(int lane, const Vertex& vertex);

    int count() const { return count_; }
    const Vertex& operator[](int lane) const { return *vertices_[lane]; }

    LaneMask exists;
    Vec3Lanes position;
    Vec3Lanes geometric_normal;
    FloatLanes roughness;

    /// Evaluates Vertex::evaluate() for unit directions (world). Results in other than the given lanes are
    /// undefined.
    void evaluate(const Vec3Lanes& to_next, const LaneMask& lanes, BsdfLanes& values) const;

private:
    int count_ = 0;
    std::vector<const Vertex*> vertices_;
    Vec3Lanes normal_; // shading normal
    FloatLanes to_previous_z_;
    Vec3Lanes reflectance_;        // of diffuse vertices
    std::vector<int> not_diffuse_; // lanes
    std::vector<int> guided_;      // lanes whose vertices have a guide
};

/// Evaluates the BSDF of one vertex as seen from many directions, with pdfs as in Vertex::evaluate(). Results in
/// other than the given lanes are undefined.
/// @param to_previous, to_next  unit, in the frame of x
void evaluate(const Vertex& x, const Vec3Lanes& to_previous, glm::vec3 to_next, const LaneMask& lanes, int count,
              BsdfLanes& values);

/// One light path x of pixel k, shifted to every pixel m of T, one lane for each pixel, theory (5) to (7):
///   ratio = r_m = P_m(y_m) |J| / P_k(x)   no unit; 0: the shift failed
///   value = c_m = f_m(y_m) |J| / P_k(x)   radiance, divided by the survival of roulette on path length
/// y_m is the shifted path, P the sum of the densities of all strategies, and J the Jacobian of the shift
/// [Bekaert 2002, 4; Bauszat 2017, eq. 8]. The lane of k itself stays 0, although r_k is 1.
struct OffsetRow {
    FloatLanes ratio;
    Vec3Lanes value;

    /// Stores r_m and c_m. A shift to a path without radiance counts as failed, as base paths without radiance
    /// are not shifted. A shift with values beyond the range of floats fails, too.
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

/// The scatter of offset paths at y_1, one lane for each pixel; undefined where the shift fails.
struct FirstScatter {
    static constexpr float infinite = std::numeric_limits<float>::infinity();

    Vec3Lanes direction; ///< unit, world
    Vec3Lanes f_cos;     ///< infinite: a delta scatter
};

/// The rows of all light paths, by slot (LightPaths).
class OffsetPaths {
public:
    /// Sets the numbers of slots and pixels. All shifts count as failed until their rows are set.
    /// @param keeps_scatters  stores first scatters, which basis components need
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
    /// Returns a new scatter, for the caller to fill in. It becomes the first scatter of the slots in
    /// [first_slot, end_slot) that have none. Requires keeps_scatters().
    FirstScatter& add_first_scatter(int first_slot, int end_slot);
    /// Returns the index of a slot's first scatter; -1: none.
    int scatter_index(int slot) const { return scatter_of_slot_[slot]; }
    const FirstScatter& first_scatter(int index) const { return *scatters_[index]; }

private:
    int offsets_ = 0;
    std::vector<std::unique_ptr<OffsetRow>> rows_; // never shrinks
    std::vector<int> scatter_of_slot_;
    std::vector<std::unique_ptr<FirstScatter>> scatters_; // never shrinks
    int used_scatters_ = 0;
};

/// Geometry of the connections from offset vertices to one point, one lane for each pixel.
struct ConnectionLanes {
    LaneMask valid;       ///< the lane is requested, and the vertex lies on the right side of the point
    Vec3Lanes direction;  ///< unit, world, toward the point
    FloatLanes geometry;  ///< |cos| at the point over the squared distance: solid angle over area, theory (14)
    FloatLanes distance2; ///< squared distance to the point; infinite for directions
};

/// Connects vertices to a point on a surface, without visibility.
/// @param one_sided  only from the side of `normal`
void connect_to_point(const OffsetVertices& y, const LaneMask& lanes, glm::vec3 point, glm::vec3 normal,
                      bool one_sided, ConnectionLanes& sight);

/// Light from a point on a light at offset vertices, one lane for each pixel.
struct LightLanes {
    Vec3Lanes radiance;
    FloatLanes pdf_w;            ///< of emitter sampling, per solid angle at the vertex (LightRay::pdf_w)
    FloatLanes ball_fixed_pdf_w; ///< LightRay::fixed_pdf_w of a ball, unset for other lights

    /// Returns LightRay::fixed_pdf_w, which is pdf_w except of a ball.
    const FloatLanes& fixed_pdf_w(const LightPoint& light) const {
        return light.kind == LightPoint::Kind::ball ? ball_fixed_pdf_w : pdf_w;
    }
};

/// Sets the pdfs of emitter sampling of a ball, per solid angle at the vertices.
void ball_pdfs(const OffsetVertices& y, const LightPoint& light, FloatLanes& pdf_w);

/// Connects vertices to a point on a light, or to a direction at infinity, without visibility.
void connect_to_light(const OffsetVertices& y, const LaneMask& lanes, const LightPoint& light,
                      ConnectionLanes& sight, LightLanes& arriving);

/// Sets the segments from vertices to a point on a surface. @param direction  unit, from each vertex to the point
void edges_to_point(const Tracer& tracer, const OffsetVertices& y, const Vec3Lanes& direction, glm::vec3 point,
                    glm::vec3 normal, SegmentLanes& segments);
/// Sets the segments from vertices to a light, which may be at infinity.
void edges_to_light(const Tracer& tracer, const OffsetVertices& y, const Vec3Lanes& direction,
                    const LightPoint& light, SegmentLanes& segments);

/// New edges of offset paths, one lane for each pixel, whose visibility is not yet known. They end in one point,
/// a light (perhaps at infinity) or a base vertex, so they are traced together. An occluded edge fails the slots
/// [first_slot, end_slot).
struct EdgeGroup {
    SegmentLanes segments;
    LaneMask exists;
    int first_slot, end_slot;
};

/// The new edges of all shifts of a base path.
class PendingEdges {
public:
    void reset(int offsets);

    /// Returns a new group without edges, for the caller to fill in.
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
