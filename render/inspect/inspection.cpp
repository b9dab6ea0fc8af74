#include "render/inspect/inspection.h"

#include "render/estimator/guiding_learner.h"
#include "render/estimator/method_sets.h"
#include "render/estimator/pass.h"
#include "render/estimator/pilot.h"
#include "render/estimator/pre_pass.h"
#include "render/estimator/set_reuse.h"
#include "render/inspect/observer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <set>

namespace tessera {

namespace {

PixelRect bounds(const std::vector<glm::ivec2>& pixels) {
    PixelRect around{pixels[0].x, pixels[0].y, pixels[0].x + 1, pixels[0].y + 1};
    for (glm::ivec2 p : pixels)
        around = {std::min(around.x0, p.x), std::min(around.y0, p.y), std::max(around.x1, p.x + 1),
                  std::max(around.y1, p.y + 1)};
    return around;
}

/// Reuses the base paths of worker.set, and records it; step by step for the shifts of `pixel`.
InspectedSet inspect_set(const Pass& pass, PixelRect inner, std::optional<glm::ivec2> pixel, Worker& worker) {
    InspectedSet result{worker.set.pixels, {}, {}, {}, {}};
    for (glm::ivec2 p : result.pixels)
        result.is_border.push_back(!inner.contains(p));
    worker.base.trace(pass, worker.tracer, bounds(result.pixels), {inner.x0, inner.y0}, worker.set.number);
    Observer observer(worker, static_cast<float>(pass.index) + 1, pixel ? result.index_of(*pixel) : -1, result);
    const bool is_alone = reuses_paths(pass.settings.method) && pass.grid.paths_alone_at(result.pixels[0]) > 0;
    SamplingSet& set = worker.set;
    set.positions = is_alone ? 1 : pass.positions_of(set.pixels);
    result.coefficient.resize(result.pixels.size());
    for (set.position = 0; set.position < set.positions; ++set.position) {
        if (set.positions > 1)
            worker.base.see_from(pass, worker.tracer, set.position);
        reuse_paths(pass, is_alone ? RouletteKind::none : roulette_of(pass.settings), worker, observer);
        for (int m = 0; m < set.size(); ++m)
            result.coefficient[m] += set.coefficient(m);
    }
    return result;
}

/// Returns whether the film rejects a pixel's sample: its coefficient, or that of a neighbour in a gradient, is
/// not finite.
bool is_invalid(const InspectedSet& set, glm::ivec2 pixel, const RenderSettings& settings) {
    const auto is_bad = [&](glm::ivec2 p) {
        const int m = set.index_of(p);
        return m >= 0 && !is_finite(set.coefficient[m]);
    };
    return is_bad(pixel) || (has_gradients(settings.method) &&
                             (is_bad(pixel + glm::ivec2(1, 0)) || is_bad(pixel + glm::ivec2(0, 1))));
}

/// Returns the same for a pixel without reuse, theory (21): checks all its paths and those of its neighbours.
bool is_mean_refused(const Pass& pass, glm::ivec2 pixel, Worker& worker) {
    for (const glm::ivec2 p : {pixel, pixel + glm::ivec2(1, 0), pixel + glm::ivec2(0, 1)}) {
        if (p.x >= pass.size.x || p.y >= pass.size.y)
            continue;
        const int alone = pass.grid.block_at(p) == pass.grid.block_at(pixel) ? pass.grid.paths_alone_at(p) : 0;
        const int paths = std::max(alone, 1);
        for (int number = 0; number < paths; ++number) {
            trace_pixel(pass, worker.tracer, p.x, p.y, pass.base_sample(p, pixel, number), worker.path, number);
            if (!is_finite(coefficient(worker.path.radiance(), pass.albedo_of(worker.path))))
                return true;
        }
    }
    return false;
}

/// Returns the directly visible emission of a sample whose base path is worker.path.
Rgb very_direct_of(const Pass& pass, glm::ivec2 pixel, bool is_alone, int number, Worker& worker) {
    if (is_alone || !pass.is_mixed(pixel))
        return worker.path.very_direct;
    Rgb sum = worker.path.very_direct;
    BasePath seen;
    for (int position = 0; position < camera_positions(pass.settings); ++position) {
        if (position == pass.turn(pixel))
            continue;
        const Ray ray = pass.camera_ray(pixel.x, pixel.y, pass.sample_at(position, pixel, number));
        trace_first_vertex(worker.tracer, ray, pass.pixel_width(), worker.path.random, seen);
        sum += seen.very_direct;
    }
    return sum / static_cast<float>(camera_positions(pass.settings));
}

/// @param d  derivatives of vertex i of the path
void add_light_footprint(const Worker& worker, int i, const PathDerivatives& d, const DeltaRule& rule,
                         InspectedVertex& x) {
    if (x.light && worker.path.light(i).light.has_area())
        x.light->footprint = footprint(differentiate_light(worker.tracer, worker.path, i, d), rule);
}

/// Adds the footprints of the path's vertices and light samples.
void add_footprints(const Pass& pass, glm::ivec2 pixel, const CameraSample& from, const Worker& worker,
                    std::span<const Hit> hits, std::vector<InspectedVertex>& path) {
    const glm::vec2 at = glm::vec2(pixel) + from.subpixel;
    const Projection projection = pass.projection();
    const float samples = static_cast<float>(pass.index) + 1;
    const DeltaRule rule{samples, true, DeltaRule::published_change};
    std::vector<float> widths;
    scalar_footprints(worker.path, projection.pixel_width(), projection.ray(at, from.lens).origin,
                      std::log2(samples), widths);
    Differentiation along;
    differentiate(pass.scene, projection, at, from.lens, worker.path, hits, along,
                  [&](int i, const PathDerivatives& d) {
                      InspectedVertex& x = path[i];
                      x.footprint = footprint(d, rule);
                      x.footprint_width = widths[i];
                      add_light_footprint(worker, i, d, rule, x);
                  });
}

} // namespace

Rgb Inspection::shared_radiance() const {
    if (sets.empty())
        return radiance;
    Rgb sum(0);
    float pixels = 0;
    for (const InspectedSet& set : sets) {
        sum += set.radiance(pixel) * static_cast<float>(set.size());
        pixels += static_cast<float>(set.size());
    }
    return sum / pixels;
}

int InspectedSet::index_of(glm::ivec2 pixel) const {
    const auto found = std::find(pixels.begin(), pixels.end(), pixel);
    return found == pixels.end() ? -1 : static_cast<int>(found - pixels.begin());
}

Rgb InspectedSet::radiance(int m, int count) const {
    Rgb sum(0);
    for (int k = 0; k < count; ++k)
        sum += shift(k, m).value;
    return sum;
}

std::vector<const InspectedShift*> InspectedSet::to(glm::ivec2 pixel) const {
    std::vector<const InspectedShift*> result;
    for (int k = 0; k < size(); ++k)
        result.push_back(&shift(k, index_of(pixel)));
    return result;
}

std::vector<const InspectedShift*> InspectedSet::from(glm::ivec2 pixel) const {
    std::vector<const InspectedShift*> result;
    const int k = index_of(pixel);
    for (int m = 0; m < size(); ++m)
        if (m != k)
            result.push_back(&shift(k, m));
    return result;
}

int TileInspection::base_count() const {
    int count = 0;
    for (const InspectedSet& set : sets)
        count += set.size();
    return count;
}

Inspection inspect(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
                   const LearnedReuse& learned, int index, glm::ivec2 pixel) {
    const Pass pass(scene, camera, size, settings, learned, index);
    Worker worker(scene, camera, size, settings, learned.guiding());
    const CameraSample from = pass.base_sample(pixel);
    Inspection result{pixel, size, index, settings.method, from.lens, {}, Rgb(0), Rgb(0), false, {}};
    const int paths_without_reuse = reuses_paths(settings.method) ? pass.grid.paths_alone_at(pixel) : 0;
    const int paths = std::max(paths_without_reuse, 1);
    std::vector<Hit> hits;
    for (int number = 0; number < paths; ++number) {
        // trace_pixel() would empty an invalid path.
        const Ray ray = pass.camera_ray(pixel.x, pixel.y, pass.base_sample(pixel, number));
        worker.tracer.hits = number == 0 ? &hits : nullptr;
        trace_base_path(worker.tracer, ray, pass.pixel_width(), pass.random(pixel.x, pixel.y, number),
                        worker.path);
        if (number == 0) {
            result.path = inspect_path(worker.path);
            add_footprints(pass, pixel, from, worker, hits, result.path);
            result.radiance = worker.path.radiance();
        }
        worker.tracer.hits = nullptr;
        const Rgb very_direct = very_direct_of(pass, pixel, paths_without_reuse > 0, number, worker);
        result.very_direct += very_direct / static_cast<float>(paths);
        result.is_invalid = result.is_invalid || !is_finite(worker.path.radiance() + very_direct);
    }
    for_each_set_with(pass, pixel, worker.set,
                      [&](PixelRect inner) { result.sets.push_back(inspect_set(pass, inner, pixel, worker)); });
    if (paths_without_reuse > 0)
        result.is_invalid = result.is_invalid || is_mean_refused(pass, pixel, worker);
    for (const InspectedSet& set : result.sets)
        result.is_invalid = result.is_invalid || is_invalid(set, pixel, settings);
    return result;
}

TileInspection inspect_tile(const Scene& scene, const Camera& camera, glm::ivec2 size,
                            const RenderSettings& settings, const LearnedReuse& learned, int index,
                            glm::ivec2 pixel) {
    const Pass pass(scene, camera, size, settings, learned, index);
    Worker worker(scene, camera, size, settings, learned.guiding());
    const PixelRect tile = reuses_paths(settings.method) ? pass.grid.tile_at(pixel)
                                                         : PixelRect{pixel.x, pixel.y, pixel.x + 1, pixel.y + 1};
    TileInspection result{tile, index, settings, {}};
    for_each_set_of_tile(pass, pixel, worker.set,
                         [&](PixelRect inner) { result.sets.push_back(inspect_set(pass, inner, {}, worker)); });
    return result;
}

namespace {

/// Learns from the base paths of a pass in a rectangle.
void learn_luminance(const Pass& pass, PixelRect rect, Worker& worker, LearnedReuse& learned) {
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x) {
            trace_pixel(pass, worker.tracer, x, y, pass.base_sample({x, y}), worker.path);
            learned.learn(x, y, worker.reuse.arriving_luminance(worker.path));
        }
}

/// Returns the light that the guiding paths of a pass find, by blocks.
std::vector<std::vector<FoundLight>> light_found_in(const Pass& pass, Worker& worker,
                                                    const std::stop_token& stop) {
    std::vector<std::vector<FoundLight>> found;
    for (const PixelRect& block : blocks_of(pass)) {
        found.emplace_back();
        if (stop.stop_requested())
            continue;
        for_each_square(block.clipped(pass.size), 1, [&](PixelRect p) {
            if (!is_guiding_path(pass, pass.random(p.x0, p.y0)))
                return;
            trace_pixel(pass, worker.tracer, p.x0, p.y0, pass.base_sample({p.x0, p.y0}), worker.path);
            record_light(pass, worker.path, found.back());
        });
    }
    return found;
}

/// Finds the mixed pixels of some rectangles, as a render does before its first pass.
std::shared_ptr<const Image<std::uint8_t>> mixed_pixels(const Pass& pass, std::span<const PixelRect> rects,
                                                        Worker& worker, const std::stop_token& stop) {
    PixelFeatures features(pass.size.x, pass.size.y, is_demodulated(pass.settings));
    for (const PixelRect& rect : rects) // with the pixels around, which PixelFeatures::mixed() compares
        if (!stop.stop_requested())
            take_feature_samples(pass,
                                 {std::max(rect.x0 - 1, 0), std::max(rect.y0 - 1, 0), rect.x1 + 1, rect.y1 + 1},
                                 worker, features);
    return std::make_shared<const Image<std::uint8_t>>(features.mixed());
}

} // namespace

LearnedReuse replay_learning(const Scene& scene, const Camera& camera, glm::ivec2 size,
                             const RenderSettings& settings, int pass, glm::ivec2 pixel, std::stop_token stop) {
    LearnedReuse learned(size, settings);
    const bool splits = settings.adapt_tile && can_split_tiles(settings) && settings.tile > 1;
    if (learned.wants_pilot()) {
        Worker worker(scene, camera, size, settings, nullptr);
        const Pilot pilot(scene, camera, size, settings, learned);
        std::vector<CellStatistics> found;
        for (int i = 0; i < learned.cell_count() && !stop.stop_requested(); ++i)
            found.push_back(pilot.explore(learned.cell(i), worker));
        learned.learn(found);
    }
    const TileGrid grid(size, settings, learned, pass);
    std::set<int> cells; // of all tiles whose sampling sets can contain the pixel
    for (const glm::ivec2 beside : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)}) {
        const PixelRect tile = grid.tile_at(pixel - beside);
        for (const int x : {tile.x0, tile.x1 - 1})
            for (const int y : {tile.y0, tile.y1 - 1})
                if (splits)
                    cells.insert(learned.cell_of({x, y, x + 1, y + 1}));
    }
    const bool guides = settings.path_guiding != Guiding::off;
    if (has_positions(settings)) {
        std::vector<PixelRect> rects{grid.block_at(pixel).with_halo(size)};
        for (const int cell : cells)
            rects.push_back(learned.cell(cell));
        if (guides) // guiding paths lie in the whole picture
            rects = {{0, 0, size.x, size.y}};
        Worker worker(scene, camera, size, settings, nullptr);
        learned.set_mixed(mixed_pixels({scene, camera, size, settings, learned, 0}, rects, worker, stop));
    }
    // A pass uses the state that the render had after the last power of two of passes (Render::learn_from_pass).
    LearnedReuse next = learned;
    GuidingLearner guiding;
    const int learned_passes = static_cast<int>(std::bit_floor(static_cast<unsigned>(pass)));
    for (int i = splits || guides ? 0 : learned_passes; i < learned_passes && !stop.stop_requested(); ++i) {
        Worker worker(scene, camera, size, settings, learned.guiding());
        const Pass replayed(scene, camera, size, settings, learned, i);
        if (guides)
            guiding.learn(light_found_in(replayed, worker, stop));
        for (const int cell : cells)
            learn_luminance(replayed, next.cell(cell), worker, next);
        if (std::has_single_bit(static_cast<unsigned>(i + 1))) {
            next.set_guiding(guiding.make_guiding(settings.path_guiding));
            learned.take(next, i + 1);
        }
    }
    learned.take(next, learned_passes); // sets first_pass() even if nothing was replayed
    return learned;
}

} // namespace tessera
