#pragma once

#include "recon/image.h"

namespace tessera {

struct Vertex;

/// One scatter of an offset path, with the numbers of the shift.
struct OffsetStep {
    int vertex = 0;  ///< index; 0 is y_1
    float pdf_w = 0; ///< of the next direction, per solid angle, or a probability after a delta scatter; at the
                     ///< end of a light path the sum over all strategies
    bool is_delta = false;
    float jacobian = 1; ///< |J| of this step: solid angle at the offset over that at the base, theory (14) and
                        ///< (15); with random replay the quotient of the pdfs
    float ratio = 0;    ///< r_m up to here, theory (6), no unit
    Rgb value{0};       ///< c_m up to here, theory (7), without the light; at the end with it, radiance
};

/// Observer of the steps of shifts. Only the path inspector has one.
class ShiftObserver {
public:
    virtual ~ShiftObserver() = default;

    /// A base path with `slots` slots is shifted to `offsets` pixels, m = 0, 1, ...
    virtual void begins(int offsets, int slots) = 0;
    /// The offset path of pixel m gets another vertex of its own.
    virtual void arrives(int m, const Vertex& y) = 0;
    /// It scatters toward its own next vertex.
    virtual void bounces(int m, const OffsetStep& step) = 0;
    /// It scatters toward a vertex of the base path.
    virtual void joins(int m, const OffsetStep& step) = 0;
    /// A light path ends at a light that the last own vertex connects to or hits. The edge may be occluded.
    virtual void ends(int m, int slot, const OffsetStep& last) = 0;
    /// A light path ends at or beyond the vertex of the last joins().
    virtual void ends_beyond(int m, int slot, const OffsetStep& last) = 0;
};

} // namespace tessera
