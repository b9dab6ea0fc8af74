#pragma once

#include "recon/image.h"

namespace tessera {

struct Vertex;

/// One scattering of an offset path, in the numbers that the shift calculates with.
struct OffsetStep {
    int vertex = 0;  ///< where: 0 is y_1
    float pdf_w = 0; ///< of the way on: per solid angle, or a probability after a delta scatter; at the end of a
                     ///< light path that of all strategies together
    bool is_delta = false;
    float jacobian = 1; ///< what turns pdf_w over the base's into `ratio`'s growth: solid angle at the offset over
                        ///< solid angle at the base; where random numbers are replayed, the quotient of the pdfs
    float ratio = 0;    ///< so far: pdf of the offset, with all Jacobians, over that of the base; no unit
    Rgb value{0};       ///< so far: f of the offset with all Jacobians over the base's pdf; at the end of a light
                        ///< path with its light, radiance
};

/// Is told what shifts do, step by step: the path inspector's way in. Renders have none.
class ShiftOnlooker {
public:
    virtual ~ShiftOnlooker() = default;

    /// A base path is shifted to `offsets` pixels, m = 0, 1, ...; it carries light paths in `slots` slots.
    virtual void begins(int offsets, int slots) = 0;
    /// The offset path of pixel m has one more vertex of its own.
    virtual void arrives(int m, const Vertex& y) = 0;
    /// It scatters toward the next of these.
    virtual void bounces(int m, const OffsetStep& step) = 0;
    /// It scatters toward a vertex of the base path.
    virtual void joins(int m, const OffsetStep& step) = 0;
    /// A light path ends at a light as seen from a vertex of the offset's own, whatever visibility makes of it.
    virtual void ends(int m, int slot, const OffsetStep& last) = 0;
    /// A light path ends at, or beyond, the vertex of the base path that was joined last.
    virtual void ends_beyond(int m, int slot, const OffsetStep& last) = 0;
};

} // namespace tessera
