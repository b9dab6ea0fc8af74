#pragma once

#include "recon/image.h"
#include "render/io/memory.h"
#include "render/settings/settings.h"

#include <span>

namespace tessera {

struct BasePath;
class PathReuse;

/// Into what tiles are cut before their pixels share light, so that each path has the offsets that pay.
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
/// It looks at earlier passes of the same render only: a choice by the light of the paths at hand, or of passes
/// that a render begun anew will draw again, would be biased.
class ReusePlan {
public:
    ReusePlan(glm::ivec2 size, const RenderSettings& settings);

    /// The edge of the squares into which a tile is cut; the last ones may be smaller. Nothing is cut before the
    /// first pass.
    int part_edge(PixelRect tile) const;

    /// Learns from a whole pass.
    /// @param luminance  PathReuse::arriving_luminance of each pixel's base path
    void learn(const Image<float>& luminance);
    /// Learns from one pixel of a pass. A plan's bits depend on the order of those of a tile's evidence(): row by
    /// row.
    void learn(int x, int y, float luminance);

    /// The pixels whose base paths decide on how a tile is cut.
    PixelRect evidence(PixelRect tile) const;

    /// All that it has learnt.
    Memory memory() { return {memory_of(cells_)}; }

private:
    static constexpr int cell_edge = 16; // pixels
    struct Cell {
        double paths = 0, lit = 0, sum = 0, squares = 0;
    };

    glm::ivec2 cell_of(PixelRect tile) const;

    int tile_;
    bool adapts_;
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
