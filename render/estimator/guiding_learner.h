#pragma once

#include "render/paths/path_guiding.h"
#include "render/settings/settings.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tessera {

/// Learns from the light that base paths find where to guide those of later passes.
class GuidingLearner {
public:
    /// Adds what the paths of a pass have found, by blocks, whose order the bits depend on. They tell of shares by
    /// the guiding that was made last, which they are to have been drawn with. The first that find anything decide
    /// on the grid, and each half of them tells by what the other would make.
    void learn(std::span<const std::vector<FoundLight>> found);

    /// Makes anew what is known by now; null: nothing was found. Where it does not pay, all is known, so that
    /// samples go on telling, and nothing drawn from it.
    std::shared_ptr<const PathGuiding> make_guiding(Guiding when);

    /// Returns the fraction of guiding paths: of the base paths of pass `index` (from 0), those from which later
    /// passes learn. Pass 0 of an image of N pixels has min(N, 2^16) guiding paths. Pass p has min(N, 2^18) / P,
    /// and at least min(N, 2^10), where P is the largest power of two up to p; a quarter of that while no
    /// direction is drawn from guides. More guiding paths do not lower the variance.
    /// @param draws  this pass draws directions from guides
    static float fraction_of_paths(int pixels, int index, bool draws);

    /// About the memory that it takes to guide paths: for what a pass finds, until that is learnt,
    static std::uint64_t bytes_of_found(int pixels);
    /// and for what is learnt, and the guides made of it.
    static std::uint64_t bytes_of_learnt();

private:
    /// Of one cell, by bins: sums of irradiance, and of its squares, which tell how many samples these stand on;
    /// and likewise of squares_by_share(), by shares.
    struct Sums {
        std::array<float, DirectionMap::bins> first{}, second{};
        std::array<double, tried_shares.size()> squares{};
        double fourth = 0; ///< of the squares without a guide

        void add(const FoundLight& found, const DirectionGuide* known);
        void add(const Sums& other);
        double samples() const;         ///< (sum w)^2 / sum w^2, of all bins
        double told() const;            ///< likewise, the number of samples that tell of shares; 0: too few
        std::size_t best_tried() const; ///< of tried_shares; 0: none pays
    };
    using Cells = std::vector<std::unique_ptr<Sums>>; ///< null: nothing was found there

    void lay_grid(std::span<const std::vector<FoundLight>> found);
    void learn_by_halves(std::span<const std::vector<FoundLight>> found);
    void add(const FoundLight& found, const PathGuiding* drawn_with);
    GuidingGrid coarser(int halvings) const;
    Cells merged(int halvings) const;
    static DirectionGuide guide_of(const Sums& sums, const DirectionGuide* prior);
    double left_of_squares() const; ///< as in PathGuiding

    GuidingGrid grid_;
    Cells cells_;
    std::shared_ptr<const PathGuiding> guiding_; ///< that was made last
};

} // namespace tessera
