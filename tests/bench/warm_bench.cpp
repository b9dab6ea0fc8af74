// warm_bench SCENE.xml REFERENCE.exr|WIDTHxHEIGHT [SAMPLES]: what pictures that go on from the last one cost
// beside such as begin anew, one after each pass of G-PR, and, with a reference, which tells the size, what they
// are worth; depth 8, all hardware threads. Wall time: other work on the machine counts.

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

void print(const char* how, const Reconstruction& made, const std::optional<ReferenceImage>& reference) {
    std::printf("; %s %.3f s", how, made.seconds);
    if (!reference)
        return;
    const auto& [one, other] = reference->halves;
    std::printf(", relMSE %.5f, %.2f dB", measure_floor_free_error(made.image, one, other).relative_mse,
                psnr(made.image, one, other));
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
        print("anew", reconstruct(images, {}, pool.row_loops()), reference);
        const Reconstruction next = reconstructor.reconstruct(images, {}, pool.row_loops());
        print(next.goes_on ? "going on" : "found   ", next, reference);
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
