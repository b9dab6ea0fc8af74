#include "render/estimator/method_sets.h"
#include "render/estimator/pass.h"

#include <glm/vec2.hpp>

// The four methods side by side. Each traces the base paths of a block, lets every sampling set share its light
// (share_light), and adds what the pixels got; what T is, and so what makes it this method, is in method_sets.h.

namespace tessera {

namespace {

/// Path tracing: T = {k}, so R = 1, and c_k has the weights of emitter against BSDF sampling that every base path
/// takes [Veach 1997].
void render_pt(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    const CameraSample from = pass.camera_sample({area.x0, area.y0});
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            trace_pixel(pass, worker.tracer, x, y, from, worker.path);
            const PixelSample sample{worker.path.radiance(), Rgb(0), Rgb(0), worker.path.very_direct};
            add_sample(pass, x, y, sample, worker, film);
        }
}

/// Path reusing: T is a tile or an N-rooks pattern [Bekaert 2002]; with the shift that copies half vectors it is
/// generalized path reusing [Bauszat 2017, 3.1].
void render_pr(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    worker.base.trace(pass, worker.tracer, area, {area.x0, area.y0});
    for_each_pr_set(pass, block, worker.set, [&](PixelRect) {
        share_light(pass, roulette_of(pass.settings), worker);
        for (int i = 0; i < worker.set.size(); ++i) {
            const glm::ivec2 p = worker.set.pixels[static_cast<std::size_t>(i)];
            add_sample(pass, p.x, p.y, worker.set.sample(i, worker.reuse), worker, film);
        }
    });
}

/// Gradient-domain path tracing [Kettunen 2015]: the primal is path tracing's, each gradient is the difference of
/// two neighbours that share the light of their base paths. Of the shifts, those to the pixel itself are counted.
void render_gpt(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    // One more column and row, as the gradients of the last pixels need their neighbours' base paths.
    worker.base.trace(pass, worker.tracer, area.with_halo(pass.size), {area.x0, area.y0});
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            const BasePath& path = worker.base.at(x, y);
            const Rgb albedo = pass.albedo_of(path);
            PixelSample sample{coefficient(path.radiance(), albedo), Rgb(0), Rgb(0), path.very_direct, albedo};
            for_each_gpt_set(pass, {x, y}, worker.set, [&](PixelRect, Rgb PixelSample::*gradient) {
                share_light(pass, roulette_of(pass.settings), worker);
                sample.*gradient = worker.set.coefficient(1) - worker.set.coefficient(0);
                sample.reuse += worker.set.reuse[0];
            });
            add_sample(pass, x, y, sample, worker, film);
        }
}

/// Adds what the inner pixels of worker.set got. `all` is the rectangle of the set.
void add_tile(const Pass& pass, PixelRect inner, PixelRect all, Worker& worker, Film& film) {
    for (int y = inner.y0; y < inner.y1; ++y)
        for (int x = inner.x0; x < inner.x1; ++x) {
            const int i = (y - all.y0) * all.width() + x - all.x0;
            const Rgb here = worker.set.coefficient(i);
            PixelSample sample = worker.set.sample(i, worker.reuse);
            if (x + 1 < all.x1)
                sample.dx = worker.set.coefficient(i + 1) - here;
            if (y + 1 < all.y1)
                sample.dy = worker.set.coefficient(i + all.width()) - here;
            if (pass.settings.primal == PrimalSource::base)
                sample.primal = coefficient(worker.base.at(x, y).radiance(), sample.albedo);
            add_sample(pass, x, y, sample, worker, film);
        }
}

/// Gradient-domain path reusing [Bauszat 2017]. As every pixel of T gets its share of every light path of T, the
/// gradients are the differences of these shares: sum of (c_n - c_m) / R; or of them over the albedos, sum of
/// (c_n / a_n - c_m / a_m) / R, as what a pixel got from all paths is divided by one albedo.
void render_gpr(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    worker.base.trace(pass, worker.tracer, area.with_halo(pass.size), {area.x0, area.y0});
    for_each_gpr_set(pass, block, worker.set, [&](PixelRect inner, PixelRect all) {
        share_light(pass, roulette_of(pass.settings), worker);
        add_tile(pass, inner, all, worker, film);
    });
}

} // namespace

void render_block(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    switch (pass.settings.method) {
    case Method::pt:
        return render_pt(pass, block, worker, film);
    case Method::pr:
        return render_pr(pass, block, worker, film);
    case Method::gpt:
        return render_gpt(pass, block, worker, film);
    case Method::gpr:
        return render_gpr(pass, block, worker, film);
    }
}

} // namespace tessera
