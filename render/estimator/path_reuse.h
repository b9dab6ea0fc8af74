#pragma once

#include "render/estimator/basis.h"
#include "render/paths/shift.h"

#include <algorithm>
#include <limits>
#include <span>

namespace tessera {

/// The estimator of all methods. Given a sampling set T, pixels whose base paths take part, it adds to each
/// pixel m
///   sum over base paths k in T and their light paths x of  g_k c_m(x) / R(x),
///   R(x) = sum over n in T of g_n r_n(x),
/// where c_m and r_m are value and ratio of x shifted to m (OffsetRow): the balance heuristic over all pixels of T
/// [Bekaert 2002, 4; Bauszat 2017, eq. 8], derived in METHODS.md, The weight. A method is a choice of T;
/// differences between pixels of one T are gradients.
class PathReuse {
public:
    PathReuse(const Tracer& tracer, const ShiftSettings& settings)
        : tracer_(tracer), settings_(settings), shift_(tracer, settings) {}

    /// Begins with another sampling set.
    /// Throws std::logic_error for more than most_lanes pixels.
    /// @param set     the base paths of T, one a pixel; they must stay until the next begin()
    /// @param counts  g, as how many samples each of them counts (SamplingSet::counts); likewise
    void begin(std::span<const BasePath* const> set, std::span<const float> counts);

    /// @param base      the path whose light is shared out, an index into the set
    /// @param scale     factor on what is shared: one over the probability that this path is reused; 0: it is
    ///                  not, and only the light that is never shifted is added, to the base's own
    ///                  pixel
    /// @param radiance  one a pixel of T; what the path brings is added
    /// @param arriving  a lane a pixel of T; likewise. Null: nobody wants to know
    void share(int base, float scale, std::span<Rgb> radiance, ArrivingLight* arriving = nullptr);

    /// What arrives in parts by a path that is shared with nobody.
    void keep(const BasePath& path, int lane, ArrivingLight& arriving);

    /// What of a path's radiance is shifted to the others of its set.
    Rgb shared_light(const BasePath& path) const { return keeps_direct() ? path.indirect : path.radiance(); }
    /// Luminance of the same as it arrives at x_1, whatever is reflected there: over the albedo. Finite, and
    /// negative where the path sees nothing.
    float arriving_luminance(const BasePath& path) const {
        const float l = luminance(shared_light(path) / path.albedo);
        return path.empty() ? -1 : std::min(l, std::numeric_limits<float>::max());
    }
    /// What of a path's radiance stays with its own pixel.
    Rgb kept_light(const BasePath& path) const { return keeps_direct() ? path.direct : Rgb(0); }

    /// How the shifts of the last share() to each pixel of T ended; meaningless for the base's own. Empty: no
    /// shift was tried.
    std::span<const ShiftOutcome> outcomes() const { return {outcomes_.values.data(), tried_ ? set_.size() : 0}; }

    // What became of the light paths of the last share(), for who wants to look; only where a shift was tried.

    const LightPaths& light_paths() const { return light_; }
    const OffsetPaths& offset_paths() const { return paths_; }
    /// Returns g/R of a light path times `scale`, or 0 if the path carries no light.
    float weight(int slot, float scale) const {
        const float count = counts_[base_];
        return light_.is_alive(slot) ? scale * count / ratio_sum(slot) : 0;
    }
    /// @param onlooker  is told of all that the next share() do; null: nobody is
    void set_onlooker(ShiftOnlooker* onlooker) {
        onlooker_ = onlooker;
        shift_.set_onlooker(onlooker);
    }

private:
    bool keeps_direct() const { return settings_.shift == ShiftKind::reconnection; }
    void shift_to_all(int base);
    void replay_to_all(int base);
    void tell_of_replay(int m);
    void keep_scatters_of_replay(int m);
    void judge(int base);
    void balance(int base, float scale, std::span<Rgb> radiance) const;
    void add_own(const BasePath& path, int slot, float factor, int lane, ArrivingLight& arriving) const;
    void balance_parts(int base, float scale, ArrivingLight& arriving);
    /// R of a light path.
    float ratio_sum(int slot) const;

    Tracer tracer_;
    ShiftSettings settings_;
    std::span<const BasePath* const> set_;
    std::span<const float> counts_;
    int base_ = 0;            ///< of the last share()
    PrimaryVertices primary_; ///< what the pixels of T see; empty until it is needed
    Shift shift_;
    LightPaths light_;
    OffsetPaths paths_;
    PendingEdges edges_;
    BasePath replayed_;
    LightPaths replayed_light_;
    std::vector<FirstScatter*> replayed_scatters_; ///< by emitter slot at y_1, the last of all others
    Vec3Lanes carried_; ///< by all light paths through one first scatter, times their weights
    OutcomeLanes outcomes_;
    bool tried_ = false;
    ShiftOnlooker* onlooker_ = nullptr;
    LaneMask arrived_; ///< where anything came through
    LaneMask lost_;    ///< where an edge was blocked
};

} // namespace tessera
