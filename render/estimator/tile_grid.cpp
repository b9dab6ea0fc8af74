#include "render/estimator/tile_grid.h"

#include "render/sampling/sampling.h"

#include <numeric>
#include <utility>

namespace tessera {

namespace {

glm::ivec2 origin_of(const RenderSettings& settings, int pass) {
    if (!settings.jitter)
        return {0, 0};
    const Random random(settings.seed, 0xfffffffeu, static_cast<std::uint32_t>(pass));
    return -glm::ivec2(random.draw_2d(0, Draw::direction) * static_cast<float>(settings.tile));
}

/// The square of a given edge, of those that fill the plane from `corner` on, that a pixel beyond it is in.
PixelRect square_at(glm::ivec2 pixel, glm::ivec2 corner, int edge) {
    const glm::ivec2 min = corner + (pixel - corner) / edge * edge;
    return {min.x, min.y, min.x + edge, min.y + edge};
}

} // namespace

TileGrid::TileGrid(glm::ivec2 size_, const RenderSettings& settings, const ReusePlan& plan, int pass)
    : origin(origin_of(settings, pass)), size(size_), settings_(settings), plan_(plan), pass_(pass) {}

PixelRect TileGrid::tile_at(glm::ivec2 pixel) const {
    return square_at(pixel, origin, settings_.tile);
}

PixelRect TileGrid::part_at(glm::ivec2 pixel) const {
    const PixelRect tile = tile_at(pixel);
    return square_at(pixel, {tile.x0, tile.y0}, part_edge(tile)).clipped({tile.x1, tile.y1}).clipped(size);
}

void TileGrid::shuffle_columns(PixelRect tile, std::vector<int>& columns) const {
    columns.resize(static_cast<std::size_t>(tile.width()));
    std::iota(columns.begin(), columns.end(), 0);
    // Numbers for decisions about a tile, not cut off, other ones than those of any path. Tiles may begin left of
    // and above the image.
    const int number = (tile.y0 + settings_.tile) * (size.x + settings_.tile) + tile.x0 + settings_.tile;
    const Random random(settings_.seed ^ 0x7469'6c65'7300'0000u, static_cast<std::uint32_t>(number),
                        static_cast<std::uint32_t>(pass_));
    for (int i = tile.width() - 1; i > 0; --i) {
        const float u = random.draw(i, Draw::direction);
        std::swap(columns[static_cast<std::size_t>(i)],
                  columns[static_cast<std::size_t>(u * static_cast<float>(i + 1))]);
    }
}

int TileGrid::pattern_at(glm::ivec2 pixel, PixelRect tile, const std::vector<int>& columns) const {
    const int n = tile.width();
    return (pixel.x - tile.x0 - columns[static_cast<std::size_t>(pixel.y - tile.y0)] + n) % n;
}

} // namespace tessera
