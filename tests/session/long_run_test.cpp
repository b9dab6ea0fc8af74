// The mean of many passes of a tiny image neither drifts nor overflows.
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
constexpr int batches_per_half = 20;

using Means = std::vector<glm::dvec3>;

/// Returns the sums over passes of primal, dx and dy, for each pixel and for all pixels together.
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

/// Returns the difference between the means of the first and the second half of the passes, in standard errors
/// estimated from batch means. It is the largest of all pixels, buffers and channels.
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
        for (int batch = 0; batch < batches_per_half; ++batch) {
            const int count = passes / (2 * batches_per_half);
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
    EXPECT_EQ(render.counters().invalid_samples, 0u);
    const auto variance_of_mean = [&](int half, std::size_t i, int c) {
        const double mean = sum[half][i][c] / batches_per_half;
        return (squares[half][i][c] / batches_per_half - mean * mean) / (batches_per_half - 1);
    };
    double largest = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double error = std::sqrt(variance_of_mean(0, i, c) + variance_of_mean(1, i, c));
            if (error > 0) // the last column and row have no gradients
                largest = std::max(largest, std::abs(sum[0][i][c] - sum[1][i][c]) / batches_per_half / error);
        }
    return largest;
}

// About 90 values differ from 0, and few are independent. With Student's t of 38 degrees of freedom, about one
// seed in a thousand exceeds the limit by chance.
constexpr double limit = 4.5;

TEST(LongRun, MeanDoesNotDrift) {
    EXPECT_LT(drift(2000), limit);
}

TEST(LongRun, SlowMeanOfManyPassesDoesNotDrift) {
    EXPECT_LT(drift(100'000), limit);
}

} // namespace

} // namespace tessera::test
