#pragma once

#include "recon/image.h"
#include "render/estimator/learned_reuse.h"
#include "render/sampling/sampling.h"
#include "render/settings/settings.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace tessera {

/// The reuse sets of one pass: a grid of tiles, their tile splits, and N-rooks patterns.
class TileGrid {
public:
    /// Keeps references to settings and `learned`.
    /// @param pass         counts from 0
    /// @param learned      state that this pass uses
    /// @param film_offset  of the image in its film, pixels, >= 0: the grid is that of the whole film
    TileGrid(glm::ivec2 size, const RenderSettings& settings, const LearnedReuse& learned, int pass,
             glm::ivec2 film_offset = glm::ivec2(0));

    /// Corner of the first tile, in (-tile, 0]. Each pass draws another origin, so no pixel is always at the edge
    /// of a tile, and the grid is not visible in the picture [Bekaert 2002; Bauszat 2017, 3.3].
    const glm::ivec2 origin;
    const glm::ivec2 size; ///< of the image

    /// Returns column and row, in the whole film, of the block of a pixel. Workers render blocks of whole tiles,
    /// or of pixels if the method has no tiles. Pixels only reuse base paths of their own block, including those
    /// of its border.
    glm::ivec2 block_of(glm::ivec2 pixel) const { return first_block_ + (pixel - block_origin) / block_edge; }
    /// Returns the pixels of a pixel's block; it may reach beyond the image.
    PixelRect block_at(glm::ivec2 pixel) const;
    const int block_edge; ///< in pixels
    const glm::ivec2 block_origin;

    /// Returns the tile of a pixel; it may reach beyond the image.
    PixelRect tile_at(glm::ivec2 pixel) const;
    /// Returns the tile split of a pixel, clipped to the image.
    PixelRect split_at(glm::ivec2 pixel) const;
    bool is_mixed(glm::ivec2 pixel) const { return learned_.is_mixed(pixel); }
    /// Returns the number of base paths of a pixel that reuses no paths; 0: it reuses paths.
    int paths_alone_at(glm::ivec2 pixel) const;

    /// Calls `visit(split, paths_without_reuse)` for all nonempty splits of the tiles of a block, clipped to the
    /// image. See LearnedReuse::paths_without_reuse.
    template <class Visit>
    void for_each_split(PixelRect block, Visit&& visit) const {
        for_each_square(block, settings_.tile, [&](PixelRect tile) {
            learned_.for_each_piece(tile, [&](PixelRect piece) {
                const int paths_without_reuse = learned_.paths_without_reuse(piece);
                for_each_square(piece, learned_.split_edge(piece), [&](PixelRect split) {
                    if (const PixelRect inner = split.clipped(size); !inner.empty())
                        visit(inner, paths_without_reuse);
                });
            });
        });
    }

    /// Returns a permutation of the columns of a tile, another one for each tile and pass [Fisher and Yates
    /// 1938].
    void shuffle_columns(PixelRect tile, std::vector<int>& columns) const;
    /// Calls `visit(x, y)` for the pixels of N-rooks pattern `index` that lie in the image. A pattern has one
    /// pixel in each row and column of an N x N square. Cyclic shifts of one permutation make N patterns, which
    /// together contain each pixel of the square once [Bekaert 2002].
    template <class Visit>
    void for_each_rook(PixelRect tile, const std::vector<int>& columns, int index, Visit&& visit) const {
        const int n = tile.width();
        for (int row = 0; row < n; ++row) {
            const int x = tile.x0 + (columns[row] + index) % n, y = tile.y0 + row;
            if (x >= 0 && x < size.x && y >= 0 && y < size.y)
                visit(x, y);
        }
    }
    /// Returns the index of a pixel's pattern in its tile.
    int pattern_at(glm::ivec2 pixel, PixelRect tile, const std::vector<int>& columns) const;

private:
    PixelRect piece_at(glm::ivec2 pixel) const;

    const RenderSettings& settings_;
    const LearnedReuse& learned_;
    int pass_;
    glm::ivec2 film_offset_, first_block_;
};

/// Draws the origin of the grid of tiles for a pass.
inline glm::ivec2 origin_of(const RenderSettings& settings, int pass) {
    const Random random(settings.seed, 0xfffffffeu, static_cast<std::uint32_t>(pass));
    return -glm::ivec2(random.draw_2d(0, Draw::direction) * static_cast<float>(settings.tile));
}

/// Returns the square of a pixel in the grid of squares that begins at `corner`. The pixel must not lie left of
/// or above the corner.
inline PixelRect square_at(glm::ivec2 pixel, glm::ivec2 corner, int edge) {
    const glm::ivec2 min = corner + (pixel - corner) / edge * edge;
    return {min.x, min.y, min.x + edge, min.y + edge};
}

/// Returns the edge of blocks: small enough for many blocks, and large enough that border paths are few.
inline int block_edge_of(const RenderSettings& settings) {
    constexpr int usual = 24;
    return reuses_paths(settings.method) ? settings.tile * std::max(1, usual / settings.tile) : usual;
}

/// Returns the offset of an image in the grid of squares that the film's tiles or blocks begin, pixels, >= 0.
inline glm::ivec2 offset_in_grid(const RenderSettings& settings, int pass, glm::ivec2 film_offset) {
    return reuses_paths(settings.method) ? film_offset - origin_of(settings, pass) : film_offset;
}

inline TileGrid::TileGrid(glm::ivec2 size_, const RenderSettings& settings, const LearnedReuse& learned, int pass,
                          glm::ivec2 film_offset)
    : origin(-((film_offset - origin_of(settings, pass)) % settings.tile)), size(size_),
      block_edge(block_edge_of(settings)),
      block_origin(-(offset_in_grid(settings, pass, film_offset) % block_edge)), settings_(settings),
      learned_(learned), pass_(pass), film_offset_(film_offset),
      first_block_(offset_in_grid(settings, pass, film_offset) / block_edge) {}

inline PixelRect TileGrid::block_at(glm::ivec2 pixel) const {
    return square_at(pixel, block_origin, block_edge);
}

inline PixelRect TileGrid::tile_at(glm::ivec2 pixel) const {
    return square_at(pixel, origin, settings_.tile);
}

inline PixelRect TileGrid::piece_at(glm::ivec2 pixel) const {
    PixelRect found = tile_at(pixel);
    learned_.for_each_piece(found, [&](PixelRect piece) { found = piece.contains(pixel) ? piece : found; });
    return found;
}

inline PixelRect TileGrid::split_at(glm::ivec2 pixel) const {
    const PixelRect piece = piece_at(pixel);
    return square_at(pixel, {piece.x0, piece.y0}, learned_.split_edge(piece))
        .clipped({piece.x1, piece.y1})
        .clipped(size);
}

inline int TileGrid::paths_alone_at(glm::ivec2 pixel) const {
    return learned_.paths_without_reuse(piece_at(pixel));
}

inline void TileGrid::shuffle_columns(PixelRect tile, std::vector<int>& columns) const {
    columns.resize(static_cast<std::size_t>(tile.width()));
    std::iota(columns.begin(), columns.end(), 0);
    // The seed differs from that of any path. A tile may begin left of or above the image.
    const Random random(settings_.seed ^ 0x7469'6c65'7300'0000u,
                        pixel_number(glm::ivec2(tile.x0, tile.y0) + film_offset_),
                        static_cast<std::uint32_t>(pass_));
    for (int i = tile.width() - 1; i > 0; --i) {
        const float u = random.draw(i, Draw::direction);
        std::swap(columns[i], columns[static_cast<std::size_t>(u * static_cast<float>(i + 1))]);
    }
}

inline int TileGrid::pattern_at(glm::ivec2 pixel, PixelRect tile, const std::vector<int>& columns) const {
    const int n = tile.width();
    return (pixel.x - tile.x0 - columns[pixel.y - tile.y0] + n) % n;
}

} // namespace tessera
