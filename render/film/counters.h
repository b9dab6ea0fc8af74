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

/// Outcome of the shift of one base path to one offset pixel (render/paths/shift.h).
enum class ShiftOutcome : std::uint8_t {
    ok,               ///< at least one light path has a valid shift
    occluded,         ///< no valid shift, and a new edge of at least one light path is occluded
    kind_mismatch,    ///< base and offset differ in the kind of a vertex or edge: the shift has no inverse
    total_reflection, ///< a perfect refraction of the base has no direction at the offset
    outside,          ///< a ray left the scene, or an offset pixel sees nothing
    no_light,         ///< the offset carries nothing: black BSDF, no emitter hit
    count
};
inline constexpr int shift_outcome_count = static_cast<int>(ShiftOutcome::count);

/// Returns the enumerator's name: "ok", "occluded", "kind_mismatch".
std::string_view to_string(ShiftOutcome outcome);

/// Purpose of a ray.
enum class RayKind : std::uint8_t {
    camera,       ///< from the camera to x_1
    feature,      ///< a feature sample (PixelFeatures): from the camera and through mirrors
    bounce,       ///< next segment of a base path
    light,        ///< occlusion between a vertex of a base path and a light
    shift_bounce, ///< next segment of an offset path
    shift_edge,   ///< occlusion of an offset path's new edge, to a base vertex or a light
    count
};
inline constexpr int ray_kind_count = static_cast<int>(RayKind::count);

/// Returns the enumerator's name: "camera", "bounce", "shift_edge".
std::string_view to_string(RayKind kind);

/// An invalid sample: pass and pixel, from 0. With the seed, its path can be traced again.
struct InvalidSample {
    int pass, y, x;

    auto operator<=>(const InvalidSample&) const = default;
};

/// The first few invalid samples, in order and each of them once. The result does not depend on the order of
/// add().
class FirstInvalid {
public:
    static constexpr std::size_t most = 16;

    void add(const InvalidSample& sample);
    std::span<const InvalidSample> list() const { return {samples_.data(), count_}; }

private:
    std::array<InvalidSample, most> samples_{};
    std::size_t count_ = 0;
};

/// Sums over a render. Each worker counts separately; the render adds them at the end of a pass.
struct Counters {
    std::uint64_t camera_paths = 0;  ///< base paths traced
    std::uint64_t path_vertices = 0; ///< surface vertices of base paths
    std::array<std::uint64_t, ray_kind_count> rays{};
    std::uint64_t remembered = 0; ///< vertices of offset paths that were found without a ray

    // Base paths of sampling sets. A path counts once per set.
    std::uint64_t dark_paths = 0;    ///< without light that could be reused
    std::uint64_t skipped_paths = 0; ///< with light, ended by Russian roulette on reuse
    std::uint64_t reused_paths = 0;  ///< with light, and shifted to the other pixels

    std::array<std::uint64_t, shift_outcome_count> shifts{}; ///< by outcome

    std::uint64_t invalid_samples = 0; ///< invalid samples, which the film rejects
    FirstInvalid first_invalid;

    std::uint64_t shift_attempts() const {
        return std::accumulate(shifts.begin(), shifts.end(), std::uint64_t{0});
    }
    /// Returns the cost of offset paths in rays. A vertex without a ray costs about as much as one with a ray.
    std::uint64_t offset_work() const {
        return rays[static_cast<std::size_t>(RayKind::shift_bounce)] +
               rays[static_cast<std::size_t>(RayKind::shift_edge)] + remembered;
    }
    std::uint64_t all_rays() const { return std::accumulate(rays.begin(), rays.end(), std::uint64_t{0}); }
    std::uint64_t set_paths() const { return dark_paths + skipped_paths + reused_paths; }

    void refuse(const InvalidSample& sample);

    Counters& operator+=(const Counters& other);
};

/// Returns a message about invalid samples: "3 samples were not finite and were left out; the first is pass 5,
/// pixel (7, 2), seed 0"; empty without such samples.
std::string invalid_text(const Counters& counters, std::uint64_t seed);

/// Outcomes of path reuse at one pixel.
struct ReuseCounts {
    /// Base paths of other pixels that were shifted to this pixel, by outcome. Those with `ok` contributed.
    std::array<std::uint32_t, shift_outcome_count> shifts{};
    std::uint32_t reused = 0;  ///< base paths of the pixel with light that were reused, once per sampling set
    std::uint32_t skipped = 0; ///< those that Russian roulette on reuse ended

    std::uint32_t tried() const; ///< shifts to this pixel
    std::uint32_t arrived() const { return shifts[static_cast<std::size_t>(ShiftOutcome::ok)]; }
    std::uint32_t failed() const { return tried() - arrived(); }

    void operator+=(const ReuseCounts& other);
};

/// Outcomes of path reuse for all pixels.
struct ReuseMaps {
    Image<ReuseCounts> counts; ///< of all passes; empty without path reuse
    int passes = 0;

    // Choices of LearnedReuse for the next pass; empty without tiles:
    Image<float> reuse_set_size{}; ///< reuse_set_sizes() of that pass
    Image<float> gain{};           ///< LearnedReuse::gain

    Image<float> paths{}; ///< base paths of each pixel in all passes; empty: one per pass

    bool empty() const { return counts.empty(); }

    Image<float> reused() const; ///< base paths of other pixels that contributed, per pass, once per set
    /// Returns the fraction of shifts to each pixel with this outcome, in [0, 1]; 0 without shifts.
    Image<float> share(ShiftOutcome outcome) const;
    Image<float> failed() const; ///< fraction of shifts that did not contribute, in [0, 1]
    /// Returns the fraction of base paths with light that survive Russian roulette on reuse, in [0, 1]; 0 without
    /// such paths.
    Image<float> survival() const;
};

} // namespace tessera
