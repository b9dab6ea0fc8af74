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

    /// Of base paths in pass `index` (from 0) of so many pixels, the share that is to be learnt from: at most
    /// about a million of them until there are twice as many passes, whatever the size, so that learning never
    /// takes longer than rendering.
    static float share_of_paths(int pixels, int index);

    /// About the memory that guiding takes: what a pass finds, what is learnt from it, and the maps made of that.
    static std::uint64_t bytes(int pixels);

private:
    /// Of one cell, by bins: sums of irradiance, and of its squares, which tell how many samples these stand on.
    struct Sums {
        std::array<float, DirectionMap::bins> first{}, second{};

        void add(const Sums& other);
        double samples() const; ///< (sum w)^2 / sum w^2, of all bins
    };
    using Cells = std::vector<std::unique_ptr<Sums>>; ///< null: nothing was found there

    void lay_grid(std::span<const std::vector<FoundLight>> found);
    void add(const FoundLight& found);
    GuidingGrid coarser(int halvings) const;
    Cells merged(int halvings) const;
    static DirectionMap map_of(const Sums& sums, const DirectionMap* prior);

    GuidingGrid grid_;
    Cells cells_;
};

} // namespace tessera
