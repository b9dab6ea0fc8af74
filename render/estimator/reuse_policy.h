#pragma once

#include "recon/image.h"
#include "render/io/memory.h"
#include "render/settings/settings.h"

#include <span>

namespace tessera {

struct BasePath;
class PathReuse;

/// What one sample of a pixel tells the plan.
struct PlanEvidence {
    float luminance = -1; ///< PathReuse::arriving_luminance of its base path

    // In the first pass of G-PR, of gradients to the right and below:
    float shared_steps = 0; ///< their lengths, as sharing measures them
    float own_steps = 0;    ///< and as mere differences of base paths
    float offset_rays = 0;  ///< rays that an offset took, in the mean of the set
    float base_rays = 0;    ///< rays that the base path took
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
/// What sharing brings shows in the gradients: rho, the mean length of those that sharing measures over that of
/// mere differences of base paths. It is found alike with small squares and with whole tiles; over 18 scenes the
/// squared error of a reconstructed sample was 0.6 to 1.1 rho times that of a path tracer's. Where rho times the
/// cost, in base paths, is too much, the pixels of a tile share nothing for the rest of the render: instead each
/// takes the mean of as many paths of its own as sharing would have cost, so that a pass takes about as long
/// everywhere. G-PR's first pass finds rho, in squares of 2 x 2 pixels, as it is at its cheapest there.
///
/// It looks at earlier passes of the same render only: a choice by the light of the paths at hand, or of passes
/// that a render begun anew will draw again, would be biased.
class ReusePlan {
public:
    ReusePlan(glm::ivec2 size, const RenderSettings& settings);

    /// The edge of the squares into which a tile is cut; the last ones may be smaller. Where pixels share nothing,
    /// and before the first pass of PR, tiles stay whole.
    int part_edge(PixelRect tile) const;

    /// How many base paths each pixel of the tile takes for itself alone; 0: its pixels share one each.
    int paths_alone(PixelRect tile) const;

    /// Learns from a whole pass.
    void learn(const Image<PlanEvidence>& evidence);
    /// Learns from one pixel of a pass. A plan's bits depend on the order of those of a tile's evidence(): row by
    /// row.
    void learn(int x, int y, const PlanEvidence& evidence);

    /// The pixels whose base paths decide on how a tile is cut.
    PixelRect evidence(PixelRect tile) const;

    /// All that it has learnt.
    Memory memory() { return {memory_of(cells_)}; }

private:
    static constexpr int cell_edge = 16; // pixels
    struct Cell {
        double paths = 0, lit = 0, sum = 0, squares = 0;
        double shared_steps = 0, own_steps = 0, offset_rays = 0, base_rays = 0;
    };

    glm::ivec2 cell_of(PixelRect tile) const;
    const Cell& cell(PixelRect tile) const;
    int cut_edge(const Cell& cell) const;

    int tile_;
    bool adapts_;
    bool finds_gain_; ///< the first pass measures what sharing brings
    glm::ivec2 size_;
    Image<Cell> cells_;
};

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
/// there when it is not. The threshold is rr_scale standard deviations of the set's own L, the noise that a lost
/// path would drown in. Then the unit of light does not matter, a set that is lit evenly keeps all its paths, and
/// one in which few paths carry light spends its time on these. As q stands on nothing but the base paths at hand,
/// and survivors weigh 1/q, the estimate stays unbiased.
class ReuseRoulette {
public:
    /// @param settings  has the thresholds; its own kind is not looked at
    ReuseRoulette(RouletteKind kind, const RenderSettings& settings, const PathReuse& reuse,
                  std::span<const BasePath* const> set);

    /// Probability that a path that carries light is reused.
    float survival(const BasePath& path) const;

private:
    const PathReuse& reuse_;
    RouletteKind kind_;
    float threshold_ = 0; // luminance
    float q_min_;
};

} // namespace tessera
