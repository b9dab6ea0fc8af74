#include "render/run/render.h"

#include "render/estimator/pass.h"
#include "render/estimator/settings_table.h"

#include <chrono>
#include <ctime>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

double thread_cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

FilmBuffers buffers_of(const RenderSettings& s) {
    return {has_gradients(s.method), s.method != Method::pt, reuses_paths(s.method) && s.adapt_tile,
            s.very_direct_grid > 1};
}

/// Throws where one edge of an image is outside its limits.
int checked(const char* name, int pixels) {
    if (pixels < 1 || pixels > most_picture_edge)
        throw std::invalid_argument(
            fmt::format("{} is {}: must be from 1 to {}", name, pixels, most_picture_edge));
    return pixels;
}

} // namespace

Render::Render(std::shared_ptr<const Scene> scene, const Camera& camera, glm::ivec2 size,
               const RenderSettings& settings)
    : scene_(std::move(scene)), camera_(camera), size_(size), settings_(settings),
      film_(checked("image width", size.x), checked("image height", size.y), buffers_of(settings)),
      plan_(size, settings_), newest_plan_(std::make_shared<const ReusePlan>(plan_)) {
    check(settings);
}

/// Tiles are moved about from pass to pass, but the noise of a pass is alike all over a tile. Where tiles are cut,
/// it is so in smaller squares: this is the most.
GradientImages Render::with_patch(GradientImages images) const {
    if (reuses_paths(settings_.method) && settings_.primal == PrimalSource::reuse)
        images.patch = static_cast<float>(settings_.tile);
    return images;
}

bool Render::pass(ThreadPool& pool, std::stop_token stop) {
    const auto start = std::chrono::steady_clock::now();
    const Pass pass(*scene_, camera_, size_, settings_, plan_, spp_);
    const std::vector<PixelRect> blocks = blocks_of(pass);
    std::vector<std::unique_ptr<Worker>> workers;
    for (int i = 0; i < pool.size(); ++i)
        workers.push_back(std::make_unique<Worker>(*scene_, settings_));

    const auto for_each = [&](std::size_t count, const auto& work) {
        pool.parallel_for(
            static_cast<int>(count),
            [&](int i, int w) {
                Worker& worker = *workers[static_cast<std::size_t>(w)];
                const double before = thread_cpu_seconds();
                work(i, worker);
                worker.cpu_seconds += thread_cpu_seconds() - before;
            },
            stop);
    };
    if (settings_.very_direct_grid > 1 && spp_ == 0) {
        RgbImage look(size_.x, size_.y);
        for_each(blocks.size(), [&](int i, Worker& worker) {
            look_at_lamps(pass, blocks[static_cast<std::size_t>(i)], worker.tracer, look);
        });
        film_.find_lamp_edges(look);
    }
    for_each(blocks.size(), [&](int i, Worker& worker) {
        render_block(pass, blocks[static_cast<std::size_t>(i)], worker, film_);
    });
    if (stop.stop_requested())
        return false;

    for (const auto& worker : workers) {
        counters_ += worker->counters;
        cpu_seconds_ += worker->cpu_seconds;
    }
    newest_plan_ = std::make_shared<const ReusePlan>(plan_);
    plan_.learn(film_.base_luminance());
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++spp_;
    return true;
}

Memory Render::memory() {
    Memory memory = film_.memory();
    append(memory, plan_.memory());
    append(memory, {memory_of(counters_), memory_of(spp_), memory_of(seconds_), memory_of(cpu_seconds_)});
    return memory;
}

} // namespace tessera
