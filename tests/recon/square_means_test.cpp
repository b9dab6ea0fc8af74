// Means over squares against their definition.
#include "recon/square_means.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

Image<float> random_numbers(int width, int height) {
    const RgbImage image = random_image(width, height, 5, 0, 2);
    Image<float> numbers(width, height);
    for (std::size_t i = 0; i < image.size(); ++i)
        numbers.data()[i] = std::exp(image.data()[i].g);
    return numbers;
}

double mean_around(const Image<float>& values, int radius, int x, int y) {
    double sum = 0, count = 0;
    for (int j = std::max(y - radius, 0); j <= std::min(y + radius, values.height() - 1); ++j)
        for (int i = std::max(x - radius, 0); i <= std::min(x + radius, values.width() - 1); ++i, ++count)
            sum += static_cast<double>(values(i, j));
    return sum / count;
}

TEST(SquareMeans, WideMeansEqualTheirDefinition) {
    for (const auto& [width, height] : {std::pair(83, 21), std::pair(5, 90), std::pair(1, 1)})
        for (int radius : {0, 1, 2, 6, 38, 200}) {
            const Image<float> values = random_numbers(width, height);
            Image<float> means = values, rows(width, height);
            take_wide_means(means, radius, rows, serial_for);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    const double mean = mean_around(values, radius, x, y);
                    ASSERT_NEAR(means(x, y), mean, 1e-5 * mean) << radius << ": " << x << ',' << y;
                }
        }
}

/// Running sums must leave no rounding error of a pixel 10^9 times as bright outside of its squares.
TEST(SquareMeans, WideMeansForgetABrightPixel) {
    Image<float> values(64, 64), rows(64, 64);
    std::fill(values.begin(), values.end(), 1.0f);
    values(20, 20) = 1e9f;
    take_wide_means(values, 3, rows, serial_for);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            if (std::max(std::abs(x - 20), std::abs(y - 20)) > 3) {
                ASSERT_NEAR(values(x, y), 1, 1e-5) << x << ',' << y;
            }
}

/// The same for a value so large that 1 is lost beside it in double precision.
TEST(SquareMeans, WideMeansForgetHugeNumbers) {
    Image<float> values(40, 90), rows(40, 90);
    std::fill(values.begin(), values.end(), 1.0f);
    values(20, 45) = 1e36f;
    take_wide_means(values, 6, rows, serial_for);
    EXPECT_GT(values(20, 45), 1e33f);
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 40; ++x)
            if (std::max(std::abs(x - 20), std::abs(y - 45)) > 6) {
                ASSERT_NEAR(values(x, y), 1, 1e-5) << x << ',' << y;
            }
}

TEST(SquareMeans, SumsOfRowsEqualTheirDefinition) {
    for (const std::size_t width : {1u, 5u, 64u, 130u}) // one strip, and several
        for (const int height : {1, 2, 7, 30})
            for (const int radius : {0, 1, 3, 12}) {
                std::vector<float> numbers(width * static_cast<std::size_t>(height + 2 * radius));
                for (std::size_t i = 0; i < numbers.size(); ++i)
                    numbers[i] = static_cast<float>(i * i % 13);
                const auto row = [&](int j) -> const float* { // every fifth row is missing
                    EXPECT_TRUE(j >= -radius && j < height + radius) << j;
                    return (j + 5 * radius) % 5 == 2
                               ? nullptr
                               : numbers.data() + width * static_cast<std::size_t>(j + radius);
                };
                std::vector<int> visits(width * static_cast<std::size_t>(height));
                for_sums_of_rows(width, height, radius, row, serial_for,
                                 [&](int y, std::size_t begin, std::size_t end, const float* sums) {
                                     for (std::size_t i = begin; i < end; ++i) {
                                         ++visits[static_cast<std::size_t>(y) * width + i];
                                         float sum = 0;
                                         for (int j = y - radius; j <= y + radius; ++j)
                                             sum += row(j) ? row(j)[i] : 0;
                                         ASSERT_EQ(sums[i - begin], sum) << height << ' ' << radius << ' ' << y;
                                     }
                                 });
                EXPECT_EQ(std::ranges::count(visits, 1), std::ssize(visits));
            }
}

TEST(SquareMeans, WindowsAreSumsOfStridedValues) {
    for (int count : {1, 2, 3, 7, 12, 13})
        for (std::size_t step : {1u, 3u}) {
            const std::size_t size = 17;
            std::vector<float> in(size + static_cast<std::size_t>(count - 1) * step), sums(size);
            for (std::size_t i = 0; i < in.size(); ++i)
                in[i] = static_cast<float>(i * i % 11);
            const std::vector<float> before = in;
            sum_windows(in.data(), size, count, step, sums.data());
            for (std::size_t i = 0; i < size; ++i) {
                float sum = 0;
                for (int k = 0; k < count; ++k)
                    sum += before[i + static_cast<std::size_t>(k) * step];
                ASSERT_EQ(sums[i], sum) << count << ' ' << step << ' ' << i;
            }
        }
}

} // namespace

} // namespace tessera::test
