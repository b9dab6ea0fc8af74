#pragma once

#include "render/path/offset_paths.h"
#include "render/path/tracer.h"

#include <span>
#include <vector>

namespace tessera {

/// Edges that shifts have made and that may be blocked. All edges of a group end in the same point, a light
/// (perhaps at infinity) or a base vertex, so their rays are traced together; a blocked edge fails the slots
/// [first_slot, end_slot).
class PendingEdges {
public:
    void reset(int groups);
    void add(int group, const Segment& segment, int offset, int first_slot, int end_slot);

    /// Traces all edges; returns whether an offset lost slots in blocked[offset].
    /// @param slot_scale  a slot with 0 needs no answer
    void resolve(const Tracer& tracer, OffsetPaths& paths, std::span<const float> slot_scale,
                 std::span<std::uint8_t> blocked);

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

} // namespace tessera
