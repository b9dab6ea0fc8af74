#include "render/estimator/methods.h"

#include "render/estimator/method_sets.h"
#include "render/estimator/set_reuse.h"

#include <glm/vec2.hpp>

// The four methods side by side. Each traces the base paths of a block, reuses them within each sampling set T
// (reuse_paths), and adds the results to the film. method_sets.h defines T, which is what distinguishes the
// methods.

namespace tessera {

namespace {

/// Adds a sample to the film. At the edges of directly visible emitters, several camera rays replace its directly
/// visible emission (Pass::very_direct): such rays are cheap, and no other pixel reuses their result. The
/// pre-pass finds these edges, because edges that samples find would bias pixels with a small emitter upward.
void add_sample(const Pass& pass, int x, int y, PixelSample sample, Worker& worker, Film& film) {
    if (film.has_lamp_edge(x, y))
        sample.very_direct = pass.very_direct(worker.tracer, x, y);
    for (int more = film.features().wanted(x, y); more > 0; --more)
        film.add_feature_sample(x, y, pass.index,
                                pass.feature_sample(worker.tracer, x, y, film.features().count(x, y)),
                                worker.counters);
    film.add(x, y, pass.index, sample, worker.counters);
}

/// Returns the basis components of the radiance of pixel (x, y) from its own base path, with its filter weight;
/// empty without such a basis.
/// @param coefficient  without filter weight
std::span<const Rgb> own_components(const Pass& pass, int x, int y, Rgb coefficient, Rgb albedo, Worker& worker,
                                    const Film& film) {
    if (!is_expanded(pass.settings))
        return {};
    worker.own.reset(pass.settings.basis, {&albedo, 1});
    worker.reuse.keep(worker.base.at(x, y), 0, worker.own);
    worker.own_components.resize(static_cast<std::size_t>(worker.own.components()));
    worker.own.expand(0, coefficient, film.projection(x, y), worker.own_components.data());
    for (Rgb& component : worker.own_components)
        component *= worker.base.at(x, y).weight;
    return worker.own_components;
}

/// Path tracing: T = {k}, so R = 1, and the pixel gets c_k of theory (4), with the MIS weights of emitter and
/// BSDF sampling [Veach 1997].
void render_pt(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            trace_pixel(pass, worker.tracer, x, y, pass.camera_sample({x, y}), worker.path);
            record_light(pass, worker.path, worker.found);
            PixelSample sample{worker.path.weight * worker.path.radiance(), Rgb(0), Rgb(0),
                               worker.path.very_direct};
            sample.coverage = pass.coverage_of(worker.path);
            add_sample(pass, x, y, sample, worker, film);
        }
}

/// Traces the base paths of the pixels of a block and of its border.
void trace_base_paths(const Pass& pass, PixelRect area, PixelRect with_others, Worker& worker) {
    worker.base.trace(pass, worker.tracer, with_others, {area.x0, area.y0});
    for_each_square(area, 1, [&](PixelRect p) { record_light(pass, worker.base.at(p.x0, p.y0), worker.found); });
}

/// Adds the estimate of a pixel from all sets of the block that contain it. A pixel without a set, as in an image
/// of one pixel, has the radiance of its own base path.
void add_reused(const Pass& pass, int x, int y, Worker& worker, Film& film) {
    const BasePath& path = worker.base.at(x, y);
    const Rgb albedo = pass.albedo_of(path);
    const Rgb own = coefficient(path.radiance(), albedo);
    PixelSample sample{path.weight * own,
                       Rgb(0),
                       Rgb(0),
                       path.very_direct,
                       albedo,
                       worker.set_means.reuse(x, y),
                       worker.reuse.arriving_luminance(path)};
    if (worker.set_means.has(x, y))
        worker.set_means.take_primal(x, y, sample);
    else
        sample.components = own_components(pass, x, y, own, albedo, worker, film);
    sample.coverage = pass.coverage_of(path);
    worker.set_means.take_gradients(x, y, sample);
    add_sample(pass, x, y, sample, worker, film);
}

/// Reuses the paths of the sampling set T, worker.set, at sub-pixel position number `position`. Does nothing if T
/// has no such position.
/// @param all  rectangle of the pixels of T; empty: T is no rectangle, and has no gradients
void reuse_in_set(const Pass& pass, PixelRect all, int position, Worker& worker, const Film& film) {
    SamplingSet& set = worker.set;
    set.positions = pass.positions_of(set.pixels);
    set.position = position;
    if (position >= set.positions)
        return;
    reuse_paths(pass, roulette_of(pass.settings), worker);
    set.expand(film);
    worker.set_means.add(set, all);
}

/// Traces what the pixels of worker.base see from each position, and calls `visit(position)`. There is one
/// position unless a pixel is mixed and a pixel reuses paths.
template <class Visit>
void for_each_position(const Pass& pass, PixelRect block, Worker& worker, Visit&& visit) {
    bool reuses = false;
    pass.grid.for_each_split(
        block, [&](PixelRect, int paths_without_reuse) { reuses = reuses || paths_without_reuse == 0; });
    if (!reuses || !worker.base.is_mixed())
        return visit(0);
    for (int position = 0; position < camera_positions(pass.settings); ++position) {
        worker.base.see_from(pass, worker.tracer, position);
        visit(position);
    }
}

/// Path reusing: T is a tile or an N-rooks pattern, and each pixel gets theory (9) [Bekaert 2002]; with the
/// shift that copies half vectors it is generalized path reusing [Bauszat 2017, 3.1].
void render_pr(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    trace_base_paths(pass, area, area, worker);
    worker.set_means.begin(area, 0);
    for_each_position(pass, block, worker, [&](int position) {
        for_each_pr_set(pass, block, worker.set,
                        [&](PixelRect) { reuse_in_set(pass, {0, 0, 0, 0}, position, worker, film); });
    });
    for_each_square(area, 1, [&](PixelRect p) { add_reused(pass, p.x0, p.y0, worker, film); });
}

/// Gradient-domain path tracing [Kettunen 2015]: each gradient is the difference of two neighbours that reuse
/// each other's base paths, theory (13). The primal is the mean over the sets of the pixel with each of its
/// neighbours; a pixel without neighbours has its path-traced radiance. A pixel's counters cover the shifts to
/// it.
void render_gpt(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    // The gradients of the last pixels need the base paths of one more column and row.
    trace_base_paths(pass, area, area.with_halo(pass.size), worker);
    worker.set_means.begin(area, component_count(pass.settings));
    for_each_square(area, 1, [&](PixelRect pixel) {
        for_each_gpt_set(pass, {pixel.x0, pixel.y0}, worker.set,
                         [&](PixelRect all) { reuse_in_set(pass, all, 0, worker, film); });
    });
    for_each_square(area, 1, [&](PixelRect p) { add_reused(pass, p.x0, p.y0, worker, film); });
}

/// Computes the means of `count` base paths, theory (21), for each pixel of worker.set, which reuses no paths.
/// Pixels of the border get the radiance of their first path; if they are in a later set without reuse, that set
/// overwrites it.
void take_means(const Pass& pass, PixelRect inner, int count, Worker& worker) {
    for (glm::ivec2 p : worker.set.pixels) {
        MeanOfPaths& mean = worker.base.mean(p.x, p.y) = {};
        const int paths = inner.contains(p) ? count : 1;
        mean.add(pass, worker.base.at(p.x, p.y), paths);
        for (int number = 1; number < paths; ++number) {
            trace_pixel(pass, worker.tracer, p.x, p.y, pass.base_sample(p, {inner.x0, inner.y0}, number),
                        worker.path, number);
            mean.add(pass, worker.path, paths);
        }
    }
}

/// Adds pixels that reuse no paths. Their gradients are plain differences of their means, theory (21), so a
/// reconstruction returns these means. Gradients across the block's border and to pixels with reuse differ
/// slightly.
void add_alone(const Pass& pass, PixelRect inner, PixelRect all, int count, Worker& worker, Film& film) {
    for (int y = inner.y0; y < inner.y1; ++y)
        for (int x = inner.x0; x < inner.x1; ++x) {
            const MeanOfPaths& here = worker.base.mean(x, y);
            PixelSample sample{here.coefficient, Rgb(0), Rgb(0), here.very_direct};
            sample.set_albedo(here.moments);
            if (x + 1 < all.x1)
                sample.dx = worker.base.mean(x + 1, y).coefficient - here.coefficient;
            if (y + 1 < all.y1)
                sample.dy = worker.base.mean(x, y + 1).coefficient - here.coefficient;
            sample.paths = count;
            sample.coverage = here.coverage;
            sample.luminance = worker.reuse.arriving_luminance(worker.base.at(x, y));
            add_sample(pass, x, y, sample, worker, film);
        }
}

/// Gradient-domain path reusing [Bauszat 2017]. Each pixel m of T receives c_m / R from every light path of T,
/// theory (9), so a gradient is the sum of (c_n - c_m) / R, theory (13). With albedo demodulation it is the sum
/// of (c_n / a_n - c_m / a_m) / R, theory (27), because one albedo divides all radiance of a pixel.
void render_gpr(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    trace_base_paths(pass, area, area.with_halo(pass.size), worker);
    worker.set_means.begin(area, component_count(pass.settings));
    for_each_position(pass, block, worker, [&](int position) {
        for_each_gpr_set(pass, block, worker.set, [&](PixelRect inner, PixelRect all, int paths_without_reuse) {
            if (paths_without_reuse == 0)
                reuse_in_set(pass, all, position, worker, film);
            else if (position == 0)
                take_means(pass, inner, paths_without_reuse, worker);
        });
    });
    pass.grid.for_each_split(block, [&](PixelRect inner, int paths_without_reuse) {
        if (paths_without_reuse > 0)
            add_alone(pass, inner, inner.with_halo(pass.size), paths_without_reuse, worker, film);
        else
            for_each_square(inner, 1, [&](PixelRect p) { add_reused(pass, p.x0, p.y0, worker, film); });
    });
}

} // namespace

void render_block(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    worker.found.clear();
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

Image<float> reuse_set_sizes(const Pass& pass) {
    Image<float> sizes(pass.size.x, pass.size.y, 1);
    SamplingSet set;
    for (const PixelRect& block : blocks_of(pass)) {
        const auto note = [&](PixelRect inner, bool reuses = true) {
            for (glm::ivec2 p : set.pixels)
                if (inner.contains(p) && reuses)
                    sizes(p.x, p.y) = static_cast<float>(set.size());
        };
        if (pass.settings.method == Method::gpr)
            for_each_gpr_set(pass, block, set,
                             [&](PixelRect inner, PixelRect, int alone) { note(inner, !alone); });
        else
            for_each_pr_set(pass, block, set, [&](PixelRect inner) { note(inner); });
    }
    return sizes;
}

} // namespace tessera
