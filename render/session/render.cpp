#include "render/session/render.h"

#include "render/method/pass.h"

#include <chrono>
#include <ctime>
#include <stdexcept>

#include <fmt/core.h>

namespace tessera {

namespace {

double thread_cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class T>
void check_range(const char* name, T value, T low, T high) {
    if (!(value >= low && value <= high))
        throw std::invalid_argument(fmt::format("{} is {}: must be from {} to {}", name, value, low, high));
}

} // namespace

void check(const RenderSettings& s) {
    check_range("max depth", s.max_depth, 1, 64);
    check_range("tile size", s.tile, 1, 16);
    check_range("RR delta", s.rr_delta, 0.0f, 1e30f);
    check_range("q_min", s.q_min, 1e-4f, 1.0f);
    check_range("shift threshold", s.shift_threshold, 0.0f, 1.0f);
}

Render::Render(std::shared_ptr<const Scene> scene, const Camera& camera, glm::ivec2 size,
               const RenderSettings& settings)
    : scene_(std::move(scene)), camera_(camera), size_(size), settings_(settings),
      film_((check_range("image width", size.x, 1, 32768), size.x),
            (check_range("image height", size.y, 1, 32768), size.y), has_gradients(settings.method)) {
    check(settings);
}

bool Render::pass(ThreadPool& pool, std::stop_token stop) {
    const auto start = std::chrono::steady_clock::now();
    const Pass pass(*scene_, camera_, size_, settings_, spp_);
    const std::vector<PixelRect> blocks = blocks_of(pass);
    std::vector<std::unique_ptr<Worker>> workers;
    for (int i = 0; i < pool.size(); ++i)
        workers.push_back(std::make_unique<Worker>(*scene_, settings_));

    pool.parallel_for(
        static_cast<int>(blocks.size()),
        [&](int i, int w) {
            Worker& worker = *workers[static_cast<std::size_t>(w)];
            const double before = thread_cpu_seconds();
            render_block(pass, blocks[static_cast<std::size_t>(i)], worker, film_);
            worker.cpu_seconds += thread_cpu_seconds() - before;
        },
        stop);
    if (stop.stop_requested())
        return false;

    for (const auto& worker : workers) {
        counters_ += worker->counters;
        cpu_seconds_ += worker->cpu_seconds;
    }
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++spp_;
    return true;
}

} // namespace tessera
