// warm_bench SCENE.xml REFERENCE.exr|WIDTHxHEIGHT [SAMPLES]: compares incremental reconstructions
// (docs/reconstruction.md, "Incremental reconstruction") with full ones, after each pass of G-PR with depth 8 on
// all hardware threads. Prints wall time, which other work on the machine affects, and the errors to a reference.
// A reference also gives the size.

#include "recon/metrics/metrics.h"
#include "recon/metrics/seen_error.h"
#include "recon/picture/reconstruct.h"
#include "render/load/mitsuba_xml.h"
#include "render/run/reference_image.h"
#include "render/run/render.h"
#include "render/run/thread_pool.h"
#include "render/scene/scene.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <optional>

#include <glm/vec2.hpp>

namespace {

using namespace tessera;

void print(const char* how, const Reconstruction& reconstruction, const std::optional<ReferenceImage>& reference) {
    std::printf("; %s %.3f s", how, reconstruction.seconds);
    if (!reference)
        return;
    const auto& [one, other] = reference->halves;
    std::printf(", relMSE %.5f, %.2f dB", measure_floor_free_error(reconstruction.image, one, other).relative_mse,
                psnr(reconstruction.image, one, other));
}

void measure(const std::shared_ptr<const Scene>& scene, glm::ivec2 size,
             const std::optional<ReferenceImage>& reference, int samples) {
    ThreadPool pool(0);
    RenderSettings settings;
    settings.method = Method::gpr;
    settings.max_depth = 8;
    Render render(scene, scene->camera(), size, settings);
    Reconstructor reconstructor;
    for (int spp = 1; spp <= samples; ++spp) {
        render.pass(pool);
        const GradientImages images = render.images();
        std::printf("%3d samples", spp);
        print("full", reconstruct(images, {}, pool.row_loops()), reference);
        const Reconstruction incremental = reconstructor.reconstruct(images, {}, pool.row_loops());
        print(incremental.goes_on ? "incremental" : "restarted  ", incremental, reference);
        std::printf("\n");
    }
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3)
        return std::fputs("warm_bench SCENE.xml REFERENCE.exr|WIDTHxHEIGHT [SAMPLES]\n", stderr), EXIT_FAILURE;
    try {
        glm::ivec2 size;
        std::optional<ReferenceImage> reference;
        if (std::sscanf(argv[2], "%dx%d", &size.x, &size.y) != 2) {
            reference = read_reference(argv[2]);
            size = {reference->mean.width(), reference->mean.height()};
        }
        measure(std::make_shared<const Scene>(load_mitsuba_xml(argv[1]).description), size, reference,
                argc > 3 ? std::atoi(argv[3]) : 16);
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "warm_bench: %s\n", error.what()), EXIT_FAILURE;
    }
}
