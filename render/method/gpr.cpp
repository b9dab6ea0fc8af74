#include "render/method/pass.h"

namespace tessera {

namespace {

/// One tile: T is the tile and one more column and row, so that both pixels of every gradient are in it; without
/// them the gradients across tile borders would be biased [Bauszat 2017, 3.2].
void render_tile(const Pass& pass, PixelRect inner, Worker& worker, Film& film) {
    const PixelRect set = inner.with_halo(pass.size);
    worker.set.clear();
    worker.set.add(set);
    share_light(pass, pass.settings.roulette, worker);
    for (int y = inner.y0; y < inner.y1; ++y)
        for (int x = inner.x0; x < inner.x1; ++x) {
            const int i = (y - set.y0) * set.width() + x - set.x0;
            const Rgb* here = worker.set.radiance.data() + i;
            PixelSample sample = worker.set.sample(i, worker.reuse);
            if (x + 1 < set.x1)
                sample.dx = here[1] - here[0];
            if (y + 1 < set.y1)
                sample.dy = here[set.width()] - here[0];
            if (pass.settings.primal == PrimalSource::base)
                sample.primal = worker.base.at(x, y).radiance();
            add_sample(pass, x, y, sample, worker, film);
        }
}

} // namespace

/// Gradient-domain path reusing [Bauszat 2017]. As every pixel of T gets its share of every light path of T, the
/// gradients are the differences of these shares: sum of (c_n - c_m) / R.
void render_gpr(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    worker.base.trace(pass, worker.tracer, area.with_halo(pass.size));
    pass.grid.for_each_part(block, [&](PixelRect inner) { render_tile(pass, inner, worker, film); });
}

} // namespace tessera
