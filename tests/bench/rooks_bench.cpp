// rooks_bench SCENE.xml [SAMPLES]: measures the gain of N-rooks patterns of 4, 9 and 16 pixels for indirect light
// [Bekaert 2002, table 1]. Prints the variance of PT over that of PR, per sample and at equal CPU time on one
// thread. Only pixels without direct light count.

#include "render/load/mitsuba_xml.h"
#include "render/run/render.h"
#include "render/scene/scene.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>

#include <glm/vec2.hpp>

namespace {

using namespace tessera;

constexpr glm::ivec2 size(192, 192);

struct Picture {
    GradientImages images;
    double cpu_seconds;
};

Picture render(const std::shared_ptr<const Scene>& scene, const RenderSettings& settings, int samples) {
    ThreadPool pool(1);
    Render render(scene, scene->camera(), size, settings);
    for (int i = 0; i < samples; ++i)
        render.pass(pool);
    return {render.images(), render.cpu_seconds()};
}

RenderSettings path_tracing(int max_depth) {
    RenderSettings settings;
    settings.method = Method::pt;
    settings.max_depth = max_depth;
    settings.path_guiding = Guiding::off;
    return settings;
}

/// Path reuse as in [Bekaert 2002]: all paths are reused, and offset paths reconnect at x2.
RenderSettings rooks(int pixels) {
    RenderSettings settings = path_tracing(8);
    settings.method = Method::pr;
    settings.pattern = Pattern::rooks;
    settings.tile = pixels;
    settings.adapt_tile = false;
    settings.shift = ShiftKind::reconnection;
    settings.roulette = RouletteKind::none;
    settings.basis = Basis::none; // measures the variance of radiance itself
    return settings;
}

/// Returns the sum of the variance over the pixels that neither see a light nor receive direct light.
double indirect_variance(const GradientImages& images, const RgbImage& direct) {
    double sum = 0;
    for (std::size_t i = 0; i < direct.size(); ++i)
        if (is_black(direct.data()[i]) && is_black(images.very_direct.data()[i]))
            sum += images.primal_variance.data()[i];
    return sum;
}

void measure(const char* file, int samples) {
    const auto scene = std::make_shared<const Scene>(load_mitsuba_xml(file).description);
    const RgbImage direct = render(scene, path_tracing(2), samples).images.primal;
    const Picture pt = render(scene, path_tracing(8), samples);
    std::printf("%dx%d pixels, depth 8, %d samples a pixel\n"
                "  N       variance per sample, PT / PR  at equal time\n",
                size.x, size.y, samples);
    for (const int pixels : {4, 9, 16}) {
        const Picture pr = render(scene, rooks(pixels), samples);
        const double gain = indirect_variance(pt.images, direct) / indirect_variance(pr.images, direct);
        std::printf("%3d  %33.2f  %13.2f\n", pixels, gain, gain * pt.cpu_seconds / pr.cpu_seconds);
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2)
        return std::fputs("rooks_bench SCENE.xml [SAMPLES]\n", stderr), EXIT_FAILURE;
    try {
        measure(argv[1], argc > 2 ? std::atoi(argv[2]) : 64);
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "rooks_bench: %s\n", error.what()), EXIT_FAILURE;
    }
}
