#pragma once

#include "render/estimator/pass.h"
#include "render/estimator/sampling_set.h"

#include <glm/vec2.hpp>

namespace tessera {

// The sampling sets T of each method, which define the method. Each function stores the pixels of one set after
// the other in `set`, and calls `visit`. PT's set is the pixel alone.

/// Returns the Russian roulette on reuse of a method: none for G-PT, whose sets have two pixels.
inline RouletteKind roulette_of(const RenderSettings& settings) {
    return reuses_paths(settings.method) ? settings.roulette : RouletteKind::none;
}

/// PR: T is a tile, or a tile split [Bekaert 2002]. Calls `visit(inner)`.
template <class Visit>
void for_each_tile_set(const Pass& pass, PixelRect block, SamplingSet& set, Visit&& visit) {
    pass.grid.for_each_split(block, [&](PixelRect inner, int) {
        set.assign(inner);
        visit(inner);
    });
}

/// PR with N-rooks patterns: T is a pattern, spread over a tile [Bekaert 2002]. Calls `visit(tile)`.
template <class Visit>
void for_each_rooks_set(const Pass& pass, PixelRect block, SamplingSet& set, Visit&& visit) {
    std::vector<int> columns;
    for_each_square(block, pass.settings.tile, [&](PixelRect tile) {
        pass.grid.shuffle_columns(tile, columns);
        for (int pattern = 0; pattern < tile.width(); ++pattern) {
            set.clear();
            pass.grid.for_each_rook(tile, columns, pattern, [&](int x, int y) { set.add(x, y); });
            if (set.size() > 0)
                visit(tile);
        }
    });
}

/// PR with the pattern of the settings.
template <class Visit>
void for_each_pr_set(const Pass& pass, PixelRect block, SamplingSet& set, Visit&& visit) {
    if (pass.settings.pattern == Pattern::rooks)
        for_each_rooks_set(pass, block, set, visit);
    else
        for_each_tile_set(pass, block, set, visit);
}

/// G-PT: each gradient of a pixel has a set of its own, the pixel and its neighbour: T = {k, n} [Kettunen 2015].
/// Calls `visit(all)`, where T is `all`. Neighbours outside the image have none.
template <class Visit>
void for_each_gpt_set(const Pass& pass, glm::ivec2 p, SamplingSet& set, Visit&& visit) {
    for (const PixelRect all : {PixelRect{p.x, p.y, p.x + 2, p.y + 1}, PixelRect{p.x, p.y, p.x + 1, p.y + 2}})
        if (all.x1 <= pass.size.x && all.y1 <= pass.size.y) {
            set.assign(all);
            visit(all);
        }
}

/// G-PR: T is PR's tile and one more column and row, so that both pixels of every gradient are in it; without
/// them the gradients across tile borders would be biased [Bauszat 2017, 3.2]. Calls `visit(inner, all,
/// paths_without_reuse)`; T is `all`, row by row; or if there are paths_without_reuse, T = {k} for each pixel of
/// it (LearnedReuse::paths_without_reuse).
template <class Visit>
void for_each_gpr_set(const Pass& pass, PixelRect block, SamplingSet& set, Visit&& visit) {
    pass.grid.for_each_split(block, [&](PixelRect inner, int paths_without_reuse) {
        const PixelRect all = inner.with_halo(pass.size);
        set.assign(all);
        visit(inner, all, paths_without_reuse);
    });
}

/// Puts the sampling sets of a pixel's tile, in the order of render_block(), into `set`, and calls `visit(inner)`
/// for each, where `inner` are the pixels of the tile. PT and G-PT only have the sets that contain the pixel. A
/// pixel that reuses no paths has one set of its own for each of its paths.
template <class Visit>
void for_each_set_of_tile(const Pass& pass, glm::ivec2 p, SamplingSet& set, Visit&& visit) {
    const PixelRect pixel{p.x, p.y, p.x + 1, p.y + 1}, tile = pass.grid.tile_at(p);
    switch (pass.settings.method) {
    case Method::pt:
        set.assign(pixel);
        return visit(pixel);
    case Method::pr:
        return for_each_pr_set(pass, tile, set, visit);
    case Method::gpt:
        return for_each_square(pass.grid.block_at(p).clipped(pass.size), 1, [&](PixelRect owner) {
            for_each_gpt_set(pass, {owner.x0, owner.y0}, set, [&](PixelRect all) {
                if (all.contains(p))
                    visit(pixel);
            });
        });
    case Method::gpr:
        return for_each_gpr_set(pass, tile, set, [&](PixelRect inner, PixelRect, int paths_without_reuse) {
            if (paths_without_reuse == 0)
                return visit(inner);
            for_each_square(inner, 1, [&](PixelRect alone) {
                set.assign(alone);
                for (set.number = 0; set.number < paths_without_reuse; ++set.number)
                    visit(alone);
            });
        });
    }
}

/// Does the same for the sets that contribute to a pixel: for G-PR all sets of its block that contain it,
/// including the sets of the tiles above and on the left. The path inspector uses them.
template <class Visit>
void for_each_set_with(const Pass& pass, glm::ivec2 p, SamplingSet& set, Visit&& visit) {
    if (pass.settings.method != Method::gpr || pass.grid.paths_alone_at(p) > 0)
        return for_each_set_of_tile(pass, p, set, [&](PixelRect inner) {
            if (inner.contains(p) && set.contains(p))
                visit(inner);
        });
    const PixelRect block = pass.grid.block_at(p);
    for_each_gpr_set(pass, block, set, [&](PixelRect inner, PixelRect all, int paths_without_reuse) {
        if (paths_without_reuse == 0 && all.contains(p))
            visit(inner);
    });
}

} // namespace tessera
