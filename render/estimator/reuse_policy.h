#pragma once

#include "recon/image.h"
#include "render/estimator/path_guiding.h"
#include "render/io/memory.h"
#include "render/settings/settings.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace tessera {

struct BasePath;
class PathReuse;

/// What is known of the base paths of one cell of a plan: sums.
struct PlanEvidence {
    // Of base paths, and of PathReuse::arriving_luminance:
    double paths = 0, lit = 0, sum = 0, squares = 0;

    // Of what a pilot tried (pilot.h): add_gradient_noise(); and rays that offsets took, and base paths, in the
    // mean for each.
    double shared_noise = 0, own_noise = 0;
    double offset_rays = 0, base_rays = 0;

    void add_path(double luminance) {
        paths += 1;
        lit += luminance > 0;
        sum += luminance;
        squares += luminance * luminance;
    }
    /// Of a set of pixels: lengths of the noise of gradients, as sharing measures them and as mere differences of
    /// base paths. Sets count by the root of the latter: in plain sums, one in which a path has found a hundred
    /// times the light would decide on its cell; if all counted alike, sets that hardly any light reaches would.
    void add_gradient_noise(double shared, double own);
    PlanEvidence& operator+=(const PlanEvidence& more);
};

/// Into what tiles are cut before their pixels share light, so that each path has the offsets that pay; and where
/// none pays, so that pixels share nothing.
///
/// With N pixels that share, the error of a pixel falls about as V N^(-a), where V is the relative variance of its
/// base paths, and a was measured to be 0.15 (a room lit directly) to 0.3 (one lit through a door); the work grows
/// as l N, where l is the share of the paths that carry light, as only these are shifted. The total error of the
/// image falls fastest for its total work when every place has the same gain for its cost,
///   d(V N^(-a)) / d(l N) = constant,   so that   N ~ (V / l)^(1 / (1 + a)),
/// here without the exponent, which is near 1. Where few paths find light, tiles stay whole; where they bring
/// alike they are cut down to single pixels and their neighbours. Lights a thousand times as bright change
/// nothing.
///
/// What sharing brings shows in the noise of the gradients: rho is its length with sharing over that of mere
/// differences of base paths, the mean over sets by the roots of the latter, and rho^2 about what is left of the
/// squared error. Where that, times the cost in samples of a path tracer, is above 1, pixels share nothing:
/// instead each takes the mean of as many paths of its own as sharing costs elsewhere in the picture, so that a
/// pass takes about as long everywhere. A pilot finds rho before the first pass, in small sets, where it is about
/// what it is in whole tiles. (Of lengths of gradients, not of their noise, it was too large at edges; with rho
/// instead of rho^2, no limit was right on metals, glass, and in rooms alike.)
///
/// It looks at the pilot and at earlier passes of the same render only: a choice by the light of the paths at
/// hand, or of passes that a render begun anew will draw again, would be biased. So would be a mean in which a
/// pass counts for more or less by what was found in it: that is why the pilot is no part of the picture.
class ReusePlan {
public:
    ReusePlan(glm::ivec2 size, const RenderSettings& settings);

    /// The first of the passes that go by it: what earlier ones have told may be in it, and nothing of these. 0
    /// where passes tell nothing that others could go by.
    int first_pass() const { return first_pass_; }
    /// Passes from this one on go by what `next` has learnt.
    void take(const ReusePlan& next, int pass);

    /// Calls `visit(piece)` for what is cut by itself: the whole tile; or, where it reaches into cells of which
    /// some share and others do not, what it has of each. So a pixel always shares, or never: else its few bad
    /// samples would spoil the many good ones.
    template <class Visit>
    void for_each_piece(PixelRect tile, Visit&& visit) const;

    /// The edge of the squares into which a piece is cut; the last ones may be smaller. Where pixels share
    /// nothing, and before anything is known, it stays whole.
    int part_edge(PixelRect piece) const;

    /// How many base paths each pixel of the piece takes for itself alone; 0: its pixels share one each.
    int paths_alone(PixelRect piece) const { return is_alone(cell_of(piece)) ? paths_alone_ : 0; }

    /// Learns from a whole pass: the arriving luminance of its base paths; below 0: of none.
    void learn(const Image<float>& luminance);
    /// Learns from one pixel of a pass. A plan's bits depend on the order of those of a cell: row by row.
    void learn(int x, int y, float luminance);

    /// Squares of the image, of which each is judged by itself; a piece belongs to the one that its middle is in.
    int cell_count() const { return static_cast<int>(cells_.size()); }
    PixelRect cell(int index) const;
    int cell_of(PixelRect piece) const;

    /// Whether a pilot is to tell of all cells before the first pass.
    bool wants_pilot() const { return wants_pilot_; }
    /// Learns from it, of all cells in their order: what it tells of who shares holds for the rest of the render.
    void learn(const std::vector<PlanEvidence>& pilot);

    /// What sharing brings in a cell for its cost, as the pilot found it: 1 / (rho^2 cost), how many times fewer
    /// paths a path tracer's error takes; 0: it is not known.
    float gain(int cell) const { return gain_.data()[cell]; }

    /// Where base paths are guided to; null: nowhere.
    const PathGuiding* guiding() const { return guiding_.get(); }
    void set_guiding(std::shared_ptr<const PathGuiding> guiding) { guiding_ = std::move(guiding); }

    /// Whether a pixel sees several things (PixelLooks::mixed), so that a pass sees it from several positions.
    bool is_mixed(glm::ivec2 pixel) const { return mixed_ && (*mixed_)(pixel.x, pixel.y) != 0; }
    const std::shared_ptr<const Image<std::uint8_t>>& mixed() const { return mixed_; }
    /// @param mixed  1 for each pixel that does; null: nobody asks
    void set_mixed(std::shared_ptr<const Image<std::uint8_t>> mixed) { mixed_ = std::move(mixed); }

    /// All that it has learnt from passes, but for where paths are guided to.
    Memory memory() {
        return {memory_of(first_pass_), memory_of(cells_), memory_of(gain_), memory_of(paths_alone_)};
    }

private:
    static constexpr int cell_edge = 16; // pixels, no fewer than those of any tile
    static_assert(cell_edge >= most_tile);

    const PlanEvidence& known_of(PixelRect piece) const { return cells_.data()[cell_of(piece)]; }
    double cost_of_sharing(const PlanEvidence& known) const;
    bool is_alone(int cell) const { return gain_.data()[cell] > 0 && gain_.data()[cell] < 1; }
    int cut_edge(const PlanEvidence& known) const;

    int tile_, first_pass_ = 0;
    bool adapts_, learns_, wants_pilot_;
    glm::ivec2 size_;
    Image<PlanEvidence> cells_;
    Image<float> gain_; ///< of sharing, by cells
    std::shared_ptr<const PathGuiding> guiding_;
    std::shared_ptr<const Image<std::uint8_t>> mixed_;
    int paths_alone_ = 4; ///< where pixels share nothing; as many as make halos and pilot cheap, if none does
};

template <class Visit>
void ReusePlan::for_each_piece(PixelRect tile, Visit&& visit) const {
    // The borders of cells go through the tile once at the most in each direction.
    const auto border = [](int from, int to, int end) {
        const int next = (std::max(from, 0) / cell_edge + 1) * cell_edge;
        return next < std::min(to, end) ? next : to;
    };
    const int x = border(tile.x0, tile.x1, size_.x), y = border(tile.y0, tile.y1, size_.y);
    const PixelRect pieces[] = {
        {tile.x0, tile.y0, x, y}, {x, tile.y0, tile.x1, y}, {tile.x0, y, x, tile.y1}, {x, y, tile.x1, tile.y1}};
    const auto is_like_first = [&](PixelRect piece) {
        return piece.empty() || paths_alone(piece) == paths_alone(pieces[0]);
    };
    if (std::ranges::all_of(pieces, is_like_first))
        return visit(tile);
    for (const PixelRect piece : pieces)
        if (!piece.empty())
            visit(piece);
}

/// What the roulette decided on one base path.
struct ReuseDecision {
    float survival = 0; ///< q, the probability that it is reused; 0: it is dark, there is nothing to reuse
    float scale = 0;    ///< 1/q, what it weighs; 0: it is not reused

    bool is_dark() const { return survival <= 0; }
    bool survives() const { return scale > 0; }
};

/// The roulette that decides which base paths of one sampling set are shifted to all its pixels. A path whose
/// light has luminance L is reused with probability
///   q = clamp(L / threshold, q_min, 1).
/// Absolute: L is what leaves toward the camera and the threshold a radiance, rr_delta [Bauszat 2017, 3.3].
/// Relative: L is what arrives (PathReuse::arriving_luminance), as the light of a path that begins on a dark texel
/// is worth as much to the bright ones as any; lost with its own small radiance for a measure, it would weigh 1/q
/// there when it is not. The threshold is one standard deviation of the L of the set, the noise that hides a lost
/// path; 2 and 4 are not better (TRIALS.md, "scale of the reuse roulette"). Then the unit of light does not
/// matter, a set that is lit evenly keeps all its paths, and one in which few paths carry light spends its time on
/// these. As q stands on nothing but the base paths at hand, and survivors weigh 1/q, the estimate stays unbiased.
class ReuseRoulette {
public:
    /// Least probability that a path with light is reused [Bauszat 2017]. It is above 0, because a path can bring
    /// far more light to a neighbour than to its own pixel.
    static constexpr float q_min = 0.1f;

    /// @param settings  has rr_delta; `kind` replaces its own kind
    ReuseRoulette(RouletteKind kind, const RenderSettings& settings, const PathReuse& reuse,
                  std::span<const BasePath* const> set);

    /// Probability that a path that carries light is reused.
    float survival(const BasePath& path) const;

private:
    const PathReuse& reuse_;
    RouletteKind kind_;
    float threshold_ = 0; // luminance
};

} // namespace tessera
