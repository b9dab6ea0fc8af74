#include "render/estimator/method_sets.h"
#include "render/estimator/pass.h"

#include <glm/vec2.hpp>

// The four methods side by side. Each traces the base paths of a block, lets every sampling set share its light
// (share_light), and adds what the pixels got; what T is, and so what makes it this method, is in method_sets.h.

namespace tessera {

namespace {

/// The parts of what pixel (x, y) gets from its own base path alone; none without such a basis.
std::span<const Rgb> own_parts(const Pass& pass, int x, int y, Rgb coefficient, Rgb albedo, Worker& worker,
                               const Film& film) {
    if (!is_expanded(pass.settings))
        return {};
    worker.own.reset(pass.settings.basis, {&albedo, 1});
    worker.reuse.keep(worker.base.at(x, y), 0, worker.own);
    worker.own_parts.resize(static_cast<std::size_t>(worker.own.parts()));
    worker.own.expand(0, coefficient, film.projection(x, y), worker.own_parts.data());
    return worker.own_parts;
}

/// Path tracing: T = {k}, so R = 1, and c_k has the weights of emitter against BSDF sampling that every base path
/// takes [Veach 1997].
void render_pt(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            trace_pixel(pass, worker.tracer, x, y, pass.camera_sample({x, y}), worker.path);
            note_light(pass, worker.path, worker.found);
            const PixelSample sample{worker.path.radiance(), Rgb(0), Rgb(0), worker.path.very_direct};
            add_sample(pass, x, y, sample, worker, film);
        }
}

/// Traces the base paths of the pixels of a block, and of others whose light they get.
void trace_base_paths(const Pass& pass, PixelRect area, PixelRect with_others, Worker& worker) {
    worker.base.trace(pass, worker.tracer, with_others, {area.x0, area.y0});
    for_each_square(area, 1, [&](PixelRect p) { note_light(pass, worker.base.at(p.x0, p.y0), worker.found); });
}

/// Adds the light of a pixel from all sets of the block that contain it. A pixel without a set, as in an image of
/// one pixel, has the light of its own base path.
void add_shared(const Pass& pass, int x, int y, Worker& worker, Film& film) {
    const BasePath& path = worker.base.at(x, y);
    const Rgb albedo = pass.albedo_of(path);
    PixelSample sample{coefficient(path.radiance(), albedo),
                       Rgb(0),
                       Rgb(0),
                       path.very_direct,
                       albedo,
                       worker.set_means.reuse(x, y),
                       worker.reuse.arriving_luminance(path)};
    sample.own = path.radiance();
    if (worker.set_means.has(x, y))
        worker.set_means.take_primal(x, y, sample);
    else
        sample.parts = own_parts(pass, x, y, sample.primal, albedo, worker, film);
    worker.set_means.take_gradients(x, y, sample);
    add_sample(pass, x, y, sample, worker, film);
}

/// Lets the pixels of worker.set share at one of the positions from which it is seen, if it is from so many.
/// @param all  the rectangle that T is; empty: it is none, and has no gradients
void share_in_set(const Pass& pass, PixelRect all, int position, Worker& worker, const Film& film) {
    SamplingSet& set = worker.set;
    set.positions = pass.positions_of(set.pixels);
    set.position = position;
    if (position >= set.positions)
        return;
    share_light(pass, roulette_of(pass.settings), worker);
    set.expand(film);
    worker.set_means.add(set, all);
}

/// Sees worker.base, the base paths of a block, from all positions in turn, and calls `visit(position)`; from one
/// unless any of its pixels is mixed, and any of them shares.
template <class Visit>
void for_each_position(const Pass& pass, PixelRect block, Worker& worker, Visit&& visit) {
    bool shares = false;
    pass.grid.for_each_part(block, [&](PixelRect, int paths_alone) { shares = shares || paths_alone == 0; });
    if (!shares || !worker.base.is_mixed())
        return visit(0);
    for (int position = 0; position < camera_positions(pass.settings); ++position) {
        worker.base.see_from(pass, worker.tracer, position);
        visit(position);
    }
}

/// Path reusing: T is a tile or an N-rooks pattern [Bekaert 2002]; with the shift that copies half vectors it is
/// generalized path reusing [Bauszat 2017, 3.1].
void render_pr(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    trace_base_paths(pass, area, area, worker);
    worker.set_means.begin(area, 0);
    for_each_position(pass, block, worker, [&](int position) {
        for_each_pr_set(pass, block, worker.set, [&](PixelRect) {
            share_in_set(pass, {0, 0, 0, 0}, position, worker, film);
        });
    });
    for_each_square(area, 1, [&](PixelRect p) { add_shared(pass, p.x0, p.y0, worker, film); });
}

/// Gradient-domain path tracing [Kettunen 2015]: each gradient is the difference of two neighbours that share the
/// light of their base paths; the primal is the mean of what the pixel got in all sets that it is in, with each of
/// its neighbours, or path tracing's. Of the shifts, those to the pixel itself are counted.
void render_gpt(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    // One more column and row, as the gradients of the last pixels need their neighbours' base paths.
    trace_base_paths(pass, area, area.with_halo(pass.size), worker);
    worker.set_means.begin(area, part_count(pass.settings));
    for_each_square(area, 1, [&](PixelRect pixel) {
        for_each_gpt_set(pass, {pixel.x0, pixel.y0}, worker.set,
                         [&](PixelRect all) { share_in_set(pass, all, 0, worker, film); });
    });
    for_each_square(area, 1, [&](PixelRect p) { add_shared(pass, p.x0, p.y0, worker, film); });
}

/// Where the pixels of worker.set share nothing: finds the means of `count` base paths of each. Beyond the set,
/// what the neighbours' first paths bring, until they have a mean of their own: sets that follow write over it.
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

/// Adds pixels that share nothing. Their gradients are mere differences of their means: then the means are all
/// that a reconstruction finds. Only across the block's border, and to pixels that share, they are not quite.
void add_alone(const Pass& pass, PixelRect inner, PixelRect all, int count, Worker& worker, Film& film) {
    for (int y = inner.y0; y < inner.y1; ++y)
        for (int x = inner.x0; x < inner.x1; ++x) {
            const MeanOfPaths& here = worker.base.mean(x, y);
            PixelSample sample{here.coefficient, Rgb(0), Rgb(0), here.very_direct, here.albedo};
            sample.beside = here.radiance - here.coefficient * here.albedo;
            if (x + 1 < all.x1)
                sample.dx = worker.base.mean(x + 1, y).coefficient - here.coefficient;
            if (y + 1 < all.y1)
                sample.dy = worker.base.mean(x, y + 1).coefficient - here.coefficient;
            sample.albedo_spread = here.albedo_squares - here.albedo * here.albedo;
            sample.value_spread = here.albedo_values - here.albedo * here.radiance;
            sample.paths = count;
            sample.own = here.radiance;
            sample.luminance = worker.reuse.arriving_luminance(worker.base.at(x, y));
            add_sample(pass, x, y, sample, worker, film);
        }
}

/// Gradient-domain path reusing [Bauszat 2017]. As every pixel of T gets its share of every light path of T, the
/// gradients are the differences of these shares: sum of (c_n - c_m) / R; or of them over the albedos, sum of
/// (c_n / a_n - c_m / a_m) / R, as what a pixel got from all paths is divided by one albedo.
void render_gpr(const Pass& pass, PixelRect block, Worker& worker, Film& film) {
    const PixelRect area = block.clipped(pass.size);
    trace_base_paths(pass, area, area.with_halo(pass.size), worker);
    worker.set_means.begin(area, part_count(pass.settings));
    for_each_position(pass, block, worker, [&](int position) {
        for_each_gpr_set(pass, block, worker.set, [&](PixelRect inner, PixelRect all, int paths_alone) {
            if (paths_alone == 0)
                share_in_set(pass, all, position, worker, film);
            else if (position == 0)
                take_means(pass, inner, paths_alone, worker);
        });
    });
    pass.grid.for_each_part(block, [&](PixelRect inner, int paths_alone) {
        if (paths_alone > 0)
            add_alone(pass, inner, inner.with_halo(pass.size), paths_alone, worker, film);
        else
            for_each_square(inner, 1, [&](PixelRect p) { add_shared(pass, p.x0, p.y0, worker, film); });
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

Image<float> sharers_of(const Pass& pass) {
    Image<float> sharers(pass.size.x, pass.size.y, 1);
    SamplingSet set;
    for (const PixelRect& block : blocks_of(pass)) {
        const auto note = [&](PixelRect inner, bool shares = true) {
            for (glm::ivec2 p : set.pixels)
                if (inner.contains(p) && shares)
                    sharers(p.x, p.y) = static_cast<float>(set.size());
        };
        if (pass.settings.method == Method::gpr)
            for_each_gpr_set(pass, block, set,
                             [&](PixelRect inner, PixelRect, int alone) { note(inner, !alone); });
        else
            for_each_pr_set(pass, block, set, [&](PixelRect inner) { note(inner); });
    }
    return sharers;
}

} // namespace tessera
