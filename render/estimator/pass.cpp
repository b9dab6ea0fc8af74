#include "render/estimator/pass.h"

#include "render/estimator/guiding_learner.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace tessera {

void SamplingSet::assign(PixelRect rect) {
    clear();
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x)
            add(x, y);
}

void SamplingSet::collect(const Pass& pass, const BaseBlock& base) {
    paths.clear();
    albedo.clear();
    for (glm::ivec2 p : pixels) {
        paths.push_back(&base.at(p.x, p.y));
        albedo.push_back(pass.albedo_of(*paths.back()));
    }
    radiance.assign(pixels.size(), Rgb(0));
    reuse.assign(pixels.size(), {});
    arriving.reset(is_expanded(pass.settings) ? pass.settings.basis : Basis::none, albedo);
}

void SamplingSet::expand(const Film& film) {
    parts.resize(static_cast<std::size_t>(size() * arriving.parts()));
    for (int i = 0; arriving.is_kept() && i < size(); ++i) {
        const glm::ivec2 p = pixels[static_cast<std::size_t>(i)];
        arriving.expand(i, coefficient(i), film.projection(p.x, p.y), parts.data() + i * arriving.parts());
    }
}

void SamplingSet::count(std::span<const ShiftOutcome> outcomes, int k) {
    for (std::size_t m = 0; m < outcomes.size(); ++m)
        if (m != static_cast<std::size_t>(k))
            ++reuse[m].shifts[static_cast<std::size_t>(outcomes[m])];
}

void SamplingSet::count(const ReuseDecision& decision, int k) {
    ReuseCounts& counts = reuse[static_cast<std::size_t>(k)];
    if (!decision.is_dark())
        ++(decision.survives() ? counts.reused : counts.skipped);
}

PixelSample SamplingSet::sample(int i, const PathReuse& estimator) const {
    const auto m = static_cast<std::size_t>(i);
    const BasePath& path = *paths[m];
    return {
        coefficient(i), Rgb(0), Rgb(0), path.very_direct, albedo[m], reuse[m], estimator.arriving_luminance(path)};
}

std::uint64_t Worker::bytes(const RenderSettings& settings) {
    constexpr int long_path = 16; // vertices: memory is for 2^n of them, and some of a block's paths are as long
    const auto edge = static_cast<std::uint64_t>(block_edge_of(settings) + 1); // with one more column and row
    const std::uint64_t paths = settings.method == Method::pt ? 1 : edge * edge;
    const auto vertices = static_cast<std::uint64_t>(std::min(settings.max_depth, long_path));
    const std::uint64_t a_vertex =
        sizeof(BaseVertex) + static_cast<std::uint64_t>(settings.light_samples) * sizeof(LightSample);
    const std::size_t means = (finds_gain_of_sharing(settings) ? sizeof(MeanOfPaths) : 0) +
                              (is_adaptive(settings) ? sizeof(PixelSample) : 0) +
                              (has_gradients(settings.method) ? SetMeans::bytes(part_count(settings)) : 0);
    return sizeof(Worker) + paths * (sizeof(BasePath) + means + vertices * a_vertex);
}

namespace {
float telling_share_of(glm::ivec2 size, const RenderSettings& settings, const PathGuiding* guiding, int index) {
    if (settings.path_guiding == Guiding::off)
        return 0;
    return GuidingLearner::share_of_paths(size.x * size.y, index, guiding && guiding->draws());
}

/// Nets begin with the first pass that goes by its plan, and with powers of two, whether or not anything is learnt
/// then. The position of a path asks for neither plan nor guides; but of samples whose number is learnt, each has
/// a position of its own.
PassNumbers::Begins begins_of_nets(const RenderSettings& settings, const ReusePlan& plan, int pass) {
    const int begin = std::max(plan.first_pass(), static_cast<int>(std::bit_floor(static_cast<unsigned>(pass))));
    return {is_adaptive(settings) ? begin : 0, begin};
}
} // namespace

Pass::Pass(const Scene& scene_, const Camera& camera, glm::ivec2 size_, const RenderSettings& settings_,
           const ReusePlan& plan, int index_)
    : scene(scene_), settings(settings_), size(size_), index(index_), grid(size_, settings_, plan, index_),
      telling_share(telling_share_of(size_, settings_, plan.guiding(), index_)), projection_(camera, size_),
      has_lens_(camera.aperture_radius > 0),
      numbers_(settings_.seed, index_, begins_of_nets(settings_, plan, index_)) {}

/// Blocks are moved with the grid of tiles. Those of a square begin at one place, so that few pixels change from
/// one sequence to another, and see only parts of both.
std::uint32_t Pass::place_of(glm::ivec2 pixel) const {
    constexpr int blocks = 8;
    const glm::ivec2 at = settings.method == Method::pt ? pixel : grid.block_of(pixel) / blocks;
    return static_cast<std::uint32_t>(at.y * size.x + at.x);
}

CameraSample Pass::camera_sample(glm::ivec2 pixel, int path) const {
    const std::uint32_t place = place_of(pixel);
    return {numbers_.subpixel(place, path), has_lens_ ? sample_disk(numbers_.lens(place, path)) : glm::vec2(0)};
}

Rgb Pass::very_direct(const Tracer& tracer, int x, int y) const {
    const int n = settings.very_direct_grid;
    const auto cells = static_cast<float>(n);
    const glm::vec2 in_cell = numbers_.subpixel(place_of({x, y}), 0), on_lens = numbers_.lens(place_of({x, y}), 0);
    Rgb sum(0);
    for (int i = 0; i < n * n; ++i) {
        // A row of cells of the pixel goes with a column of the lens; rotated by the block's own position, each
        // cell sees all of the lens over the passes.
        const glm::vec2 subpixel = (glm::vec2(i % n, i / n) + in_cell) / cells;
        const glm::vec2 lens = sample_disk(glm::fract(on_lens + glm::vec2(i / n, i % n) / cells));
        sum += tracer.very_direct_along(camera_ray(x, y, {subpixel, lens}));
    }
    return sum / static_cast<float>(n * n);
}

namespace {

// Keys of nets, over the looks of a pixel.
constexpr std::uint64_t looks_in_pixel = 0x6c6f'6f6b'7069'786cu, looks_on_lens = 0x6c6f'6f6b'6c65'6e73u;

} // namespace

/// @param subpixel, lens  digits that points are shifted by
CameraSample Pass::look_from(std::uint64_t subpixel, std::uint64_t lens, int point) const {
    const auto at = [&](std::uint64_t shift, std::uint64_t net) {
        return unit_square(shift ^ net_point(static_cast<std::uint32_t>(point), net));
    };
    return {at(subpixel, looks_in_pixel), has_lens_ ? sample_disk(at(lens, looks_on_lens)) : glm::vec2(0)};
}

Look Pass::look_at(const Tracer& tracer, int x, int y, int point) const {
    const Random shift(settings.seed, static_cast<std::uint32_t>(y * size.x + x), 0xffffffffu); // no pass's
    const CameraSample sample =
        look_from(shift.digits(0, Draw::direction), shift.digits(1, Draw::direction), point);
    const Random numbers(settings.seed, static_cast<std::uint32_t>(y * size.x + x),
                         0xfffffffcu - static_cast<std::uint32_t>(point)); // no pass's either
    return look_along(tracer, camera_ray(x, y, sample), numbers);
}

bool Pass::look_at(const Tracer& tracer, int x, int y, int point, Vertex& seen) const {
    constexpr std::uint64_t middle = 0x8000'0000'8000'0000u; // where the first look is
    const CameraSample sample =
        look_from(middle ^ net_point(0, looks_in_pixel), middle ^ net_point(0, looks_on_lens), point);
    return tracer.closest(camera_ray(x, y, sample), seen, RayKind::camera);
}

void BaseBlock::trace(const Pass& pass, const Tracer& tracer, PixelRect rect, glm::ivec2 inside, int number) {
    const CameraSample from = pass.camera_sample(inside, number);
    rect_ = rect;
    const auto count = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
    if (paths_.size() < count)
        paths_.resize(count);
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x)
            trace_pixel(pass, tracer, x, y, from, paths_[index(x, y)], number);
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
    very_direct += path.very_direct * share;
}

void trace_pixel(const Pass& pass, const Tracer& tracer, int x, int y, const CameraSample& from, BasePath& path,
                 int number) {
    trace_base_path(tracer, pass.camera_ray(x, y, from), pass.pixel_width(), pass.random(x, y, number), path);
    if (is_finite(path.radiance() + path.very_direct))
        return;
    tracer.counters.refuse({pass.index, y, x});
    path.reset(path.random, path.light_samples());
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

int very_direct_looks(const Pass& pass) {
    const int n = pass.settings.very_direct_grid;
    return n == 1 ? 0 : pass.has_lens() ? n * n : 1;
}

void show_very_direct(const Pass& pass, int look, PixelRect block, const Tracer& tracer, RgbImage& picture) {
    const PixelRect inside = block.clipped(pass.size);
    const PixelRect area{inside.x0 - (inside.x0 == 0), inside.y0 - (inside.y0 == 0),
                         inside.x1 + (inside.x1 == pass.size.x), inside.y1 + (inside.y1 == pass.size.y)};
    const int n = pass.settings.very_direct_grid;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            const glm::vec2 cell((x + 1 + look) % n, (y + 1 + look / n) % n);
            const glm::vec2 lens = sample_disk((cell + 0.5f) / static_cast<float>(n));
            picture(x + 1, y + 1) = tracer.very_direct_along(pass.camera_ray(x, y, {glm::vec2(0.5f), lens}));
        }
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

void SampleMeans::begin(PixelRect area, int samples) {
    area_ = area;
    samples_ = samples;
    const auto pixels = static_cast<std::size_t>(area.width()) * static_cast<std::size_t>(area.height());
    means_.assign(samples > 1 ? pixels : 0,
                  {Rgb(0), Rgb(0), Rgb(0), Rgb(0), Rgb(0), {}, -1, {}, {}, {}, Rgb(0), 0});
}

void SampleMeans::add(int x, int y, const PixelSample& sample) {
    PixelSample& mean = means_[index(x, y)];
    const float share = 1 / static_cast<float>(samples_);
    const Rgb radiance =
        mean.primal * mean.albedo + mean.beside + (sample.primal * sample.albedo + sample.beside) * share;
    mean.primal += sample.primal * share;
    mean.dx += sample.dx * share;
    mean.dy += sample.dy * share;
    mean.very_direct += sample.very_direct * share;
    mean.albedo += sample.albedo * share;
    mean.own += sample.own * share;
    mean.beside = radiance - mean.primal * mean.albedo;
    mean.reuse += sample.reuse;
    mean.luminance = mean.paths == 0 ? sample.luminance : mean.luminance;
    mean.paths += sample.paths;
}

void SetMeans::begin(PixelRect area, int parts) {
    area_ = area;
    part_count_ = static_cast<std::size_t>(parts);
    const auto pixels = static_cast<std::size_t>(area.width()) * static_cast<std::size_t>(area.height());
    pixels_.assign(pixels, {});
    for (std::vector<Rgb>* sums : {&parts_, &parts_dx_, &parts_dy_})
        sums->assign(pixels * part_count_, Rgb(0));
}

void SetMeans::add(const SamplingSet& set, PixelRect all) {
    for (int i = 0; i < set.size(); ++i) {
        const glm::ivec2 p = set.pixels[static_cast<std::size_t>(i)];
        if (!area_.contains(p))
            continue;
        const std::size_t at = index(p.x, p.y);
        Pixel& pixel = pixels_[at];
        pixel.reuse += set.reuse[static_cast<std::size_t>(i)];
        add(set, {}, i, pixel.primal, parts_at(parts_, at));
        if (p.x + 1 < all.x1)
            add(set, i, i + 1, pixel.dx, parts_at(parts_dx_, at));
        if (p.y + 1 < all.y1)
            add(set, i, i + all.width(), pixel.dy, parts_at(parts_dy_, at));
    }
}

/// Running means: sums of what is as bright as numbers go would be beyond them.
void SetMeans::add(const SamplingSet& set, std::optional<int> from, int to, Mean& mean, std::span<Rgb> parts) {
    const auto pixels = static_cast<float>(set.size());
    mean.pixels += pixels;
    const float share = pixels / mean.pixels;
    const auto move = [share](Rgb& value, Rgb here, Rgb there) {
        value = value * (1 - share) + (there - here) * share;
    };
    move(mean.value, from ? set.coefficient(*from) : Rgb(0), set.coefficient(to));
    for (std::size_t l = 0; l < parts.size(); ++l)
        move(parts[l], from ? set.parts_of(*from)[l] : Rgb(0), set.parts_of(to)[l]);
}

void SetMeans::take_primal(int x, int y, PixelSample& sample) const {
    const std::size_t at = index(x, y);
    sample.primal = pixels_[at].primal.value;
    sample.parts = parts_at(parts_, at);
}

void SetMeans::take_gradients(int x, int y, PixelSample& sample) const {
    const std::size_t at = index(x, y);
    const Pixel& pixel = pixels_[at];
    sample.dx = pixel.dx.value;
    sample.dy = pixel.dy.value;
    sample.parts_dx = parts_at(parts_dx_, at);
    sample.parts_dy = parts_at(parts_dy_, at);
}

void add_sample(const Pass& pass, int x, int y, PixelSample sample, Worker& worker, Film& film) {
    if (worker.samples > 1)
        return worker.means.add(x, y, sample);
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
