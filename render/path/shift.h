#pragma once

#include "render/path/light_paths.h"

#include <cmath>
#include <vector>

namespace tessera {

/// What became of each light path of a base path in each offset pixel: for slot s and offset m
///   density = r_m / r_k, the pdf of the offset's samplers for the shifted path over the base's for its own, both
///             summed over strategies and with the shift's Jacobian; 0: the shift failed
///   value   = c_m / r_k, radiance; f of the shifted path with its Jacobian over the base's summed pdfs
/// [Bekaert 2002, 4; Bauszat 2017, eq. 8]. A row a slot, so that a loop over the offsets runs along memory.
class OffsetPaths {
public:
    void reset(int slots, int offsets);

    int offsets() const { return offsets_; }
    float density(int slot, int offset) const { return density_[index(slot, offset)]; }
    Rgb value(int slot, int offset) const { return value_[index(slot, offset)]; }

    /// A path that carries nothing counts as failed: the same is said of base paths, so that both sides agree. So
    /// does one that is beyond what floats hold.
    void set(int slot, int offset, float density, Rgb value) {
        if (!(density > 0) || is_black(value) || !std::isfinite(density + value.r + value.g + value.b))
            return;
        density_[index(slot, offset)] = density;
        value_[index(slot, offset)] = value;
    }
    void fail(int slot, int offset) {
        density_[index(slot, offset)] = 0;
        value_[index(slot, offset)] = Rgb(0);
    }

private:
    std::size_t index(int slot, int offset) const {
        return static_cast<std::size_t>(slot) * static_cast<std::size_t>(offsets_) +
               static_cast<std::size_t>(offset);
    }
    int offsets_ = 0;
    std::vector<float> density_;
    std::vector<Rgb> value_;
};

/// Edges that shifts have made and that may be blocked. All edges of a group end in the same point, a light or a
/// base vertex, so their rays are traced together; a blocked edge fails the slots [first_slot, end_slot).
class PendingEdges {
public:
    void reset(int groups);
    void add(int group, const Segment& segment, int offset, int first_slot, int end_slot);

    /// Traces all edges; returns whether an offset lost slots in blocked[offset].
    void resolve(const Tracer& tracer, OffsetPaths& paths, std::vector<std::uint8_t>& blocked);

private:
    struct Group {
        std::vector<Segment> segments;
        std::vector<int> offsets;
        int first_slot = 0;
        int end_slot = 0;
    };
    std::vector<Group> groups_;
    int used_ = 0;
    std::vector<std::uint8_t> hidden_;
};

/// Shifts all light paths of a base path to the pixel that sees `primary`, column `offset` of `paths`: half
/// vectors are copied until base and offset can be connected [Bauszat 2017, 3.1]. New edges are added to `edges`,
/// unchecked. Returns ok, or why the first light path that failed did so.
ShiftOutcome shift(const Tracer& tracer, float threshold, const BasePath& base, const LightPaths& light,
                   const Vertex& primary, int offset, OffsetPaths& paths, PendingEdges& edges);

} // namespace tessera
