#include "render/method/pass.h"

namespace tessera {

/// Path tracing: T = {k}. The weights 1/R are then those of emitter against BSDF sampling, which every base path
/// has already taken [Veach 1997].
void render_pt(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            trace_pixel(pass, worker.tracer, x, y, worker.path);
            const PixelSample sample{worker.path.radiance(), Rgb(0), Rgb(0), worker.path.very_direct};
            add_sample(pass, x, y, sample, worker, film);
        }
}

} // namespace tessera
