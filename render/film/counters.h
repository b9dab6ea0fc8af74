#pragma once

#include "recon/image.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <string>
#include <string_view>

namespace tessera {

/// How a shift of one base path to one offset pixel ended (render/estimator/shift.h).
enum class ShiftOutcome : std::uint8_t {
    ok,               ///< at least one light path came through
    occluded,         ///< no light path came through, and a new edge of at least one is blocked
    kind_mismatch,    ///< vertices scatter in different ways, or one edge is short: the way back would be another
    total_reflection, ///< a perfect refraction of the base has no direction at the offset
    outside,          ///< a ray left the scene, or an offset pixel sees nothing
    no_light,         ///< the offset carries nothing: black BSDF, no emitter hit
    count
};
inline constexpr int shift_outcome_count = static_cast<int>(ShiftOutcome::count);

/// The enumerator's own name: "ok", "occluded", "kind_mismatch".
std::string_view to_string(ShiftOutcome outcome);

/// What a ray is shot for.
enum class RayKind : std::uint8_t {
    camera, ///< from the camera to x_1
    look,   ///< to what a pixel shows, which is no sample's (PixelLooks): from the camera on, through mirrors
    bounce, ///< on from a vertex of a base path
    light,  ///< from a vertex of a base path to a point on a light: occlusion only
    shift_bounce, ///< on from a vertex of an offset path
    shift_edge,   ///< a new edge of an offset path, to a base vertex or a light: occlusion only
    count
};
inline constexpr int ray_kind_count = static_cast<int>(RayKind::count);

/// The enumerator's own name: "camera", "bounce", "shift_edge".
std::string_view to_string(RayKind kind);

/// A sample that was not finite, and so not added: pass and pixel, from 0. With the seed, its path can be traced
/// again.
struct RefusedSample {
    int pass, y, x;

    auto operator<=>(const RefusedSample&) const = default;
};

/// The first few of such samples, in order and each of them once, whoever finds them first.
class FirstRefused {
public:
    static constexpr std::size_t most = 16;

    void add(const RefusedSample& sample);
    std::span<const RefusedSample> list() const { return {samples_.data(), count_}; }

private:
    std::array<RefusedSample, most> samples_{};
    std::size_t count_ = 0;
};

/// Sums over a render; each worker has its own, added at the end of a pass.
struct Counters {
    std::uint64_t camera_paths = 0;  ///< base paths traced
    std::uint64_t path_vertices = 0; ///< surface vertices of base paths
    std::array<std::uint64_t, ray_kind_count> rays{};
    std::uint64_t remembered = 0; ///< vertices of offset paths that were known without a ray

    // Base paths of sampling sets; a path counts once for every set that it is in.
    std::uint64_t dark_paths = 0;          ///< carry nothing that could be reused
    std::uint64_t skipped_paths = 0;       ///< carry light, and were ended by the reuse roulette
    std::uint64_t reused_paths = 0;        ///< carry light, and were shifted to the others

    std::array<std::uint64_t, shift_outcome_count> shifts{}; ///< by outcome

    std::uint64_t refused_samples = 0; ///< not finite, and so not added
    FirstRefused first_refused;

    std::uint64_t shift_attempts() const {
        return std::accumulate(shifts.begin(), shifts.end(), std::uint64_t{0});
    }
    /// What the offsets cost, in rays: what goes with a vertex costs as much whether a ray was shot for it or not.
    std::uint64_t offset_work() const {
        return rays[static_cast<std::size_t>(RayKind::shift_bounce)] +
               rays[static_cast<std::size_t>(RayKind::shift_edge)] + remembered;
    }
    std::uint64_t all_rays() const { return std::accumulate(rays.begin(), rays.end(), std::uint64_t{0}); }
    std::uint64_t set_paths() const { return dark_paths + skipped_paths + reused_paths; }

    void refuse(const RefusedSample& sample);

    Counters& operator+=(const Counters& other);
};

/// "3 samples were not finite and were left out; the first is pass 5, pixel (7, 2), seed 0"; empty: none was.
std::string refused_text(const Counters& counters, std::uint64_t seed);

/// How sharing went at one pixel.
struct ReuseCounts {
    /// Base paths of other pixels that were shifted here, by outcome: those that are ok brought light.
    std::array<std::uint32_t, shift_outcome_count> shifts{};
    std::uint32_t reused = 0;  ///< its own base paths with light that were reused, once a sampling set of its own
    std::uint32_t skipped = 0; ///< its own base paths with light that the reuse roulette ended, likewise

    std::uint32_t tried() const; ///< shifts to here
    std::uint32_t arrived() const { return shifts[static_cast<std::size_t>(ShiftOutcome::ok)]; }
    std::uint32_t failed() const { return tried() - arrived(); }

    void operator+=(const ReuseCounts& other);
};

/// How sharing went, per pixel.
struct ReuseMaps {
    Image<ReuseCounts> counts; ///< of all passes; empty where pixels share nothing
    int passes = 0;

    // What the plan has chosen for the next pass; empty where there are no tiles:
    Image<float> sharers{}; ///< sharers_of() that pass
    Image<float> gain{};    ///< ReusePlan::gain

    Image<float> paths{}; ///< base paths of its own that a pixel has taken in all passes; empty: one in each

    bool empty() const { return counts.empty(); }

    Image<float> reused() const; ///< base paths of other pixels that brought light here, a pass, once in each set
    /// Share of the shifts to here that ended so, in [0, 1]; 0 without any.
    Image<float> share(ShiftOutcome outcome) const;
    Image<float> failed() const; ///< share of the shifts to here that brought no light, likewise
    /// Share of its own base paths with light that the reuse roulette left, in [0, 1]; 0 where none has carried
    /// light.
    Image<float> survival() const;
};

} // namespace tessera
