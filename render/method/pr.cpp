#include "render/method/pass.h"

namespace tessera {

namespace {

void share_and_add(const Pass& pass, Worker& worker, Film& film) {
    share_light(pass, pass.settings.roulette, worker);
    for (int i = 0; i < worker.set.size(); ++i) {
        const glm::ivec2 p = worker.set.pixels[static_cast<std::size_t>(i)];
        add_sample(pass, p.x, p.y, worker.set.sample(i, worker.reuse), worker, film);
    }
}

void render_rooks(const Pass& pass, PixelRect tile, std::vector<int>& columns, Worker& worker, Film& film) {
    pass.grid.shuffle_columns(tile, columns);
    for (int pattern = 0; pattern < tile.width(); ++pattern) {
        worker.set.clear();
        pass.grid.for_each_rook(tile, columns, pattern, [&](int x, int y) { worker.set.add(x, y); });
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
    pass.grid.for_each_part(block, [&](PixelRect part) {
        worker.set.clear();
        worker.set.add(part);
        share_and_add(pass, worker, film);
    });
}

} // namespace tessera
