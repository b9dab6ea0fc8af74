#pragma once

#include "recon/image.h"
#include "render/memory.h"
#include "render/method/pixel_rect.h"
#include "render/method/settings.h"

namespace tessera {

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
    /// @param luminance  of what each pixel's base path has to share; negative: it sees nothing
    void learn(const Image<float>& luminance);
    /// The same of one pixel. A plan's bits depend on the order of those of a tile's evidence(): row by row.
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

} // namespace tessera
