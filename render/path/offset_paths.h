#pragma once

#include "recon/image.h"

#include <cmath>
#include <vector>

namespace tessera {

/// What became of each light path of a base path in each offset pixel: for slot s and offset m
///   density = r_m / r_k, the pdf of the offset's samplers for the shifted path over the base's for its own, both
///             summed over strategies and with the shift's Jacobian; 0: the shift failed
///   value   = c_m / r_k, radiance; f of the shifted path with its Jacobian over the base's summed pdfs and its
///             survival of the roulette on path length
/// [Bekaert 2002, 4; Bauszat 2017, eq. 8]. A row a slot, so that a loop over the offsets runs along memory.
class OffsetPaths {
public:
    void reset(int slots, int offsets) {
        offsets_ = offsets;
        const std::size_t count = static_cast<std::size_t>(slots) * static_cast<std::size_t>(offsets);
        density_.assign(count, 0.0f);
        value_.assign(count, Rgb(0));
    }

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

} // namespace tessera
