#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <string_view>

namespace tessera {

/// How a shift of one base path to one offset pixel ended (render/path/shift.h).
enum class ShiftOutcome : std::uint8_t {
    ok,               ///< at least one light path came through
    occluded,         ///< every new edge is blocked
    kind_mismatch,    ///< base and offset vertex scatter in different ways: the way back would be another
    total_reflection, ///< no refracted direction for the half vector
    outside,          ///< a ray left the scene, or an offset pixel sees nothing
    no_light,         ///< the offset carries nothing: black BSDF, no emitter hit
    count
};
inline constexpr int shift_outcome_count = static_cast<int>(ShiftOutcome::count);

/// "ok", "occluded", ...
std::string_view to_string(ShiftOutcome outcome);

/// Sums over a render; each worker has its own, added at the end of a pass.
struct Counters {
    std::uint64_t camera_paths = 0;  ///< base paths traced
    std::uint64_t path_vertices = 0; ///< surface vertices of base paths
    std::uint64_t closest_hit_rays = 0;
    std::uint64_t occlusion_rays = 0;
    std::uint64_t reusable_paths = 0;                        ///< base paths that carry light and met the roulette
    std::uint64_t skipped_paths = 0;                         ///< of these, ended by the roulette
    std::uint64_t refused_samples = 0;                       ///< samples that were not finite, and so not added
    std::array<std::uint64_t, shift_outcome_count> shifts{}; ///< by outcome

    std::uint64_t shift_attempts() const {
        std::uint64_t sum = 0;
        for (std::uint64_t n : shifts)
            sum += n;
        return sum;
    }
    std::uint64_t rays() const { return closest_hit_rays + occlusion_rays; }

    Counters& operator+=(const Counters& other);
};

} // namespace tessera
