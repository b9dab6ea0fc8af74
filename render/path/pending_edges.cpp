#include "render/path/pending_edges.h"

#include <algorithm>

namespace tessera {

void PendingEdges::reset(int groups) {
    if (groups_.size() < static_cast<std::size_t>(groups))
        groups_.resize(static_cast<std::size_t>(groups));
    used_ = groups;
    for (int g = 0; g < groups; ++g) {
        groups_[static_cast<std::size_t>(g)].segments.clear();
        groups_[static_cast<std::size_t>(g)].offsets.clear();
    }
}

void PendingEdges::add(int group, const Segment& segment, int offset, int first_slot, int end_slot) {
    Group& g = groups_[static_cast<std::size_t>(group)];
    g.segments.push_back(segment);
    g.offsets.push_back(offset);
    g.first_slot = first_slot;
    g.end_slot = end_slot;
}

void PendingEdges::resolve(const Tracer& tracer, OffsetPaths& paths, std::span<const float> slot_scale,
                           std::span<std::uint8_t> blocked) {
    for (int i = 0; i < used_; ++i) {
        const Group& g = groups_[static_cast<std::size_t>(i)];
        const auto first = slot_scale.begin() + g.first_slot, end = slot_scale.begin() + g.end_slot;
        if (g.segments.empty() || std::all_of(first, end, [](float scale) { return scale == 0; }))
            continue;
        hidden_.resize(g.segments.size());
        tracer.occluded(g.segments, hidden_.data());
        for (std::size_t e = 0; e < g.segments.size(); ++e) {
            if (!hidden_[e])
                continue;
            blocked[static_cast<std::size_t>(g.offsets[e])] = 1;
            for (int slot = g.first_slot; slot < g.end_slot; ++slot)
                paths.fail(slot, g.offsets[e]);
        }
    }
}

} // namespace tessera
