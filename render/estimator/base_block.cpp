#include "render/estimator/base_block.h"

#include "render/film/film.h"

#include <cmath>

namespace tessera {

namespace {
/// Rejects and counts an invalid path, and leaves it empty.
void reject_if_invalid(const Pass& pass, const Tracer& tracer, glm::ivec2 pixel, BasePath& path) {
    if (is_finite(path.radiance() + path.very_direct))
        return;
    tracer.counters.refuse({pass.index, pixel.y, pixel.x});
    path.reset(path.random);
}
} // namespace

void BaseBlock::trace(const Pass& pass, const Tracer& tracer, PixelRect rect, glm::ivec2 inside, int number) {
    rect_ = rect;
    inside_ = inside;
    number_ = number;
    mixed_.clear();
    first_vertex_of_.clear();
    const auto count = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
    if (paths_.size() < count)
        paths_.resize(count);
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            trace_pixel(pass, tracer, x, y, pass.base_sample({x, y}, inside, number), paths_[index(x, y)], number);
            if (pass.is_mixed({x, y}))
                mixed_.emplace_back(x, y);
        }
}

void BaseBlock::see_from(const Pass& pass, const Tracer& tracer, int position) {
    const CameraSample from = pass.sample_at(position, inside_, number_);
    first_vertex_of_.assign(static_cast<std::size_t>(rect_.width()) * static_cast<std::size_t>(rect_.height()),
                            -1);
    if (first_vertices_.size() < mixed_.size())
        first_vertices_.resize(mixed_.size());
    for (std::size_t i = 0; i < mixed_.size(); ++i) {
        const glm::ivec2 p = mixed_[i];
        if (pass.turn(p) == position)
            continue;
        first_vertex_of_[index(p.x, p.y)] = static_cast<std::int16_t>(i);
        trace_first_vertex(tracer, pass.camera_ray(p.x, p.y, from), pass.pixel_width(),
                           pass.random(p.x, p.y, number_), first_vertices_[i]);
        first_vertices_[i].set_weight(from.weight);
        reject_if_invalid(pass, tracer, p, first_vertices_[i]);
    }
}

void MeanOfPaths::add(const Pass& pass, const BasePath& path, int count) {
    const Rgb a = pass.albedo_of(path);
    const float share = 1 / static_cast<float>(count), weighted_share = path.weight * share;
    coefficient += tessera::coefficient(path.radiance(), a) * weighted_share;
    moments.add(a, path.radiance(), share, weighted_share);
    very_direct += path.very_direct * share;
    coverage += pass.coverage_of(path) * share;
}

void trace_pixel(const Pass& pass, const Tracer& tracer, int x, int y, const CameraSample& from, BasePath& path,
                 int number) {
    trace_base_path(tracer, pass.camera_ray(x, y, from), pass.pixel_width(), pass.random(x, y, number), path);
    path.set_weight(from.weight);
    reject_if_invalid(pass, tracer, {x, y}, path);
}

bool is_guiding_path(const Pass& pass, const Random& random) {
    return pass.guiding_fraction > 0 && random.draw(0, Draw::path_survival) < pass.guiding_fraction;
}

void record_light(const Pass& pass, const BasePath& path, std::vector<FoundLight>& found) {
    if (!is_guiding_path(pass, path.random))
        return;
    for (int i = 0; i < path.size(); ++i) {
        const BaseVertex& v = path[i];
        const Vertex& x = v.vertex;
        if ((i + 1 == path.size() && !v.escapes) || x.bsdf.roughness() < PathGuiding::least_roughness)
            continue;
        const Rgb beyond = (v.hit_contribution + v.arriving) / (v.pdf_w * v.survival);
        if (!(luminance(beyond) > 0) || !is_finite(beyond))
            continue;
        const float irradiance = v.is_delta ? 0 : luminance(beyond) * std::abs(v.to_next.z);
        found.push_back(
            {x.position, x.frame.normal, x.to_world(v.to_next), irradiance, luminance(v.f_cos * beyond), v.pdf_w});
    }
}

} // namespace tessera
