#pragma once

#include "recon/image.h"
#include "render/path/counters.h"

#include <array>
#include <cstdint>

namespace tessera {

/// How sharing went at one pixel.
struct ReuseCounts {
    /// Base paths of other pixels that were shifted here, by outcome: those that are ok brought light.
    std::array<std::uint32_t, shift_outcome_count> shifts{};
    std::uint32_t reused = 0; ///< its own base paths that carry light, once a sampling set of its own: reused, ...
    std::uint32_t skipped = 0; ///< ... and ended by the reuse roulette

    std::uint32_t tried() const; ///< shifts to here
    std::uint32_t arrived() const { return shifts[static_cast<std::size_t>(ShiftOutcome::ok)]; }
    std::uint32_t failed() const { return tried() - arrived(); }

    void operator+=(const ReuseCounts& other);
};

/// How sharing went, per pixel.
struct ReuseMaps {
    Image<ReuseCounts> counts; ///< of all passes; empty where pixels share nothing
    int passes = 0;

    bool empty() const { return counts.empty(); }

    Image<float> reused() const; ///< base paths of other pixels that brought light here, a pass
    /// Share of the shifts to here that ended so, in [0, 1]; 0 without any.
    Image<float> share(ShiftOutcome outcome) const;
    Image<float> failed() const; ///< share of the shifts to here that brought no light, likewise
    /// Share of its own base paths with light that the reuse roulette left, in [0, 1]; 0 where none has carried
    /// light.
    Image<float> survival() const;
};

} // namespace tessera
