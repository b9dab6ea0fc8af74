#pragma once

#include "render/path/base_path.h"

#include <vector>

#include <glm/geometric.hpp>

namespace tessera {

/// Whether offsets can be joined at a scattering by connecting two points: its roughness is above the threshold.
/// Decided alike for base and offset, or a shift would not be its own inverse.
inline bool is_connectable(const Vertex& x, float threshold) {
    return x.bsdf.roughness() > threshold;
}

/// How long an edge must be to be joined, by the pixel that a path belongs to: scene units. What a vertex sees
/// close by, as in a corner, looks quite different from another pixel's vertex: joined, its light would stay with
/// the base. There the shift goes on as from vertices too glossy to connect. Decided alike for base and offset.
/// @param pixel_width  BasePath::pixel_width
inline float least_length(const ShiftSettings& settings, float pixel_width) {
    return settings.shift == ShiftKind::reconnection ? 0 : settings.shift_distance * pixel_width;
}

inline bool is_long(glm::vec3 from, glm::vec3 to, float least) {
    const glm::vec3 edge = to - from;
    return glm::dot(edge, edge) >= least * least;
}

/// The light paths that a base path carries, as slots in the order of their ends, and what each brings: for every
/// vertex one for each light sample there, and one for the light that BSDF sampling runs into. Where shifts join
/// base and offset, all light paths through the same vertices beyond the join share their ratios of value and of
/// density, so they are one slot, the tail: the suffix is summed once. Vertices count from 0 here: vertex 0 is
/// x_1.
class LightPaths {
public:
    /// Lists the light paths of `path`; keeps no reference to it.
    void reset(const BasePath& path, const ShiftSettings& settings);

    /// Ends by light sample `sample` of the vertex.
    int emitter_slot(int vertex, int sample) const { return vertex * (light_samples_ + 1) + sample; }
    /// Ends by BSDF sampling at the vertex meeting an emitter.
    int hit_slot(int vertex) const { return emitter_slot(vertex, light_samples_); }
    int vertex_of(int slot) const { return slot / (light_samples_ + 1); } ///< not for the tail
    int tail_slot() const { return hit_slot(join_) + 1; } ///< ends further on; only where has_join()

    /// The vertex at which offsets join the base path: the first j >= 1 for which j-1 and j are connectable and
    /// the edge between them is long.
    int join() const { return join_; }
    bool has_join() const { return join_ > 0; }

    /// Slots before this one are not shifted: their light stays where it is.
    int first_shared() const { return first_shared_; }
    int slot_count() const { return static_cast<int>(carried_.size()); }

    /// What the slot brings to the base's own pixel: f / (sum of pdfs and survival), radiance.
    Rgb carried(int slot) const { return carried_[static_cast<std::size_t>(slot)]; }
    bool is_alive(int slot) const { return slot <= last_alive_ && !is_black(carried(slot)); }
    bool is_alive(int first, int end) const {
        while (first < end && !is_alive(first))
            ++first;
        return first < end;
    }
    /// The last slot that carries light; -1: none does.
    int last_alive() const { return last_alive_; }

    /// Whether the step from the vertex onward (there is one, perhaps to infinity) is connectable.
    bool step_is_connectable(int vertex) const { return steps_[static_cast<std::size_t>(vertex)].is_connectable; }
    /// Whether the edge from the vertex to the next one (there is one) is long.
    bool step_is_long(int vertex) const { return steps_[static_cast<std::size_t>(vertex)].is_long; }

private:
    struct Step {
        bool is_connectable, is_long;
    };

    std::vector<Rgb> carried_;
    std::vector<Step> steps_;
    int light_samples_ = 1;
    int join_ = 0;
    int first_shared_ = 0;
    int last_alive_ = -1;
};

} // namespace tessera
