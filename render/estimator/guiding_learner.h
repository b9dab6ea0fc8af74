#pragma once

#include "render/estimator/path_guiding.h"

#include <memory>
#include <span>
#include <vector>

namespace tessera {

/// Learns from the light that base paths find where to guide those of later passes.
class GuidingLearner {
public:
    /// Adds what the paths of a pass have found, by blocks, whose order the bits depend on. The first that find
    /// anything decide on the grid.
    void learn(std::span<const std::vector<FoundLight>> found);

    /// What is known by now; null: nothing was found.
    std::shared_ptr<const PathGuiding> guiding() const;

    /// Of base paths in pass `index` (from 0) of so many pixels, the share that is to be learnt from: as many as
    /// there are in one pass, but at most about a million, until there are twice as many passes; and a thousand of
    /// each pass. Of all paths, no more is learnt that helps, and where they are cheap it takes a tenth of the
    /// time.
    static float share_of_paths(int pixels, int index);

    /// About the memory that it takes to guide paths: for what a pass finds, until that is learnt,
    static std::uint64_t bytes_of_found(int pixels);
    /// and for what is learnt, and the guides made of it.
    static std::uint64_t bytes_of_learnt();

private:
    /// Of one cell, by bins: sums of irradiance, and of its squares, which tell how many samples these stand on;
    /// and likewise of FoundLight::squares, by shares.
    struct Sums {
        std::array<float, DirectionMap::bins> first{}, second{};
        std::array<double, tried_shares.size()> squares{};
        double fourth = 0; ///< of the squares without a guide

        void add(const FoundLight& found);
        void add(const Sums& other);
        double samples() const;                ///< (sum w)^2 / sum w^2, of all bins
        float best_share(float unknown) const; ///< `unknown`, where too few samples tell
    };
    using Cells = std::vector<std::unique_ptr<Sums>>; ///< null: nothing was found there

    void lay_grid(std::span<const std::vector<FoundLight>> found);
    void add(const FoundLight& found);
    GuidingGrid coarser(int halvings) const;
    Cells merged(int halvings) const;
    static DirectionGuide guide_of(const Sums& sums, const DirectionGuide* prior);

    GuidingGrid grid_;
    Cells cells_;
};

} // namespace tessera
