#pragma once

#include "recon/image.h"
#include "render/trace/pixel_lanes.h"

#include <memory>
#include <vector>

namespace tessera {

/// What became of one light path of a base path in each offset pixel m, a lane a pixel:
///   density = r_m / r_k, the pdf of the offset's samplers for the shifted path over the base's for its own, both
///             summed over strategies and with the shift's Jacobian; 0: the shift failed
///   value   = c_m / r_k, radiance; f of the shifted path with its Jacobian over the base's summed pdfs and its
///             survival of the roulette on path length
/// [Bekaert 2002, 4; Bauszat 2017, eq. 8].
struct OffsetRow {
    FloatLanes density;
    Vec3Lanes value;

    /// A path that carries nothing counts as failed: the same is said of base paths, so that both sides agree. So
    /// does one that is beyond what floats hold.
    void set(int m, float new_density, Rgb new_value) {
        constexpr float largest = 3e38f; // a NaN fails every comparison
        const bool is_lit = (new_value.r > 0) | (new_value.g > 0) | (new_value.b > 0);
        const bool counts =
            is_lit & (new_density > 0) & (new_density + new_value.r + new_value.g + new_value.b <= largest);
        density[m] = counts ? new_density : 0.0f;
        value.x[m] = counts ? new_value.r : 0.0f;
        value.y[m] = counts ? new_value.g : 0.0f;
        value.z[m] = counts ? new_value.b : 0.0f;
    }
    void fail(int m) {
        density[m] = 0;
        value.set(m, Rgb(0));
    }
};

/// The rows of all light paths, as slots (LightPaths).
class OffsetPaths {
public:
    /// All have failed as yet.
    void reset(int slots, int offsets) {
        offsets_ = offsets;
        while (rows_.size() < static_cast<std::size_t>(slots))
            rows_.push_back(std::make_unique<OffsetRow>());
        for (int slot = 0; slot < slots; ++slot)
            for (int m = 0; m < padded(offsets); ++m)
                row(slot).fail(m);
    }

    int offsets() const { return offsets_; }
    OffsetRow& row(int slot) { return *rows_[static_cast<std::size_t>(slot)]; }
    const OffsetRow& row(int slot) const { return *rows_[static_cast<std::size_t>(slot)]; }
    float density(int slot, int m) const { return row(slot).density[m]; }
    Rgb value(int slot, int m) const { return row(slot).value[m]; }

private:
    int offsets_ = 0;
    std::vector<std::unique_ptr<OffsetRow>> rows_; // never shrinks
};

} // namespace tessera
