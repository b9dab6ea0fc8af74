#include "render/method/method_sets.h"

namespace tessera {

namespace {

/// Adds what the inner pixels of worker.set got. `all` is the rectangle of the set.
void add_tile(const Pass& pass, PixelRect inner, PixelRect all, Worker& worker, Film& film) {
    for (int y = inner.y0; y < inner.y1; ++y)
        for (int x = inner.x0; x < inner.x1; ++x) {
            const int i = (y - all.y0) * all.width() + x - all.x0;
            const Rgb* here = worker.set.radiance.data() + i;
            PixelSample sample = worker.set.sample(i, worker.reuse);
            if (x + 1 < all.x1)
                sample.dx = here[1] - here[0];
            if (y + 1 < all.y1)
                sample.dy = here[all.width()] - here[0];
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
    for_each_gpr_set(pass, block, worker.set, [&](PixelRect inner, PixelRect all) {
        share_light(pass, pass.settings.roulette, worker);
        add_tile(pass, inner, all, worker, film);
    });
}

} // namespace tessera
