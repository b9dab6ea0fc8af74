#include "render/method/inspection.h"

#include <algorithm>
#include <utility>

namespace tessera {

namespace {

InspectedVertex look_at(const BasePath& path, int i) {
    const BaseVertex& x = path[i];
    InspectedVertex v{x.vertex.position,
                      kind_name(x.vertex.bsdf),
                      x.vertex.bsdf.roughness(),
                      i + 1 < path.size() || x.escapes,
                      x.escapes,
                      glm::vec3(0),
                      x.is_delta,
                      x.pdf_w,
                      x.survival,
                      Rgb(0),
                      Rgb(0),
                      {}};
    for (const LightSample& light : path.lights(i)) {
        v.sampled += light.brings;
        if (!is_black(light.brings) && !light.light.is_at_infinity())
            v.light_points.push_back(light.light.position);
    }
    if (v.goes_on) {
        v.to_next = x.vertex.to_world(x.to_next);
        v.hit = x.hit_brings;
    }
    return v;
}

/// The sampling sets from which a pixel gets its values: the same as in the methods' render functions.
std::vector<std::vector<glm::ivec2>> sets_of(const Pass& pass, glm::ivec2 p) {
    SamplingSet set;
    std::vector<std::vector<glm::ivec2>> sets;
    const auto finish = [&] { sets.push_back(std::exchange(set.pixels, {})); };
    switch (pass.settings.method) {
    case Method::pt:
        set.add(p.x, p.y);
        break;
    case Method::gpt:
        if (p.x + 1 < pass.size.x) {
            set.add({p.x, p.y, p.x + 2, p.y + 1});
            finish();
        }
        if (p.y + 1 < pass.size.y)
            set.add({p.x, p.y, p.x + 1, p.y + 2});
        break;
    case Method::gpr:
        set.add(pass.grid.part_at(p).with_halo(pass.size));
        break;
    case Method::pr:
        if (pass.settings.pattern == Pattern::rooks) {
            std::vector<int> columns;
            const PixelRect tile = pass.grid.tile_at(p);
            pass.grid.shuffle_columns(tile, columns);
            pass.grid.for_each_rook(tile, columns, pass.grid.pattern_at(p, tile, columns),
                                    [&](int x, int y) { set.add(x, y); });
        } else {
            set.add(pass.grid.part_at(p));
        }
        break;
    }
    if (!set.pixels.empty())
        finish();
    return sets;
}

/// Looks on while the light of a set is shared out.
class Onlooker {
public:
    Onlooker(glm::ivec2 pixel, Worker& worker, InspectedSet& result) : worker_(worker), result_(result) {
        const auto& pixels = worker.set.pixels;
        k_ = static_cast<int>(std::find(pixels.begin(), pixels.end(), pixel) - pixels.begin());
        worker.reuse.record(&trace_);
    }
    ~Onlooker() { worker_.reuse.record(nullptr); }
    Onlooker(const Onlooker&) = delete;
    Onlooker& operator=(const Onlooker&) = delete;

    void operator()(int base, float scale) {
        result_.to_k.push_back(shift(base, k_, scale));
        if (base != k_)
            return;
        result_.scale = scale;
        for (int m = 0; m < worker_.set.size(); ++m)
            if (m != k_)
                result_.from_k.push_back(shift(base, m, scale));
    }

private:
    InspectedShift shift(int base, int m, float scale) const {
        const auto pixel = [&](int i) { return worker_.set.pixels[static_cast<std::size_t>(i)]; };
        const auto outcomes = worker_.reuse.outcomes();
        InspectedShift s{pixel(base), pixel(m), !outcomes.empty(), ShiftOutcome::ok, 0, 0, Rgb(0), {}, {}};
        const BasePath& path = *worker_.set.paths[static_cast<std::size_t>(base)];
        if (base == m && !path.empty())
            s.value = worker_.reuse.kept_light(path);
        if (!s.is_tried)
            return s;
        if (base != m)
            s.outcome = outcomes[static_cast<std::size_t>(m)];
        add_light_paths(base, m, scale, s);
        if (base != m)
            add_vertices(path, m, s);
        return s;
    }

    void add_light_paths(int base, int m, float scale, InspectedShift& s) const {
        const LightPaths& light = worker_.reuse.light_paths();
        const OffsetPaths& offsets = worker_.reuse.offset_paths();
        float most = -1;
        for (int slot = light.first_shared(); slot <= light.last_alive(); ++slot) {
            if (!light.is_alive(slot))
                continue;
            const float weight = worker_.reuse.weight(slot, scale);
            const Rgb value = weight * (base == m ? light.carried(slot) : offsets.value(slot, m));
            s.value += value;
            if (luminance(value) <= most)
                continue;
            most = luminance(value);
            s.weight = weight;
            s.ratio = base == m ? 1 : offsets.density(slot, m);
        }
    }

    void add_vertices(const BasePath& path, int m, InspectedShift& s) const {
        const BasePath& own = *worker_.set.paths[static_cast<std::size_t>(m)];
        if (own.empty())
            return;
        s.offset.push_back(own[0].vertex.position);
        for (glm::vec3 y : trace_.vertices[static_cast<std::size_t>(m)])
            s.offset.push_back(y);
        const int join = worker_.reuse.light_paths().join();
        if (join == 0 || static_cast<int>(s.offset.size()) < join)
            return;
        for (int i = join; i < path.size(); ++i)
            s.beyond.push_back(path[i].vertex.position);
    }

    Worker& worker_;
    InspectedSet& result_;
    OffsetTrace trace_;
    int k_;
};

InspectedSet look_at(const Pass& pass, const std::vector<glm::ivec2>& pixels, glm::ivec2 pixel, Worker& worker) {
    PixelRect around{pixel.x, pixel.y, pixel.x + 1, pixel.y + 1};
    for (glm::ivec2 p : pixels)
        around = {std::min(around.x0, p.x), std::min(around.y0, p.y), std::max(around.x1, p.x + 1),
                  std::max(around.y1, p.y + 1)};
    worker.base.trace(pass, worker.tracer, around);
    worker.set.pixels = pixels;
    InspectedSet result{pixels, 0, {}, {}, Rgb(0)};
    Onlooker onlooker(pixel, worker, result);
    const RouletteKind kind =
        reuses_paths(pass.settings.method) ? pass.settings.roulette : RouletteKind::none; // as in the methods
    share_light(pass, kind, worker, onlooker);
    for (const InspectedShift& s : result.to_k)
        result.radiance += s.value;
    return result;
}

} // namespace

Inspection inspect(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
                   const ReusePlan& plan, int index, glm::ivec2 pixel) {
    const Pass pass(scene, camera, size, settings, plan, index);
    Worker worker(scene, settings);
    Inspection result{pixel, size, index, settings.method, {}, Rgb(0), Rgb(0), false, {}};
    // Not by trace_pixel(), which empties a path that is to be refused.
    trace_base_path(worker.tracer, pass.camera_ray(pixel.x, pixel.y), pass.random(pixel.x, pixel.y), worker.path);
    for (int i = 0; i < worker.path.size(); ++i)
        result.path.push_back(look_at(worker.path, i));
    result.radiance = worker.path.radiance();
    result.very_direct = worker.path.very_direct;
    result.is_refused = !is_finite(result.radiance + result.very_direct);
    for (const std::vector<glm::ivec2>& pixels : sets_of(pass, pixel))
        result.sets.push_back(look_at(pass, pixels, pixel, worker));
    return result;
}

} // namespace tessera
