#include "render/path/pending_edges.h"

#include <algorithm>

namespace tessera {

void PendingEdges::reset(int offsets) {
    offsets_ = offsets;
    used_ = 0;
}

EdgeGroup& PendingEdges::add(int first_slot, int end_slot) {
    if (used_ == groups_.size())
        groups_.push_back(std::make_unique<EdgeGroup>());
    EdgeGroup& group = *groups_[used_++];
    group.first_slot = first_slot;
    group.end_slot = end_slot;
    for (int m = 0; m < padded(offsets_); ++m)
        group.exists[m] = 0;
    return group;
}

void PendingEdges::resolve(const Tracer& tracer, OffsetPaths& paths, std::span<const float> slot_scale,
                           LaneMask& lost) {
    for (int m = 0; m < padded(offsets_); ++m)
        lost[m] = 0;
    for (std::size_t i = 0; i < used_; ++i) {
        const EdgeGroup& g = *groups_[i];
        const auto first = slot_scale.begin() + g.first_slot, end = slot_scale.begin() + g.end_slot;
        if (std::all_of(first, end, [](float scale) { return scale == 0; }))
            continue;
        tracer.occluded(g.segments, g.exists, offsets_, blocked_);
        for (int m = 0; m < offsets_; ++m) {
            if (!blocked_[m])
                continue;
            lost[m] = -1;
            for (int slot = g.first_slot; slot < g.end_slot; ++slot)
                paths.row(slot).fail(m);
        }
    }
}

} // namespace tessera
