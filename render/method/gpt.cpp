#include "render/method/pass.h"

namespace tessera {

namespace {

/// The difference of two neighbours that share the light of their base paths: T = {k, n}. Counts the shift to k.
Rgb gradient(const Pass& pass, PixelRect pair, Worker& worker, PixelSample& sample) {
    worker.set.clear();
    worker.set.add(pair);
    share_light(pass, RouletteKind::none, worker);
    sample.reuse += worker.set.reuse[0];
    return worker.set.radiance[1] - worker.set.radiance[0];
}

} // namespace

/// Gradient-domain path tracing [Kettunen 2015]: the primal is path tracing's, each gradient has a sampling set of
/// its own.
void render_gpt(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    // One more column and row, as the gradients of the last pixels need their neighbours' base paths.
    worker.base.trace(pass, worker.tracer, area.with_halo(pass.size));
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            const BasePath& path = worker.base.at(x, y);
            PixelSample sample{path.radiance(), Rgb(0), Rgb(0), path.very_direct};
            if (x + 1 < pass.size.x)
                sample.dx = gradient(pass, {x, y, x + 2, y + 1}, worker, sample);
            if (y + 1 < pass.size.y)
                sample.dy = gradient(pass, {x, y, x + 1, y + 2}, worker, sample);
            add_sample(pass, x, y, sample, worker, film);
        }
}

} // namespace tessera
