#pragma once

#include "render/estimator/basis.h"
#include "render/paths/shift.h"

#include <algorithm>
#include <limits>
#include <span>

namespace tessera {

/// The estimator of all methods. For a sampling set T, it adds to each pixel m of T
///   sum over base paths k in T and their light paths x of  g_k c_m(x) / R(x)   theory (9) and (20)
///   R(x) = sum over n in T of g_n r_n(x)                                       theory (8) and (20)
/// c_m and r_m are value and ratio of x shifted to m (OffsetRow). g is 1 unless T has several camera positions.
/// 1/R is the weight of the balance heuristic over all pixels of T [Bekaert 2002, 4; Bauszat 2017, eq. 8],
/// derived in theory (10) to (12). A method is a choice of T. Differences between pixels of one T are gradients,
/// theory (13).
class PathReuse {
public:
    PathReuse(const Tracer& tracer, const ShiftSettings& settings)
        : tracer_(tracer), settings_(settings), shift_(tracer, settings) {}

    /// Starts another sampling set. Throws std::logic_error for more than most_lanes pixels.
    /// @param set     base paths of T, one for each pixel; must stay valid until the next begin()
    /// @param counts  g of each base path (SamplingSet::counts); must stay valid until the next begin()
    void begin(std::span<const BasePath* const> set, std::span<const float> counts);

    /// Shifts one base path to all pixels of T and adds its light to them, theory (9).
    /// @param base      index of the base path in the set
    /// @param scale     1/q of Russian roulette on reuse. 0: the path is not reused, and only its light that is
    ///                  never shifted is added, to its own pixel.
    /// @param radiance  sums of all pixels of T
    /// @param arriving  sums for basis components, one lane for each pixel of T; null: not needed
    void share(int base, float scale, std::span<Rgb> radiance, ArrivingLight* arriving = nullptr);

    /// Adds the arriving light of a path that no other pixel reuses.
    void keep(const BasePath& path, int lane, ArrivingLight& arriving);

    /// Returns the radiance of a path that is shifted to the other pixels of its set.
    Rgb shared_light(const BasePath& path) const { return keeps_direct() ? path.indirect : path.radiance(); }
    /// Returns the luminance of shared_light() divided by the albedo of x_1. Finite; -1 for an empty path.
    float arriving_luminance(const BasePath& path) const {
        const float l = luminance(shared_light(path) / path.albedo);
        return path.empty() ? -1 : std::min(l, std::numeric_limits<float>::max());
    }
    /// Returns the radiance of a path that is never shifted.
    Rgb kept_light(const BasePath& path) const { return keeps_direct() ? path.direct : Rgb(0); }

    /// Returns the outcome of the last share() for each pixel of T; undefined for the base's own pixel. Empty: no
    /// shift was tried.
    std::span<const ShiftOutcome> outcomes() const {
        return {outcomes_.values.data(), is_tried_ ? set_.size() : 0};
    }

    // Light paths of the last share(), for observers. Valid if a shift was tried.

    const LightPaths& light_paths() const { return light_; }
    const OffsetPaths& offset_paths() const { return paths_; }
    /// Returns the weight g_k / R of a light path, theory (9) and (20), times `scale`; 0 if it carries no light.
    float weight(int slot, float scale) const {
        const float count = counts_[base_];
        return light_.is_alive(slot) ? scale * count / ratio_sum(slot) : 0;
    }
    /// Sets the observer of the next share(); null: none.
    void set_observer(ShiftObserver* observer) {
        observer_ = observer;
        shift_.set_observer(observer);
    }

private:
    bool keeps_direct() const { return settings_.shift == ShiftKind::reconnection; }
    void shift_to_all(int base);
    void replay_to_all(int base);
    void notify_of_replay(int m);
    void record_replayed_scatters(int m);
    void settle_outcomes(int base);
    void balance(int base, float scale, std::span<Rgb> radiance) const;
    void add_own_arriving(const BasePath& path, int slot, float factor, int lane, ArrivingLight& arriving) const;
    void balance_components(int base, float scale, ArrivingLight& arriving);
    /// Returns R of a light path, theory (8) and (20).
    float ratio_sum(int slot) const;

    Tracer tracer_;
    ShiftSettings settings_;
    std::span<const BasePath* const> set_;
    std::span<const float> counts_;
    int base_ = 0;            ///< base path of the last share()
    PrimaryVertices primary_; ///< x_1 of all pixels of T; empty until the first shift
    Shift shift_;
    LightPaths light_;
    OffsetPaths paths_;
    PendingEdges edges_;
    BasePath replayed_;
    LightPaths replayed_light_;
    std::vector<FirstScatter*> replayed_scatters_; ///< first of the light sample at y_1, second of all other slots
    Vec3Lanes carried_; ///< weighted sum of c_m over the light paths through one first scatter
    OutcomeLanes outcomes_;
    bool is_tried_ = false;
    ShiftObserver* observer_ = nullptr;
    LaneMask arrived_; ///< pixels with at least one valid shift
    LaneMask lost_;    ///< pixels with an occluded edge
};

} // namespace tessera
