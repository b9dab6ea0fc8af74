#include "render/method/method_sets.h"

namespace tessera {

/// Gradient-domain path tracing [Kettunen 2015]: the primal is path tracing's, each gradient is the difference of
/// two neighbours that share the light of their base paths. Counted are the shifts to the pixel itself.
void render_gpt(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    // One more column and row, as the gradients of the last pixels need their neighbours' base paths.
    worker.base.trace(pass, worker.tracer, area.with_halo(pass.size));
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            const BasePath& path = worker.base.at(x, y);
            PixelSample sample{path.radiance(), Rgb(0), Rgb(0), path.very_direct};
            for_each_gpt_set(pass, {x, y}, worker.set, [&](PixelRect, Rgb PixelSample::*gradient) {
                share_light(pass, RouletteKind::none, worker);
                sample.*gradient = worker.set.radiance[1] - worker.set.radiance[0];
                sample.reuse += worker.set.reuse[0];
            });
            add_sample(pass, x, y, sample, worker, film);
        }
}

} // namespace tessera
