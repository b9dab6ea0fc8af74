#pragma once

#include "recon/image.h"
#include "render/io/memory.h"
#include "render/paths/path_guiding.h"
#include "render/settings/settings.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace tessera {

/// Sums over the base paths of one cell of LearnedReuse.
struct CellStatistics {
    // Number of base paths, of those with light, and sums of PathReuse::arriving_luminance.
    double paths = 0, lit = 0, sum = 0, squares = 0;

    // Results of the pilot pass (pilot.h): sums of add_gradient_noise(), and of the rays per offset path and per
    // base path.
    double reuse_noise = 0, own_noise = 0;
    double offset_rays = 0, base_rays = 0;

    void add_path(double luminance) {
        paths += 1;
        lit += luminance > 0;
        sum += luminance;
        squares += luminance * luminance;
    }
    /// Adds the gradient noise of one set of pixels: with path reuse, and for plain differences of base paths.
    /// Each set weighs the root of the latter. In plain sums, one set with a very bright path would decide on its
    /// cell; with equal weights, sets with hardly any light would.
    void add_gradient_noise(double shared, double own);
    CellStatistics& operator+=(const CellStatistics& more);
};

/// State that a render learns from its earlier passes for the next ones: how each tile is split before its pixels
/// reuse each other's paths, where pixels reuse no paths, and where to guide base paths.
///
/// With a reuse set of N pixels, the error of a pixel falls about as V N^(-a). V is the relative variance of its
/// base paths, and a is about 0.15 to 0.3. The work grows as l N, where l is the fraction of paths that carry
/// light, because only these are shifted. The total error falls fastest for its total work where every place has
/// the same gain for its cost,
///   d(V N^(-a)) / d(l N) = constant,   so that   N ~ (V / l)^(1 / (1 + a)).
/// The program omits the exponent, which is near 1. Tiles stay whole where few paths find light; where paths have
/// nearly equal radiance, tiles are split down to single pixels and their neighbours. The result does not depend
/// on the unit of radiance.
///
/// The noise of gradients shows the benefit of reuse. rho is the length of that noise with reuse, divided by its
/// length for plain differences of base paths; it is a mean over sets, weighted by the roots of the latter. rho^2
/// is about the remaining fraction of the squared error. If rho^2 times the cost in samples of path tracing
/// exceeds 1, the pixels of a cell reuse no paths: each takes the mean of several base paths, theory (21). Their
/// number is the mean cost of reuse elsewhere, so a pass takes about as long everywhere. The pilot pass measures
/// rho in small sets, where it is about as large as in whole tiles.
///
/// It depends on the pilot pass and on earlier passes of the same render only. A choice by the paths of the pass
/// at hand would be biased, and so would be a mean that weights passes by their results. For the same reason the
/// pilot pass is not part of the picture.
class LearnedReuse {
public:
    LearnedReuse(glm::ivec2 size, const RenderSettings& settings);

    /// Returns the first pass that uses this state: it can depend on earlier passes and on no later one. 0 if
    /// passes teach nothing.
    int first_pass() const { return first_pass_; }
    /// Takes over the state of `next` for pass `pass` and later passes.
    void take(const LearnedReuse& next, int pass);

    /// Calls `visit(piece)` for the parts of a tile that are split independently: the whole tile, or its
    /// intersections with the cells if only some of these reuse paths. So each pixel either always or never
    /// reuses paths; otherwise its few noisy samples would spoil the many good ones.
    template <class Visit>
    void for_each_piece(PixelRect tile, Visit&& visit) const;

    /// Returns the edge of the splits of a piece; the last ones may be smaller. A piece stays whole without path
    /// reuse, and before anything is learned.
    int split_edge(PixelRect piece) const;

    /// Returns the number of base paths of each pixel of a piece that reuses no paths; 0: the piece reuses paths.
    int paths_without_reuse(PixelRect piece) const { return is_alone(cell_of(piece)) ? paths_alone_ : 0; }

    /// Learns from the arriving luminances of a pass's base paths; negative: a pixel without a path.
    void learn(const Image<float>& luminance);
    /// Learns from one pixel of a pass. The bits depend on the order of the pixels of a cell: row by row.
    void learn(int x, int y, float luminance);

    /// Cells are squares of the image with separate statistics. A piece belongs to the cell of its centre.
    int cell_count() const { return static_cast<int>(cells_.size()); }
    PixelRect cell(int index) const;
    int cell_of(PixelRect piece) const;

    /// Returns whether a pilot pass must measure all cells before the first pass.
    bool wants_pilot() const { return wants_pilot_; }
    /// Learns from the pilot pass: the statistics of all cells in their order. Which cells reuse paths then holds
    /// for the rest of the render.
    void learn(const std::vector<CellStatistics>& pilot);

    /// Returns the gain of path reuse in a cell at equal cost, 1 / (rho^2 cost): the ratio of the squared errors
    /// of path tracing and path reuse. 0: unknown.
    float gain(int cell) const { return gain_.data()[cell]; }

    /// Directions to which base paths are guided; null: none.
    const PathGuiding* guiding() const { return guiding_.get(); }
    void set_guiding(std::shared_ptr<const PathGuiding> guiding) { guiding_ = std::move(guiding); }

    /// Returns whether a pixel sees several surfaces (PixelFeatures::mixed), so that passes see it from several
    /// positions.
    bool is_mixed(glm::ivec2 pixel) const { return mixed_ && (*mixed_)(pixel.x, pixel.y) != 0; }
    const std::shared_ptr<const Image<std::uint8_t>>& mixed() const { return mixed_; }
    /// @param mixed  1 for each mixed pixel; null: no method uses it
    void set_mixed(std::shared_ptr<const Image<std::uint8_t>> mixed) { mixed_ = std::move(mixed); }

    /// Returns all memory that passes change, except the memory of path guiding.
    Memory memory() {
        return {memory_of(first_pass_), memory_of(cells_), memory_of(gain_), memory_of(paths_alone_)};
    }

private:
    static constexpr int cell_edge = 16; // pixels, at least as many as the edge of any tile
    static_assert(cell_edge >= most_tile);

    const CellStatistics& known_of(PixelRect piece) const { return cells_.data()[cell_of(piece)]; }
    double cost_of_sharing(const CellStatistics& known) const;
    bool is_alone(int cell) const { return gain_.data()[cell] > 0 && gain_.data()[cell] < 1; }
    int best_split_edge(const CellStatistics& known) const;

    int tile_, first_pass_ = 0;
    bool adapts_, learns_, wants_pilot_;
    glm::ivec2 size_;
    Image<CellStatistics> cells_;
    Image<float> gain_; ///< by cells
    std::shared_ptr<const PathGuiding> guiding_;
    std::shared_ptr<const Image<std::uint8_t>> mixed_;
    int paths_alone_ = 4; ///< base paths of a pixel that reuses none; if no cell reuses paths, as many as make
                          ///< halos and pilot cheap
};

template <class Visit>
void LearnedReuse::for_each_piece(PixelRect tile, Visit&& visit) const {
    // At most one border of cells crosses the tile in each direction.
    const auto border = [](int from, int to, int end) {
        const int next = (std::max(from, 0) / cell_edge + 1) * cell_edge;
        return next < std::min(to, end) ? next : to;
    };
    const int x = border(tile.x0, tile.x1, size_.x), y = border(tile.y0, tile.y1, size_.y);
    const PixelRect pieces[] = {
        {tile.x0, tile.y0, x, y}, {x, tile.y0, tile.x1, y}, {tile.x0, y, x, tile.y1}, {x, y, tile.x1, tile.y1}};
    const auto is_like_first = [&](PixelRect piece) {
        return piece.empty() || paths_without_reuse(piece) == paths_without_reuse(pieces[0]);
    };
    if (std::ranges::all_of(pieces, is_like_first))
        return visit(tile);
    for (const PixelRect piece : pieces)
        if (!piece.empty())
            visit(piece);
}

} // namespace tessera
