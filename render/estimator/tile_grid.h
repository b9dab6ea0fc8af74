#pragma once

#include "recon/image.h"
#include "render/estimator/reuse_policy.h"
#include "render/sampling/sampling.h"
#include "render/settings/settings.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace tessera {

/// Which pixels of one pass share their light: a grid of tiles, what these are cut into, and N-rooks patterns.
class TileGrid {
public:
    /// `pass` counts from 0. Keeps references to settings and plan, which is the one that this pass had.
    TileGrid(glm::ivec2 size, const RenderSettings& settings, const ReusePlan& plan, int pass);

    /// Where the grid begins, in (-tile, 0]. Each pass draws another origin, so that no pixel is always at the
    /// edge of a tile and the grid does not show in the picture [Bekaert 2002; Bauszat 2017, 3.3].
    const glm::ivec2 origin;
    const glm::ivec2 size; ///< of the image

    /// Blocks of whole tiles, or of pixels where the method has none, are what workers render; base paths are
    /// shared within a block alone, those of its border among them. The column and row of the block that a pixel
    /// is in.
    glm::ivec2 block_of(glm::ivec2 pixel) const { return (pixel - block_origin) / block_edge; }
    /// Its pixels; it may reach beyond the image.
    PixelRect block_at(glm::ivec2 pixel) const;
    const int block_edge; ///< in pixels
    const glm::ivec2 block_origin;

    /// The tile of a pixel; it may reach beyond the image.
    PixelRect tile_at(glm::ivec2 pixel) const;
    /// The square of the tile, cut by the plan and at the image's border, that the pixel is in.
    PixelRect part_at(glm::ivec2 pixel) const;
    bool is_mixed(glm::ivec2 pixel) const { return plan_.is_mixed(pixel); }
    /// How many base paths the pixel takes for itself alone; 0: it shares one.
    int paths_alone_at(glm::ivec2 pixel) const;

    /// Calls `visit(part, paths_alone)` for the squares, not empty, into which the plan cuts the tiles of a block;
    /// paths_alone as ReusePlan has them.
    template <class Visit>
    void for_each_part(PixelRect block, Visit&& visit) const {
        for_each_square(block, settings_.tile, [&](PixelRect tile) {
            plan_.for_each_piece(tile, [&](PixelRect piece) {
                const int paths_alone = plan_.paths_alone(piece);
                for_each_square(piece, plan_.part_edge(piece), [&](PixelRect part) {
                    if (const PixelRect inner = part.clipped(size); !inner.empty())
                        visit(inner, paths_alone);
                });
            });
        });
    }

    /// A permutation of the columns of a tile, another one for every tile and pass [Fisher and Yates 1938].
    void shuffle_columns(PixelRect tile, std::vector<int>& columns) const;
    /// N-rooks patterns: N pixels on an N x N square, one in each row and column. Moved along the rows, one
    /// permutation makes N patterns, in which every pixel of the square occurs once [Bekaert 2002]. Calls
    /// `visit(x, y)` for the pixels of pattern `index` that lie in the image.
    template <class Visit>
    void for_each_rook(PixelRect tile, const std::vector<int>& columns, int index, Visit&& visit) const {
        const int n = tile.width();
        for (int row = 0; row < n; ++row) {
            const int x = tile.x0 + (columns[static_cast<std::size_t>(row)] + index) % n, y = tile.y0 + row;
            if (x >= 0 && x < size.x && y >= 0 && y < size.y)
                visit(x, y);
        }
    }
    /// Which of the patterns of its tile a pixel is in.
    int pattern_at(glm::ivec2 pixel, PixelRect tile, const std::vector<int>& columns) const;

private:
    PixelRect piece_at(glm::ivec2 pixel) const;

    const RenderSettings& settings_;
    const ReusePlan& plan_;
    int pass_;
};

/// Draws the origin of the grid of tiles for a pass.
inline glm::ivec2 origin_of(const RenderSettings& settings, int pass) {
    const Random random(settings.seed, 0xfffffffeu, static_cast<std::uint32_t>(pass));
    return -glm::ivec2(random.draw_2d(0, Draw::direction) * static_cast<float>(settings.tile));
}

/// The square of a given edge, of those that fill the plane from `corner` on, that a pixel beyond it is in.
inline PixelRect square_at(glm::ivec2 pixel, glm::ivec2 corner, int edge) {
    const glm::ivec2 min = corner + (pixel - corner) / edge * edge;
    return {min.x, min.y, min.x + edge, min.y + edge};
}

/// The edge of blocks: small enough for many of them, large enough for a thin border of base paths.
inline int block_edge_of(const RenderSettings& settings) {
    constexpr int usual = 24;
    return reuses_paths(settings.method) ? settings.tile * std::max(1, usual / settings.tile) : usual;
}

inline TileGrid::TileGrid(glm::ivec2 size_, const RenderSettings& settings, const ReusePlan& plan, int pass)
    : origin(origin_of(settings, pass)), size(size_), block_edge(block_edge_of(settings)),
      block_origin(reuses_paths(settings.method) ? origin : glm::ivec2(0)), settings_(settings), plan_(plan),
      pass_(pass) {}

inline PixelRect TileGrid::block_at(glm::ivec2 pixel) const {
    return square_at(pixel, block_origin, block_edge);
}

inline PixelRect TileGrid::tile_at(glm::ivec2 pixel) const {
    return square_at(pixel, origin, settings_.tile);
}

inline PixelRect TileGrid::piece_at(glm::ivec2 pixel) const {
    PixelRect found = tile_at(pixel);
    plan_.for_each_piece(found, [&](PixelRect piece) { found = piece.contains(pixel) ? piece : found; });
    return found;
}

inline PixelRect TileGrid::part_at(glm::ivec2 pixel) const {
    const PixelRect piece = piece_at(pixel);
    return square_at(pixel, {piece.x0, piece.y0}, plan_.part_edge(piece))
        .clipped({piece.x1, piece.y1})
        .clipped(size);
}

inline int TileGrid::paths_alone_at(glm::ivec2 pixel) const {
    return plan_.paths_alone(piece_at(pixel));
}

inline void TileGrid::shuffle_columns(PixelRect tile, std::vector<int>& columns) const {
    columns.resize(static_cast<std::size_t>(tile.width()));
    std::iota(columns.begin(), columns.end(), 0);
    // The seed differs from that of any path. A tile may begin left of and above the image.
    const Random random(settings_.seed ^ 0x7469'6c65'7300'0000u, pixel_number({tile.x0, tile.y0}),
                        static_cast<std::uint32_t>(pass_));
    for (int i = tile.width() - 1; i > 0; --i) {
        const float u = random.draw(i, Draw::direction);
        std::swap(columns[static_cast<std::size_t>(i)],
                  columns[static_cast<std::size_t>(u * static_cast<float>(i + 1))]);
    }
}

inline int TileGrid::pattern_at(glm::ivec2 pixel, PixelRect tile, const std::vector<int>& columns) const {
    const int n = tile.width();
    return (pixel.x - tile.x0 - columns[static_cast<std::size_t>(pixel.y - tile.y0)] + n) % n;
}

} // namespace tessera
