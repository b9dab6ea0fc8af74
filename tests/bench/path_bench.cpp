// path_bench [SCENE...]: measures rates per CPU second on one thread: base paths, the bare rays in them (Embree's
// part of the cost), shifts by kind, and path reuse in whole tiles. SCENE names ../shared/scenes/SCENE/scene.xml
// or assets/SCENE.xml. Google Benchmark's own options are accepted, too.

#include "render/estimator/base_block.h"
#include "render/estimator/method_sets.h"
#include "render/estimator/methods.h"
#include "render/estimator/pass.h"
#include "render/estimator/set_reuse.h"
#include "render/estimator/worker.h"
#include "render/load/mitsuba_xml.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include <benchmark/benchmark.h>
#include <glm/vec2.hpp>

namespace {

using namespace tessera;

constexpr glm::ivec2 image_size(640, 360);
constexpr int max_depth = 8;
constexpr int gpr_border = 1; // pixels by which a G-PR sampling set exceeds its tile on the right and below

/// Returns the file of a scene; empty if there is none.
std::filesystem::path file_of(const std::string& name) {
    for (const std::filesystem::path& file :
         {std::filesystem::path(TESSERA_SHARED_DIR) / "scenes" / name / "scene.xml",
          std::filesystem::path(TESSERA_SOURCE_DIR) / "assets" / (name + ".xml")})
        if (std::filesystem::exists(file))
            return file;
    return {};
}

/// Returns a scene, loaded by the first call that names it; null if there is no such scene.
const Scene* scene_named(const std::string& name) {
    static std::map<std::string, std::unique_ptr<const Scene>> scenes;
    const auto [entry, is_new] = scenes.try_emplace(name);
    if (const std::filesystem::path file = file_of(name); is_new && !file.empty())
        entry->second = std::make_unique<const Scene>(load_mitsuba_xml(file).description);
    return entry->second.get();
}

/// The first pass of a render, and a few of its blocks, spread over the image.
struct Stage {
    Stage(const Scene& scene_, const RenderSettings& settings_, int block_count)
        : scene(scene_), settings(settings_), worker(scene, scene.camera(), image_size, settings, nullptr) {
        const std::vector<PixelRect> all = blocks_of(pass);
        for (int i = 0; i < block_count; ++i) {
            const auto middle = (static_cast<std::size_t>(i) * 2 + 1) * all.size() / 2;
            blocks.push_back(all[middle / static_cast<std::size_t>(block_count)]);
        }
    }

    /// Returns a block's pixels with the border that its G-PR sampling sets need, clipped to the image.
    PixelRect with_border(PixelRect block) const {
        return PixelRect{block.x0, block.y0, block.x1 + gpr_border, block.y1 + gpr_border}.clipped(image_size);
    }

    const Scene& scene;
    RenderSettings settings;
    LearnedReuse learned{image_size, settings};
    Pass pass{scene, scene.camera(), image_size, settings, learned, 0};
    Worker worker;
    std::vector<PixelRect> blocks;
};

RenderSettings settings_of(int tile = 6, ShiftKind shift = ShiftKind::half_vector,
                           RouletteKind roulette = RouletteKind::relative) {
    RenderSettings settings;
    settings.max_depth = max_depth;
    settings.tile = tile;
    settings.shift = shift;
    settings.roulette = roulette;
    return settings;
}

void report(benchmark::State& state, const char* name, double count) {
    state.counters[name] = benchmark::Counter(count, benchmark::Counter::kIsRate);
}

/// Measures whole base paths, which are all that path tracing needs.
void base_paths(benchmark::State& state, const Scene& scene) {
    Stage stage(scene, settings_of(), 24);
    for (auto _ : state)
        for (PixelRect block : stage.blocks)
            stage.worker.base.trace(stage.pass, stage.worker.tracer, block.clipped(image_size),
                                    {std::max(block.x0, 0), std::max(block.y0, 0)});
    report(state, "paths", static_cast<double>(stage.worker.counters.camera_paths));
    report(state, "rays", static_cast<double>(stage.worker.counters.all_rays()));
}

/// The rays of the base paths of some blocks, in the order in which they are traced.
struct Rays {
    std::vector<Ray> camera;
    std::vector<Ray> bounces; ///< that hit a surface or reach an environment
    std::vector<Segment> to_lights;
};

Rays rays_of(const Scene& scene) {
    Stage stage(scene, settings_of(), 24);
    const Tracer& tracer = stage.worker.tracer;
    Rays rays;
    BasePath path;
    const auto add_pixel = [&](int x, int y) {
        rays.camera.push_back(stage.pass.camera_ray(x, y, stage.pass.camera_sample({x, y})));
        trace_pixel(stage.pass, tracer, x, y, stage.pass.camera_sample({x, y}), path);
        for (int i = 0; i < path.size(); ++i) {
            const BaseVertex& v = path[i];
            LightSample drawn;
            Segment segment;
            if (i + 1 < max_depth && draw_light(tracer, v.vertex, path.random, i + 1, drawn, segment))
                rays.to_lights.push_back(segment);
            if (i + 1 < path.size() || v.escapes)
                rays.bounces.push_back(tracer.leave(v.vertex, v.vertex.to_world(v.to_next)));
        }
    };
    for (PixelRect block : stage.blocks)
        for (int y = std::max(block.y0, 0); y < std::min(block.y1, image_size.y); ++y)
            for (int x = std::max(block.x0, 0); x < std::min(block.x1, image_size.x); ++x)
                add_pixel(x, y);
    return rays;
}

void closest(benchmark::State& state, const Scene& scene, const std::vector<Ray>& rays) {
    Hit hit;
    for (auto _ : state)
        for (const Ray& ray : rays)
            benchmark::DoNotOptimize(scene.intersector().closest(ray, hit));
    report(state, "rays", static_cast<double>(state.iterations()) * static_cast<double>(rays.size()));
}

void camera_rays(benchmark::State& state, const Scene& scene) {
    closest(state, scene, rays_of(scene).camera);
}

void bounce_rays(benchmark::State& state, const Scene& scene) {
    closest(state, scene, rays_of(scene).bounces);
}

void shadow_rays(benchmark::State& state, const Scene& scene) {
    const std::vector<Segment> segments = rays_of(scene).to_lights;
    for (auto _ : state)
        for (const Segment& segment : segments)
            benchmark::DoNotOptimize(scene.intersector().occluded(segment));
    report(state, "rays", static_cast<double>(state.iterations()) * static_cast<double>(segments.size()));
}

/// Measures shifts alone: every base path of a G-PR sampling set to all other pixels of the set, for several
/// tiles.
void shift_paths(benchmark::State& state, const Scene& scene, ShiftKind kind) {
    Stage stage(scene, settings_of(6, kind), 24);
    Worker& worker = stage.worker;
    std::vector<BaseBlock> tiles(stage.blocks.size());
    std::vector<SamplingSet> sets(stage.blocks.size());
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        PixelRect tile = stage.blocks[i];
        tile.x1 = tile.x0 + stage.settings.tile;
        tile.y1 = tile.y0 + stage.settings.tile;
        const PixelRect pixels = stage.with_border(tile);
        tiles[i].trace(stage.pass, worker.tracer, pixels, {pixels.x0, pixels.y0});
        sets[i].assign(pixels);
        collect(stage.pass, tiles[i], sets[i]);
    }
    worker.counters = {};
    for (auto _ : state)
        for (SamplingSet& set : sets) {
            worker.reuse.begin(set.paths, set.counts);
            for (int k = 0; k < set.size(); ++k)
                worker.reuse.share(k, 1, set.radiance);
        }
    report(state, "shifts", static_cast<double>(worker.counters.shift_attempts()));
    report(state, "rays", static_cast<double>(worker.counters.all_rays()));
}

/// Measures path reuse by G-PR on the base paths of whole blocks. A path counts once for each set that contains
/// it.
void reuse_paths(benchmark::State& state, const Scene& scene, int tile, RouletteKind roulette) {
    Stage stage(scene, settings_of(tile, ShiftKind::half_vector, roulette), 6);
    Worker& worker = stage.worker;
    std::vector<BaseBlock> base(stage.blocks.size());
    for (std::size_t i = 0; i < base.size(); ++i)
        base[i].trace(stage.pass, worker.tracer, stage.with_border(stage.blocks[i]),
                      {std::max(stage.blocks[i].x0, 0), std::max(stage.blocks[i].y0, 0)});
    worker.counters = {};
    for (auto _ : state)
        for (std::size_t i = 0; i < base.size(); ++i) {
            std::swap(worker.base, base[i]);
            for_each_gpr_set(stage.pass, stage.blocks[i], worker.set, [&](PixelRect, PixelRect, int) {
                tessera::reuse_paths(stage.pass, roulette, worker);
            });
            std::swap(worker.base, base[i]);
        }
    report(state, "paths", static_cast<double>(worker.counters.set_paths()));
    report(state, "shifts", static_cast<double>(worker.counters.shift_attempts()));
}

/// Registers a benchmark. It loads its scene when it runs.
template <class Function, class... Arguments>
void add(const std::string& name, const std::string& scene_name, Function function, Arguments... arguments) {
    const auto run = [=](benchmark::State& state) {
        if (const Scene* scene = scene_named(scene_name))
            function(state, *scene, arguments...);
        else
            state.SkipWithError("no such scene");
    };
    benchmark::RegisterBenchmark((scene_name + "/" + name).c_str(), run)->Unit(benchmark::kMillisecond);
}

void add_benchmarks(const std::string& scene) {
    add("base_paths", scene, base_paths);
    add("camera_rays", scene, camera_rays);
    add("bounce_rays", scene, bounce_rays);
    add("shadow_rays", scene, shadow_rays);
    add("share/half_vector", scene, shift_paths, ShiftKind::half_vector);
    add("share/reconnection", scene, shift_paths, ShiftKind::reconnection);
    add("share/replay", scene, shift_paths, ShiftKind::replay);
    add("share/replay_reconnection", scene, shift_paths, ShiftKind::replay_reconnection);
    for (int tile : {2, 6, 8}) {
        const std::string name = "reuse_paths/tile_" + std::to_string(tile);
        add(name + "/roulette", scene, reuse_paths, tile, RouletteKind::relative);
        add(name + "/no_roulette", scene, reuse_paths, tile, RouletteKind::none);
    }
}

} // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    std::vector<std::string> scenes(argv + 1, argv + argc);
    if (scenes.empty())
        scenes = {"cornell-box", "veach-ajar", "kitchen", "living-room"};
    for (const std::string& scene : scenes) {
        if (scene.starts_with("-")) {
            benchmark::ReportUnrecognizedArguments(argc, argv);
            return 1;
        }
        add_benchmarks(scene);
    }
    benchmark::RunSpecifiedBenchmarks();
}
