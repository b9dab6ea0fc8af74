#include "render/estimator/pass.h"

#include "render/estimator/guiding_learner.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace tessera {

std::uint64_t Worker::bytes(const RenderSettings& settings) {
    constexpr int long_path = 16; // vertices: memory is for 2^n of them, and some of a block's paths are as long
    const auto edge = static_cast<std::uint64_t>(block_edge_of(settings) + 1); // with one more column and row
    const std::uint64_t paths = settings.method == Method::pt ? 1 : edge * edge;
    const auto vertices = static_cast<std::uint64_t>(std::min(settings.max_depth, long_path));
    constexpr std::uint64_t a_vertex = sizeof(BaseVertex) + sizeof(LightSample);
    const std::size_t means = (finds_gain_of_sharing(settings) ? sizeof(MeanOfPaths) : 0) +
                              (settings.method != Method::pt ? SetMeans::bytes(part_count(settings)) : 0);
    const std::uint64_t a_glimpse = has_positions(settings) ? sizeof(BasePath) + a_vertex : 0;
    return sizeof(Worker) + paths * (sizeof(BasePath) + means + vertices * a_vertex + a_glimpse);
}

namespace {
float telling_share_of(glm::ivec2 size, const RenderSettings& settings, const PathGuiding* guiding, int index) {
    if (settings.path_guiding == Guiding::off)
        return 0;
    return GuidingLearner::share_of_paths(size.x * size.y, index, guiding && guiding->draws());
}

/// Returns the pass with which the nets at x_1 begin: the first pass that uses this plan, or the last power of
/// two, whichever is later. Nets begin at powers of two even if the render learns nothing.
int begin_of_nets(const ReusePlan& plan, int pass) {
    return std::max(plan.first_pass(), static_cast<int>(std::bit_floor(static_cast<unsigned>(pass))));
}
} // namespace

Pass::Pass(const Scene& scene_, const Camera& camera, glm::ivec2 size_, const RenderSettings& settings_,
           const ReusePlan& plan, int index_)
    : scene(scene_), settings(settings_), size(size_), index(index_), grid(size_, settings_, plan, index_),
      telling_share(telling_share_of(size_, settings_, plan.guiding(), index_)), projection_(camera, size_),
      has_lens_(camera.aperture_radius > 0),
      numbers_(settings_.seed, index_, begin_of_nets(plan, index_), camera_positions(settings_)) {}

/// Blocks are moved with the grid of tiles. Those of a square begin at one place, so that few pixels change from
/// one sequence to another, and see only parts of both.
std::uint32_t Pass::place_of(glm::ivec2 pixel) const {
    constexpr int blocks = 8;
    const glm::ivec2 at = settings.method == Method::pt ? pixel : grid.block_of(pixel) / blocks;
    return pixel_number(at);
}

CameraSample Pass::sample_at(int position, glm::ivec2 inside, int path) const {
    const std::uint32_t place = place_of(inside);
    return {numbers_.subpixel(place, path, position),
            has_lens_ ? sample_disk(numbers_.lens(place, path, position)) : glm::vec2(0)};
}

namespace {

// Keys of nets, over the looks of a pixel.
constexpr std::uint64_t looks_in_pixel = 0x6c6f'6f6b'7069'786cu, looks_on_lens = 0x6c6f'6f6b'6c65'6e73u;

} // namespace

/// @param subpixel, lens  digits that points are shifted by
CameraSample Pass::look_from(std::uint64_t subpixel, std::uint64_t lens, std::uint32_t point) const {
    const auto at = [&](std::uint64_t shift, std::uint64_t net) {
        return unit_square(shift ^ net_point(point, net));
    };
    return {at(subpixel, looks_in_pixel), has_lens_ ? sample_disk(at(lens, looks_on_lens)) : glm::vec2(0)};
}

/// Shifts of digits for all looks at a pixel, which are no pass's.
Random Pass::shift_of_looks(int x, int y) const {
    return {settings.seed, pixel_number({x, y}), 0xffffffffu};
}

Rgb Pass::very_direct(const Tracer& tracer, int x, int y) const {
    const Random shift = shift_of_looks(x, y);
    const std::uint64_t subpixel = shift.digits(2, Draw::direction), lens = shift.digits(3, Draw::direction);
    constexpr std::uint32_t rays = edge_emitter_rays;
    const std::uint32_t first = static_cast<std::uint32_t>(index) * rays;
    Rgb sum(0);
    for (std::uint32_t i = 0; i < rays; ++i)
        sum += tracer.very_direct_along(camera_ray(x, y, look_from(subpixel, lens, first + i)));
    return sum / static_cast<float>(rays);
}

Look Pass::look_at(const Tracer& tracer, int x, int y, int point) const {
    const Random shift = shift_of_looks(x, y);
    const CameraSample sample = look_from(shift.digits(0, Draw::direction), shift.digits(1, Draw::direction),
                                          static_cast<std::uint32_t>(point));
    const Random numbers(settings.seed, pixel_number({x, y}),
                         0xfffffffcu - static_cast<std::uint32_t>(point)); // no pass's either
    return look_along(tracer, camera_ray(x, y, sample), numbers);
}

bool Pass::look_at(const Tracer& tracer, int x, int y, int point, Vertex& seen) const {
    constexpr std::uint64_t middle = 0x8000'0000'8000'0000u; // where the first look is
    const CameraSample sample = look_from(middle ^ net_point(0, looks_in_pixel),
                                          middle ^ net_point(0, looks_on_lens), static_cast<std::uint32_t>(point));
    return tracer.closest(camera_ray(x, y, sample), seen, RayKind::camera, tracer.first_lookup());
}

namespace {
void refuse_if_not_finite(const Pass& pass, const Tracer& tracer, glm::ivec2 pixel, BasePath& path) {
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
    glimpse_of_.clear();
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
    glimpse_of_.assign(static_cast<std::size_t>(rect_.width()) * static_cast<std::size_t>(rect_.height()), -1);
    if (glimpses_.size() < mixed_.size())
        glimpses_.resize(mixed_.size());
    for (std::size_t i = 0; i < mixed_.size(); ++i) {
        const glm::ivec2 p = mixed_[i];
        if (pass.turn(p) == position)
            continue;
        glimpse_of_[index(p.x, p.y)] = static_cast<std::int16_t>(i);
        trace_first_vertex(tracer, pass.camera_ray(p.x, p.y, from), pass.pixel_width(),
                           pass.random(p.x, p.y, number_), glimpses_[i]);
        refuse_if_not_finite(pass, tracer, p, glimpses_[i]);
    }
}

std::size_t most_blocks(glm::ivec2 size, const RenderSettings& settings) {
    const int edge = block_edge_of(settings);
    const glm::ivec2 most =
        (size + settings.tile + edge - 1) / edge; // the first begin up to a tile before the image
    return static_cast<std::size_t>(most.x) * static_cast<std::size_t>(most.y);
}

std::vector<PixelRect> blocks_of(const Pass& pass) {
    const int edge = pass.grid.block_edge;
    const glm::ivec2 origin = pass.grid.block_origin;
    std::vector<PixelRect> blocks;
    for (int y = origin.y; y < pass.size.y; y += edge)
        for (int x = origin.x; x < pass.size.x; x += edge)
            if (!PixelRect{x, y, x + edge, y + edge}.clipped(pass.size).empty())
                blocks.push_back({x, y, x + edge, y + edge});
    return blocks;
}

void MeanOfPaths::add(const Pass& pass, const BasePath& path, int count) {
    const Rgb a = pass.albedo_of(path);
    const float share = 1 / static_cast<float>(count);
    coefficient += tessera::coefficient(path.radiance(), a) * share;
    radiance += path.radiance() * share;
    albedo += a * share;
    albedo_squares += a * a * share;
    albedo_values += a * path.radiance() * share;
    very_direct += path.very_direct * share;
}

void trace_pixel(const Pass& pass, const Tracer& tracer, int x, int y, const CameraSample& from, BasePath& path,
                 int number) {
    trace_base_path(tracer, pass.camera_ray(x, y, from), pass.pixel_width(), pass.random(x, y, number), path);
    refuse_if_not_finite(pass, tracer, {x, y}, path);
}

bool tells_of_light(const Pass& pass, const Random& random) {
    return pass.telling_share > 0 && random.draw(0, Draw::path_survival) < pass.telling_share;
}

void note_light(const Pass& pass, const BasePath& path, std::vector<FoundLight>& found) {
    if (!tells_of_light(pass, path.random))
        return;
    for (int i = 0; i < path.size(); ++i) {
        const BaseVertex& v = path[i];
        const Vertex& x = v.vertex;
        if ((i + 1 == path.size() && !v.escapes) || x.bsdf.roughness() < PathGuiding::least_roughness)
            continue;
        const Rgb beyond = (v.hit_brings + v.arriving) / (v.pdf_w * v.survival);
        if (!(luminance(beyond) > 0) || !is_finite(beyond))
            continue;
        const float irradiance = v.is_delta ? 0 : luminance(beyond) * std::abs(v.to_next.z);
        found.push_back(
            {x.position, x.frame.normal, x.to_world(v.to_next), irradiance, luminance(v.f_cos * beyond), v.pdf_w});
    }
}

namespace {
constexpr int cells_along = 4; // of the grid, of a pixel and of the lens, by which edges of lamps are looked for
}

int very_direct_looks(const Pass& pass) {
    if (!pass.settings.edge_rays)
        return 0;
    return pass.has_lens() ? cells_along * cells_along : cells_along;
}

void show_very_direct(const Pass& pass, int look, PixelRect block, const Tracer& tracer, RgbImage& picture) {
    const PixelRect inside = block.clipped(pass.size);
    const PixelRect area{inside.x0 - (inside.x0 == 0), inside.y0 - (inside.y0 == 0),
                         inside.x1 + (inside.x1 == pass.size.x), inside.y1 + (inside.y1 == pass.size.y)};
    constexpr int n = cells_along;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            const int row = pass.has_lens() ? look / n : look; // all parts, or those of a diagonal
            const glm::vec2 cell((x + 1 + look) % n, (y + 1 + row) % n);
            const glm::vec2 in_cell = (cell + 0.5f) / static_cast<float>(n);
            const Ray ray = pass.camera_ray(x, y, {in_cell, sample_disk(in_cell)});
            picture(x + 1, y + 1) = tracer.very_direct_along(ray);
        }
}

void take_first_looks(const Pass& pass, PixelRect block, Worker& worker, PixelLooks& looks) {
    for_each_square(block.clipped(pass.size), 1, [&](PixelRect p) {
        for (int more = looks.wanted(p.x0, p.y0); more > 0; --more)
            if (!looks.add(p.x0, p.y0, pass.look_at(worker.tracer, p.x0, p.y0, looks.count(p.x0, p.y0))))
                worker.counters.refuse({pass.index, p.y0, p.x0});
    });
}

void find_projections(const Pass& pass, PixelRect block, const Tracer& tracer, Film& film) {
    // [Fang 2024, 4] takes 150 directions and more, drawn anew for every pixel; here all have the same.
    constexpr int directions = 40;
    const PixelRect area = block.clipped(pass.size);
    const Basis basis = pass.settings.basis;
    Vertex seen;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            float s[most_parts] = {};
            for (int point = 0; point < projection_points; ++point)
                if (pass.look_at(tracer, x, y, point, seen))
                    project(seen, basis, directions, s);
            float squares = 0;
            for (float& number : s) {
                number /= projection_points; // those where nothing is seen scatter nothing
                squares += number * number;
            }
            // Where a pixel sees nothing, and where no light can be scattered, any numbers do but none at all.
            if (!std::isfinite(squares) || squares < 1e-6f)
                project_evenly(basis, s);
            film.set_projection(x, y, s);
        }
}

void add_sample(const Pass& pass, int x, int y, PixelSample sample, Worker& worker, Film& film) {
    if (film.has_lamp_edge(x, y))
        sample.very_direct = pass.very_direct(worker.tracer, x, y);
    for (int more = film.looks().wanted(x, y); more > 0; --more)
        film.add_look(x, y, pass.index, pass.look_at(worker.tracer, x, y, film.looks().count(x, y)),
                      worker.counters);
    film.add(x, y, pass.index, sample, worker.counters);
}

ReuseDecision decide_on_reuse(int k, const ReuseRoulette& roulette, Worker& worker) {
    const BasePath& path = *worker.set.paths[static_cast<std::size_t>(k)];
    ReuseDecision decision;
    if (is_black(worker.reuse.shared_light(path))) {
        ++worker.counters.dark_paths;
        return decision;
    }
    decision.survival = roulette.survival(path);
    if (path.random.draw(0, Draw::reuse_survival) < decision.survival)
        decision.scale = 1 / decision.survival;
    ++(decision.survives() ? worker.counters.reused_paths : worker.counters.skipped_paths);
    worker.set.count(decision, k);
    return decision;
}

void share_light(const Pass& pass, RouletteKind kind, Worker& worker) {
    share_light(pass, kind, worker, [](int, const ReuseDecision&) {});
}

} // namespace tessera
