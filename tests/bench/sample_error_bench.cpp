// sample_error_bench SCENE.xml [SAMPLES]: compares the relMSE of raw samples that estimate_sample_error() returns
// with the relMSE to a reference. The reference has two halves of SAMPLES (64) samples each, by G-PR. 320x180
// pixels, depth 8.

#include "recon/metrics/metrics.h"
#include "recon/metrics/sample_error.h"
#include "recon/picture/reconstruct.h"
#include "render/load/mitsuba_xml.h"
#include "render/run/render.h"
#include "render/scene/scene.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <memory>

namespace {

using namespace tessera;

Render render_of(const std::shared_ptr<const Scene>& scene, Method method, unsigned seed) {
    RenderSettings settings;
    settings.method = method;
    settings.max_depth = 8;
    settings.seed = seed;
    return {scene, scene->camera(), {320, 180}, settings};
}

/// Returns a reconstruction without directly visible emission.
RgbImage picture(GradientImages images, Norm norm, ThreadPool& pool) {
    images.very_direct = {};
    ReconstructionSettings settings;
    settings.norm = norm;
    return reconstruct(images, settings, pool.row_loops()).image;
}

void measure(const std::shared_ptr<const Scene>& scene, int samples) {
    ThreadPool pool(0);
    std::array<RgbImage, 2> reference;
    for (unsigned half = 0; half < 2; ++half) {
        Render render = render_of(scene, Method::gpr, 100 + half);
        for (int i = 0; i < samples; ++i)
            render.pass(pool);
        reference[half] = picture(render.images(), Norm::l2, pool);
    }
    for (const Method method : {Method::pt, Method::pr, Method::gpt, Method::gpr}) {
        Render render = render_of(scene, method, 1);
        for (int spp = 1; spp <= 32; ++spp) {
            render.pass(pool);
            constexpr int printed_spp[] = {2, 4, 12, 32};
            if (std::find(std::begin(printed_spp), std::end(printed_spp), spp) == std::end(printed_spp))
                continue;
            const GradientImages images = render.images();
            const RgbImage primal = picture(images, Norm::none, pool);
            const double error = measure_floor_free_error(primal, reference[0], reference[1]).relative_mse;
            const auto estimate = estimate_sample_error(images, picture(images, Norm::guided, pool));
            std::printf("%-3s %2d spp  relMSE %.4g", short_name(method).data(), spp, error);
            if (estimate)
                std::printf("  estimate %.4g +- %.2g  ratio %.2f\n", estimate->relative_mse,
                            estimate->standard_error, estimate->relative_mse / error);
            else
                std::printf("  no estimate\n");
        }
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2)
        return std::fputs("sample_error_bench SCENE.xml [SAMPLES]\n", stderr), EXIT_FAILURE;
    try {
        measure(std::make_shared<const Scene>(load_mitsuba_xml(argv[1]).description),
                argc > 2 ? std::atoi(argv[2]) : 64);
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "sample_error_bench: %s\n", error.what()), EXIT_FAILURE;
    }
}
