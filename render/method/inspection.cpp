#include "render/method/inspection.h"

#include "render/method/onlooker.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace tessera {

namespace {

/// A sampling set before anything is traced.
struct PlannedSet {
    std::vector<glm::ivec2> pixels;
    std::vector<char> is_border;

    void add(int x, int y, bool border = false) {
        pixels.emplace_back(x, y);
        is_border.push_back(border);
    }
    void add(PixelRect rect, PixelRect inner) {
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x)
                add(x, y, !inner.contains({x, y}));
    }
    /// Whether the pixel gets its light here.
    bool serves(glm::ivec2 pixel) const {
        const auto found = std::find(pixels.begin(), pixels.end(), pixel);
        return found != pixels.end() && !is_border[static_cast<std::size_t>(found - pixels.begin())];
    }
};

/// The pattern sets of a tile.
void add_rooks(const Pass& pass, PixelRect tile, std::vector<PlannedSet>& sets) {
    std::vector<int> columns;
    pass.grid.shuffle_columns(tile, columns);
    for (int pattern = 0; pattern < tile.width(); ++pattern) {
        PlannedSet set;
        pass.grid.for_each_rook(tile, columns, pattern, [&](int x, int y) { set.add(x, y); });
        if (!set.pixels.empty())
            sets.push_back(std::move(set));
    }
}

/// The sampling sets of a pixel's tile, in the methods' render functions' order; of PT and G-PT those of the
/// pixel.
std::vector<PlannedSet> sets_of_tile(const Pass& pass, glm::ivec2 p) {
    std::vector<PlannedSet> sets;
    const auto add = [&](PixelRect all, PixelRect inner) { sets.emplace_back().add(all, inner); };
    const PixelRect pixel{p.x, p.y, p.x + 1, p.y + 1}, tile = pass.grid.tile_at(p);
    switch (pass.settings.method) {
    case Method::pt:
        add(pixel, pixel);
        break;
    case Method::gpt:
        if (p.x + 1 < pass.size.x)
            add({p.x, p.y, p.x + 2, p.y + 1}, pixel);
        if (p.y + 1 < pass.size.y)
            add({p.x, p.y, p.x + 1, p.y + 2}, pixel);
        break;
    case Method::gpr:
        pass.grid.for_each_part(tile, [&](PixelRect part) { add(part.with_halo(pass.size), part); });
        break;
    case Method::pr:
        if (pass.settings.pattern == Pattern::rooks)
            add_rooks(pass, tile, sets);
        else
            pass.grid.for_each_part(tile, [&](PixelRect part) { add(part, part); });
        break;
    }
    return sets;
}

InspectedSet look_at(const Pass& pass, const PlannedSet& set, std::optional<glm::ivec2> pixel, Worker& worker) {
    PixelRect around{set.pixels[0].x, set.pixels[0].y, set.pixels[0].x + 1, set.pixels[0].y + 1};
    for (glm::ivec2 p : set.pixels)
        around = {std::min(around.x0, p.x), std::min(around.y0, p.y), std::max(around.x1, p.x + 1),
                  std::max(around.y1, p.y + 1)};
    worker.base.trace(pass, worker.tracer, around);
    worker.set.pixels = set.pixels;
    InspectedSet result{set.pixels, set.is_border, {}, {}};
    Onlooker onlooker(worker, pixel ? result.index_of(*pixel) : -1, result);
    const RouletteKind kind =
        reuses_paths(pass.settings.method) ? pass.settings.roulette : RouletteKind::none; // as in the methods
    share_light(pass, kind, worker, onlooker);
    return result;
}

} // namespace

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
                   const ReusePlan& plan, int index, glm::ivec2 pixel) {
    const Pass pass(scene, camera, size, settings, plan, index);
    Worker worker(scene, settings);
    Inspection result{pixel, size, index, settings.method, {}, Rgb(0), Rgb(0), false, {}};
    // Not by trace_pixel(), which empties a path that is to be refused.
    trace_base_path(worker.tracer, pass.camera_ray(pixel.x, pixel.y), pass.random(pixel.x, pixel.y), worker.path);
    result.path = look_at(worker.path);
    result.radiance = worker.path.radiance();
    result.very_direct = worker.path.very_direct;
    result.is_refused = !is_finite(result.radiance + result.very_direct);
    for (const PlannedSet& set : sets_of_tile(pass, pixel))
        if (set.serves(pixel))
            result.sets.push_back(look_at(pass, set, pixel, worker));
    return result;
}

TileInspection inspect_tile(const Scene& scene, const Camera& camera, glm::ivec2 size,
                            const RenderSettings& settings, const ReusePlan& plan, int index, glm::ivec2 pixel) {
    const Pass pass(scene, camera, size, settings, plan, index);
    Worker worker(scene, settings);
    const PixelRect tile = reuses_paths(settings.method) ? pass.grid.tile_at(pixel)
                                                         : PixelRect{pixel.x, pixel.y, pixel.x + 1, pixel.y + 1};
    TileInspection result{tile, index, settings, {}};
    for (const PlannedSet& set : sets_of_tile(pass, pixel))
        result.sets.push_back(look_at(pass, set, {}, worker));
    return result;
}

} // namespace tessera
