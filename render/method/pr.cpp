#include "render/method/pass.h"

#include <numeric>

namespace tessera {

namespace {

void share_and_add(const Pass& pass, Worker& worker, Film& film) {
    share_light(pass, pass.settings.roulette, worker);
    for (int i = 0; i < worker.set.size(); ++i) {
        const glm::ivec2 p = worker.set.pixels[static_cast<std::size_t>(i)];
        film.add(p.x, p.y, pass.index, worker.set.sample(i, worker.reuse), worker.counters);
    }
}

/// A permutation of the columns of a tile, another one for every tile and pass [Fisher and Yates 1938].
void shuffle_columns(const Pass& pass, PixelRect tile, std::vector<int>& columns) {
    columns.resize(static_cast<std::size_t>(tile.width()));
    std::iota(columns.begin(), columns.end(), 0);
    const Random random = pass.tile_random(tile);
    for (int i = tile.width() - 1; i > 0; --i) {
        const float u = random.draw(i, Draw::direction);
        std::swap(columns[static_cast<std::size_t>(i)],
                  columns[static_cast<std::size_t>(u * static_cast<float>(i + 1))]);
    }
}

/// N-rooks patterns: N pixels on an N x N square, one in each row and column. Moved along the rows, one
/// permutation makes N patterns, in which every pixel of the square occurs once [Bekaert 2002].
void render_rooks(const Pass& pass, PixelRect tile, std::vector<int>& columns, Worker& worker, Film& film) {
    const int n = tile.width();
    shuffle_columns(pass, tile, columns);
    for (int pattern = 0; pattern < n; ++pattern) {
        worker.set.clear();
        for (int row = 0; row < n; ++row) {
            const int x = tile.x0 + (columns[static_cast<std::size_t>(row)] + pattern) % n, y = tile.y0 + row;
            if (x >= 0 && x < pass.size.x && y >= 0 && y < pass.size.y)
                worker.set.add(x, y);
        }
        if (worker.set.size() > 0)
            share_and_add(pass, worker, film);
    }
}

} // namespace

/// Path reusing: T is a tile or an N-rooks pattern [Bekaert 2002]; with the shift that copies half vectors it is
/// generalized path reusing [Bauszat 2017, 3.1].
void render_pr(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    worker.base.trace(pass, worker.tracer, block.clipped(pass.size));
    if (pass.settings.pattern == Pattern::rooks) {
        std::vector<int> columns;
        for_each_square(block, pass.settings.tile,
                        [&](PixelRect tile) { render_rooks(pass, tile, columns, worker, film); });
        return;
    }
    for_each_part(pass, block, [&](PixelRect part) {
        worker.set.clear();
        worker.set.add(part);
        share_and_add(pass, worker, film);
    });
}

} // namespace tessera
