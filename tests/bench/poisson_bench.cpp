// Measures the CPU time of reconstructions, of the whole process. The numbers in a benchmark's name are width,
// height, threads and, for L2, 1000 alpha.

#include "recon/picture/reconstruct.h"
#include "recon/solvers/poisson_direct.h"

#include <atomic>
#include <cstdint>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

using namespace tessera;

RgbImage noise(int width, int height, std::uint32_t seed, float mean) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> uniform(mean - 0.5f, mean + 0.5f);
    RgbImage image(width, height);
    for (Rgb& c : image)
        c = {uniform(engine), uniform(engine), uniform(engine)};
    return image;
}

ParallelFor threads_for(int threads) {
    if (threads == 1)
        return serial_for;
    return [threads](int count, const std::function<void(int)>& body) {
        std::atomic<int> next = 0;
        const auto work = [&] {
            for (int i = next++; i < count; i = next++)
                body(i);
        };
        std::vector<std::jthread> others;
        for (int i = 1; i < threads; ++i)
            others.emplace_back(work);
        work();
    };
}

void l2_solve(benchmark::State& state) {
    const auto width = static_cast<int>(state.range(0)), height = static_cast<int>(state.range(1));
    const RgbImage primal = noise(width, height, 1, 1), dx = noise(width, height, 2, 0),
                   dy = noise(width, height, 3, 0);
    const PoissonProblem problem{primal, dx, dy, 0.001f * static_cast<float>(state.range(3))};
    const ParallelFor parallel_for = threads_for(static_cast<int>(state.range(2)));
    PoissonSolver solver(width, height);
    RgbImage image;
    solver.solve(problem, image, parallel_for);
    for (auto _ : state)
        solver.solve(problem, image, parallel_for);
}

/// Reconstructs as the viewer does, with transforms and memory of the last call. A warm start also has its
/// solution.
void reconstruction(benchmark::State& state, Norm norm, bool warm) {
    const auto width = static_cast<int>(state.range(0)), height = static_cast<int>(state.range(1));
    GradientImages images{noise(width, height, 1, 1), noise(width, height, 2, 0), noise(width, height, 3, 0), {}};
    images.primal_variance = images.dx_variance = images.dy_variance = Image<float>(width, height, 0.1f);
    for (std::size_t i = 0; i < images.primal.size(); i += 37)
        images.dx_variance.data()[i] = images.dy_variance.data()[i] = 100;
    const ParallelFor parallel_for = threads_for(static_cast<int>(state.range(2)));
    Reconstructor reconstructor;
    reconstructor.reconstruct(images, {norm, 0.2f}, parallel_for);
    for (auto _ : state) {
        if (!warm)
            reconstructor.forget();
        benchmark::DoNotOptimize(reconstructor.reconstruct(images, {norm, 0.2f}, parallel_for));
    }
}

void sizes(benchmark::internal::Benchmark* benchmark) {
    benchmark->Args({1280, 720, 1, 200})->Args({1280, 720, 2, 200})->Args({1280, 720, 1, 1});
    // Widths that are no products of 2, 3 and 5, as the transform needs: a prime, again with a prime height, a
    // common laptop screen, and one that is far below the next such product.
    for (const auto& [width, height] : {std::pair{1279, 720}, {1279, 719}, {1366, 768}, {1201, 701}})
        benchmark->Args({width, height, 1, 200});
    benchmark->Args({640, 360, 1, 200})->Args({1920, 1080, 1, 200});
    benchmark->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

void reconstruction_sizes(benchmark::internal::Benchmark* benchmark) {
    for (const auto& [width, height] : {std::pair{1280, 720}, {1279, 719}})
        benchmark->Args({width, height, 1})->Args({width, height, 2});
    benchmark->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

BENCHMARK(l2_solve)->Apply(sizes);
BENCHMARK_CAPTURE(reconstruction, l2, Norm::l2, false)->Apply(reconstruction_sizes);
BENCHMARK_CAPTURE(reconstruction, l1_cold, Norm::l1, false)->Apply(reconstruction_sizes);
BENCHMARK_CAPTURE(reconstruction, l1_warm, Norm::l1, true)->Apply(reconstruction_sizes);
BENCHMARK_CAPTURE(reconstruction, weighted_cold, Norm::weighted, false)->Apply(reconstruction_sizes);
BENCHMARK_CAPTURE(reconstruction, weighted_warm, Norm::weighted, true)->Apply(reconstruction_sizes);
BENCHMARK_CAPTURE(reconstruction, mixed_cold, Norm::mixed, false)->Apply(reconstruction_sizes);
BENCHMARK_CAPTURE(reconstruction, mixed_warm, Norm::mixed, true)->Apply(reconstruction_sizes);

} // namespace

BENCHMARK_MAIN();
