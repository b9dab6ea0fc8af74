#include "render/method/method_sets.h"

namespace tessera {

/// Path reusing: T is a tile or an N-rooks pattern [Bekaert 2002]; with the shift that copies half vectors it is
/// generalized path reusing [Bauszat 2017, 3.1].
void render_pr(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    worker.base.trace(pass, worker.tracer, block.clipped(pass.size));
    for_each_pr_set(pass, block, worker.set, [&](PixelRect) {
        share_light(pass, pass.settings.roulette, worker);
        for (int i = 0; i < worker.set.size(); ++i) {
            const glm::ivec2 p = worker.set.pixels[static_cast<std::size_t>(i)];
            add_sample(pass, p.x, p.y, worker.set.sample(i, worker.reuse), worker, film);
        }
    });
}

} // namespace tessera
