#pragma once

#include "render/path/shift.h"

#include <span>

namespace tessera {

/// The estimator of all methods. Given a sampling set T, pixels whose base paths take part, it adds to each pixel
/// m
///   sum over base paths k in T and their light paths x of  c_m(x) / R(x),  R(x) = sum over n in T of r_n(x)
/// where c_m and r_m are value and density of x shifted to m: the balance heuristic over all pixels of T
/// [Bekaert 2002, 4; Bauszat 2017, eq. 8]. A method is a choice of T; differences between pixels of one T are
/// gradients.
class PathReuse {
public:
    PathReuse(const Tracer& tracer, float shift_threshold) : tracer_(tracer), threshold_(shift_threshold) {}

    /// @param set     the base paths of T, one a pixel
    /// @param base    the one whose light is shared out, an index into `set`
    /// @param scale   factor on all of it: one over the probability that this path is reused
    /// @param radiance one a pixel of T; what the path brings is added
    void share(std::span<const BasePath* const> set, int base, float scale, std::span<Rgb> radiance);

private:
    void shift_to_all(std::span<const BasePath* const> set, int base);
    void balance(int base, float scale, std::span<Rgb> radiance) const;

    Tracer tracer_;
    float threshold_;
    LightPaths light_;
    OffsetPaths paths_;
    PendingEdges edges_;
    std::vector<ShiftOutcome> outcomes_;
    std::vector<std::uint8_t> blocked_;
};

} // namespace tessera
