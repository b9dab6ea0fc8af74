// Many passes on a tiny image: the mean neither drifts nor overflows.
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/rooms.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(4, 3);
constexpr int batches = 20; // in each half

using Means = std::vector<glm::dvec3>;

/// Sums of everything that was measured: primal, dx and dy of each pixel, and of all pixels together.
Means sums_of(const Render& render) {
    const GradientImages images = render.images();
    Means sums;
    for (const RgbImage* image : {&images.primal, &images.dx, &images.dy}) {
        glm::dvec3 all(0);
        for (const Rgb c : *image) {
            EXPECT_TRUE(is_finite(c));
            sums.push_back(glm::dvec3(c) * double(render.spp()));
            all += sums.back();
        }
        sums.push_back(all);
    }
    return sums;
}

/// How many standard errors lie between the means of the first and the second half, by the means of batches: the
/// largest of all pixels, buffers and channels.
double drift(int passes) {
    RenderSettings settings;
    settings.method = Method::gpr;
    settings.max_depth = 3;
    settings.tile = 3;
    const auto scene = Room().build();
    Render render(scene, scene->camera(), size, settings);
    ThreadPool pool(1);
    Means before = sums_of(render);
    std::vector<glm::dvec3> sum[2], squares[2];
    for (int half = 0; half < 2; ++half) {
        sum[half] = squares[half] = Means(before.size(), glm::dvec3(0));
        for (int batch = 0; batch < batches; ++batch) {
            const int count = passes / (2 * batches);
            for (int pass = 0; pass < count; ++pass)
                render.pass(pool);
            const Means after = sums_of(render);
            for (std::size_t i = 0; i < after.size(); ++i) {
                const glm::dvec3 mean = (after[i] - before[i]) / double(count);
                sum[half][i] += mean;
                squares[half][i] += mean * mean;
            }
            before = after;
        }
    }
    EXPECT_EQ(render.counters().refused_samples, 0u);
    const auto variance_of_mean = [&](int half, std::size_t i, int c) {
        const double mean = sum[half][i][c] / batches;
        return (squares[half][i][c] / batches - mean * mean) / (batches - 1);
    };
    double largest = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double error = std::sqrt(variance_of_mean(0, i, c) + variance_of_mean(1, i, c));
            if (error > 0) // the last column and row have no gradients
                largest = std::max(largest, std::abs(sum[0][i][c] - sum[1][i][c]) / batches / error);
        }
    return largest;
}

// There are 90 values that are not 0, few of them independent, with Student's t of 38 degrees: passed by chance
// once in about a thousand seeds.
constexpr double limit = 4.5;

TEST(LongRun, TheMeanDoesNotDrift) {
    EXPECT_LT(drift(2000), limit);
}

TEST(LongRun, SlowTheMeanOfManyPassesDoesNotDrift) {
    EXPECT_LT(drift(100'000), limit);
}

} // namespace

} // namespace tessera::test
