// The errors of consistent reconstructions fall without a floor, from 4 to 4,096 samples.
#include "recon/metrics/metrics.h"
#include "recon/picture/reconstruct.h"
#include "render/load/mitsuba_xml.h"
#include "render/run/render.h"
#include "render/scene/scene.h"

#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

struct Case {
    const char* scene; ///< in assets
    glm::ivec2 size;
    int samples;           ///< largest number of samples per pixel
    int reference_samples; ///< samples per pixel of each path-traced reference half
};

class Consistency : public testing::TestWithParam<Case> {
protected:
    const Case& c = GetParam();
    ThreadPool pool{2};
    std::shared_ptr<const Scene> scene = std::make_shared<const Scene>(
        load_mitsuba_xml(std::string(TESSERA_SOURCE_DIR "/assets/") + c.scene).description);

    Render render_of(Method method, std::uint64_t seed) {
        RenderSettings settings;
        settings.method = method;
        settings.max_depth = 5;
        settings.seed = seed;
        return {scene, scene->camera(), c.size, settings};
    }

    /// Renders two independent reference halves, whose noise cancels in the floor-free error.
    std::array<RgbImage, 2> reference() {
        std::array<RgbImage, 2> halves;
        for (std::uint64_t half = 0; half < 2; ++half) {
            Render render = render_of(Method::pt, 1000 + half);
            while (render.spp() < c.reference_samples)
                render.pass(pool);
            halves[half] = reconstruct(render.images(), {.norm = Norm::none}).image;
        }
        return halves;
    }
};

struct Point {
    int samples;
    FloorFreeError error;
};

TEST_P(Consistency, ErrorsFallWithoutAFloor) {
    const std::array<RgbImage, 2> truth = reference();
    Render render = render_of(Method::gpr, 1);
    std::array<std::vector<Point>, all_norms.size()> curves;
    for (int samples = 4; samples <= c.samples; samples *= 4) {
        while (render.spp() < samples)
            render.pass(pool);
        const GradientImages images = render.images();
        for (const Norm norm : all_norms)
            if (guarantee_of(norm).convergence != Convergence::biased)
                curves[static_cast<int>(norm)].push_back(
                    {samples,
                     measure_floor_free_error(reconstruct(images, {.norm = norm}).image, truth[0], truth[1])});
    }
    for (const Norm norm : all_norms) {
        const std::vector<Point>& curve = curves[static_cast<int>(norm)];
        if (curve.empty())
            continue;
        std::printf("%-32s %-9s", c.scene, std::string(to_string(norm)).c_str());
        for (const Point& p : curve)
            std::printf("  %d: %.2e", p.samples, p.error.relative_mse);
        std::printf("\n");
        // With 16 times the samples, a squared error that falls as n^-0.5 is a quarter.
        for (std::size_t i = 0; i + 2 < curve.size(); ++i) {
            const FloorFreeError &few = curve[i].error, &many = curve[i + 2].error;
            EXPECT_LT(many.relative_mse, few.relative_mse / 4 + 3 * many.standard_error)
                << to_string(norm) << ": " << curve[i].samples << " and " << curve[i + 2].samples << " samples";
        }
    }
}

constexpr Case quick[] = {{"cornell-box.xml", {40, 24}, 256, 4096},
                          {"stability/keyhole.xml", {40, 24}, 256, 8192}};
INSTANTIATE_TEST_SUITE_P(quick, Consistency, testing::ValuesIn(quick));

constexpr Case six_scenes[] = {
    {"cornell-box.xml", {48, 27}, 4096, 32768},       {"stability/keyhole.xml", {48, 27}, 4096, 65536},
    {"stability/glossy.xml", {48, 27}, 4096, 32768},  {"stability/edges.xml", {48, 27}, 4096, 32768},
    {"stability/texture.xml", {48, 27}, 4096, 32768}, {"stability/bowls.xml", {48, 27}, 4096, 32768}};
INSTANTIATE_TEST_SUITE_P(SlowSixScenes, Consistency, testing::ValuesIn(six_scenes));

} // namespace

} // namespace tessera::test
