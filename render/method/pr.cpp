#include "render/method/pass.h"

namespace tessera {

/// Path reusing: T is a tile [Bekaert 2002], with the shift that copies half vectors [Bauszat 2017, 3.1].
void render_pr(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const int tile = pass.settings.tile;
    worker.base.trace(pass, worker.tracer, block.clipped(pass.size));
    for (int ty = block.y0; ty < block.y1; ty += tile)
        for (int tx = block.x0; tx < block.x1; tx += tile) {
            const PixelRect inner = PixelRect{tx, ty, tx + tile, ty + tile}.clipped(pass.size);
            if (inner.empty())
                continue;
            share_light(pass, inner, Roulette::reuse, worker);
            const Rgb* shared = worker.shared.data();
            for (int y = inner.y0; y < inner.y1; ++y)
                for (int x = inner.x0; x < inner.x1; ++x)
                    film.add(x, y, {*shared++, Rgb(0), Rgb(0), worker.base.at(x, y).very_direct}, worker.counters);
        }
}

} // namespace tessera
