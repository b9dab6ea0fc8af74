// Means over kernels against their definition.
#include "recon/guided/kernel_sums.h"
#include "tests/recon/test_images.h"

#include <array>
#include <cstdint>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

Plane plane_of(int width, int height, std::uint32_t seed) {
    const RgbImage image = random_image(width, height, seed, 1, 0.2f);
    Plane plane(width, height);
    for (std::size_t i = 0; i < image.size(); ++i)
        plane.data()[i] = image.data()[i].g;
    return plane;
}

/// Returns random weights of all pairs, also of pairs that reach beyond the picture.
PairWeights random_weights(int width, int height) {
    PairWeights weights;
    std::mt19937 numbers(10);
    for (Image<PairWeight>& plane : weights) {
        plane = Image<PairWeight>(width, height);
        for (PairWeight& weight : plane)
            weight = static_cast<PairWeight>(numbers() % 256);
    }
    return weights;
}

/// Returns the mean around (x, y), by its definition.
double mean_around(const Plane& plane, const PairWeights& weights, int step, int x, int y) {
    double all = static_cast<double>(KernelPair{0, 0}.share()), sum = all * static_cast<double>(plane(x, y));
    for (std::size_t k = 0; k < weights.size(); ++k)
        for (const int sign : {1, -1}) {
            const int i = x + sign * step * kernel_pairs[k].i, j = y + sign * step * kernel_pairs[k].j;
            if (i < 0 || i >= plane.width() || j < 0 || j >= plane.height())
                continue;
            const double weight = static_cast<double>(kernel_pairs[k].share()) / 255 *
                                  (sign > 0 ? weights[k](x, y) : weights[k](i, j));
            all += weight;
            sum += weight * static_cast<double>(plane(i, j));
        }
    return sum / all;
}

TEST(KernelSums, EqualTheirDefinition) {
    for (const auto& [width, height, step] : {std::tuple{1, 1, 1},
                                              {5, 3, 1},
                                              {16, 9, 3},
                                              {300, 7, 2},
                                              {527, 40, 9},
                                              {256, 11, 81},
                                              {140, 130, 27},
                                              {1100, 5, 81},
                                              {1031, 60, 27}}) {
        const std::array from{plane_of(width, height, 1), plane_of(width, height, 2)};
        const PairWeights weights = random_weights(width, height);
        std::array<Plane, 2> means;
        make_planes(means, width, height);
        write_kernel_means(from, weights, step, serial_for, means);
        for (std::size_t c = 0; c < from.size(); ++c)
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    ASSERT_NEAR(means[c](x, y), mean_around(from[c], weights, step, x, y), 1e-6)
                        << width << 'x' << height << ' ' << step << ": " << x << ',' << y;
    }
}

} // namespace

} // namespace tessera::test
