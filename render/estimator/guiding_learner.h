#pragma once

#include "render/paths/path_guiding.h"
#include "render/settings/settings.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tessera {

/// Learns path guides for later passes from the light that base paths find.
class GuidingLearner {
public:
    /// Learns from one pass, whose samples must have been drawn with the last make_guiding(). The first pass that
    /// finds light sets the grid; each half of its samples estimates shares with the guides of the other half.
    /// @param found  samples of each block; the bits of the result depend on the order of blocks
    void learn(std::span<const std::vector<FoundLight>> found);

    /// Makes guides from all samples so far; null: there are none. If guiding does not pay, all shares are 0:
    /// paths draw nothing from the guides, and their samples continue to estimate the shares.
    std::shared_ptr<const PathGuiding> make_guiding(Guiding when);

    /// Returns the fraction of guiding paths: of the base paths of pass `index` (from 0), those from which later
    /// passes learn. Pass 0 of an image of N pixels has min(N, 2^16) guiding paths. Pass p has min(N, 2^18) / P,
    /// and at least min(N, 2^10), where P is the largest power of two up to p; a quarter of that while no
    /// direction is drawn from guides.
    /// @param draws  this pass draws directions from guides
    static float fraction_of_paths(int pixels, int index, bool draws);

    /// Returns the approximate memory for the samples of a pass.
    static std::uint64_t bytes_of_found(int pixels);
    /// Returns the approximate memory for the sums and guides of all cells.
    static std::uint64_t bytes_of_learnt();

private:
    /// Sums over the samples of one cell. Effective numbers of samples are (sum w)^2 / sum w^2.
    struct Sums {
        std::array<float, DirectionMap::bins> first{}, second{}; ///< irradiance and its square, by bin
        std::array<double, share_candidates.size()> squares{};   ///< second_moments(), theory (23)
        double fourth = 0;                                       ///< square of the first of these, without a guide

        void add(const FoundLight& found, const DirectionGuide* known);
        void add(const Sums& other);
        double samples() const;         ///< effective number of samples in all bins
        double share_samples() const;   ///< effective number of samples that estimate shares; 0: too few
        std::size_t best_share() const; ///< index of the best of share_candidates; 0: none pays
    };
    using Cells = std::vector<std::unique_ptr<Sums>>; ///< null: nothing was found there

    void lay_grid(std::span<const std::vector<FoundLight>> found);
    void learn_by_halves(std::span<const std::vector<FoundLight>> found);
    void add(const FoundLight& found, const PathGuiding* drawn_with);
    GuidingGrid coarser(int halvings) const;
    Cells merged(int halvings) const;
    static DirectionGuide guide_of(const Sums& sums, const DirectionGuide* prior);
    double remaining_second_moment() const; ///< see PathGuiding

    GuidingGrid grid_;
    Cells cells_;
    std::shared_ptr<const PathGuiding> guiding_; ///< of the last make_guiding()
};

} // namespace tessera
