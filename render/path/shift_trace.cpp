// Shift: what an onlooker is told. The numbers are those that were just calculated with.
#include "render/path/shift.h"

namespace tessera {

/// The light path of a slot ends at a light, as seen from y_i.
/// @param pdf_w  of all strategies together
void Shift::trace_end(int slot, int m, float pdf_w, float jacobian, bool is_delta) {
    const OffsetRow& row = paths_->row(slot);
    trace_->end(m, slot, {light_->vertex_of(slot), pdf_w, is_delta, jacobian, row.density[m], row.value[m]});
}

/// All y_i have been joined to x_{i+1}.
void Shift::trace_join(int i) {
    traced_joins_.clear();
    for (int m = 0; m < y_->count(); ++m)
        traced_joins_.push_back({i, bsdf_.pdf_w[m], false, seen_.geometry[m] / base(i).next_geometry,
                                 joined_.density[m], joined_.value[m]});
}

/// The light path of a slot goes on from the x_{i+1} that is joined to: nothing is stretched there.
/// @param bsdf_share  0: BSDF sampling could not have gone on that way
/// @param other_pdf_w of emitter sampling for the same
void Shift::trace_beyond(int slot, const LaneMask& arrived, float bsdf_share, float other_pdf_w) {
    const OffsetRow& row = paths_->row(slot);
    for (int m = 0; m < y_->count(); ++m) {
        if (!arrived[m])
            continue;
        const OffsetStep& join = traced_joins_[static_cast<std::size_t>(m)];
        const float pdf_w = bsdf_.pdf_w[m] * bsdf_share + other_pdf_w;
        trace_->end_beyond(m, slot, join, {join.vertex + 1, pdf_w, false, 1, row.density[m], row.value[m]});
    }
}

} // namespace tessera
