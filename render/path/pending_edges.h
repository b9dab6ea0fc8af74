#pragma once

#include "render/path/offset_paths.h"
#include "render/path/tracer.h"

#include <memory>
#include <span>
#include <vector>

namespace tessera {

/// New edges of offset paths, a lane a pixel, that may be blocked. They all end in the same point, a light
/// (perhaps at infinity) or a base vertex, so their rays are traced together; a blocked one fails the slots
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

    /// Traces all edges; says in which lanes something was lost.
    /// @param slot_scale  a slot with 0 needs no answer
    void resolve(const Tracer& tracer, OffsetPaths& paths, std::span<const float> slot_scale, LaneMask& lost);

private:
    int offsets_ = 0;
    std::vector<std::unique_ptr<EdgeGroup>> groups_; // never shrinks
    std::size_t used_ = 0;
    LaneMask blocked_;
};

} // namespace tessera
