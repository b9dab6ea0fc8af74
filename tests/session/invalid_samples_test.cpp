// Radiance that overflows floats. Buffers stay finite, and invalid samples are counted.
#include "render/inspect/inspection.h"
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/rooms.h"

#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(17, 11);
constexpr int passes = 4;

/// Returns a room with a point light whose light is finite in most places, but overflows close to it.
std::shared_ptr<const Scene> blinding_room() {
    Room r;
    r.point({{0, 0, -0.8f}, Rgb(3e38f, 1e38f, 2e38f)});
    return r.build();
}

bool all_finite(const RgbImage& image) {
    for (const Rgb c : image)
        if (!is_finite(c))
            return false;
    return true;
}

class InvalidSamples : public testing::TestWithParam<Method> {};

TEST_P(InvalidSamples, BuffersStayFinite) {
    RenderSettings settings;
    settings.method = GetParam();
    settings.max_depth = 6;
    settings.tile = 4;
    settings.seed = 77;
    const auto scene = blinding_room();
    std::set<std::string> texts;
    for (const int threads : {1, 3}) {
        Render render(scene, scene->camera(), size, settings);
        ThreadPool pool(threads);
        for (int pass = 0; pass < passes; ++pass)
            render.pass(pool);
        const GradientImages images = render.images();
        EXPECT_TRUE(all_finite(images.primal));
        EXPECT_TRUE(all_finite(images.dx));
        EXPECT_TRUE(all_finite(images.dy));
        EXPECT_TRUE(all_finite(images.very_direct));
        const Counters& counters = render.counters();
        EXPECT_GT(counters.invalid_samples, 0u);
        EXPECT_LT(counters.invalid_samples,
                  counters.rays[0] / 10); // counts invalid samples, not all pixels that reuse them
        ASSERT_FALSE(counters.first_invalid.list().empty());
        EXPECT_EQ(counters.first_invalid.list()[0].pass, 0);
        const std::string text = invalid_text(counters, settings.seed);
        EXPECT_NE(text.find("pass 0"), std::string::npos) << text;
        EXPECT_NE(text.find("seed 77"), std::string::npos) << text;
        texts.insert(text);
    }
    EXPECT_EQ(texts.size(), 1u); // the text does not depend on the number of threads
}

/// Inspects every sample of a short render. Exactly the samples that the render counts as invalid are invalid.
void expect_inspection_finds_invalid_samples(RenderSettings settings, glm::ivec2 small) {
    settings.max_depth = 6;
    settings.tile = 4;
    const auto scene = blinding_room();
    std::size_t refused = 0;
    for (settings.seed = 0; refused == 0 && settings.seed < 50; ++settings.seed) {
        Render render(scene, scene->camera(), small, settings);
        ThreadPool pool(1);
        for (int pass = 0; pass < passes; ++pass)
            render.pass(pool);
        const auto first = render.counters().first_invalid.list();
        ASSERT_LT(first.size(), FirstInvalid::most); // the list is complete
        refused += first.size();
        for (int i = 0; i < passes * small.x * small.y; ++i) {
            const InvalidSample sample{i / (small.x * small.y), i / small.x % small.y, i % small.x};
            const glm::ivec2 pixel(sample.x, sample.y);
            const Inspection seen = inspect(
                *scene, scene->camera(), small, settings,
                replay_learning(*scene, scene->camera(), small, settings, sample.pass, pixel), sample.pass, pixel);
            EXPECT_EQ(seen.is_invalid, std::ranges::find(first, sample) != first.end())
                << sample.pass << ": " << sample.x << ", " << sample.y;
        }
    }
    EXPECT_GT(refused, 0u);
}

TEST_P(InvalidSamples, AreFoundByPixelPassAndSeed) {
    RenderSettings settings;
    settings.method = GetParam();
    // Pixels without reuse have several paths that can be invalid.
    expect_inspection_finds_invalid_samples(settings,
                                            GetParam() == Method::gpr ? glm::ivec2(4, 3) : glm::ivec2(7, 5));
}

INSTANTIATE_TEST_SUITE_P(methods, InvalidSamples, testing::ValuesIn(all_methods),
                         [](const auto& p) { return std::string(short_name(p.param)); });

} // namespace

} // namespace tessera::test
