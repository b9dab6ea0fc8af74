#include "recon/square_means.h"

#include <algorithm>
#include <array>
#include <vector>

namespace tessera {

Image<float> square_means(const Image<float>& values, int radius, int columns, int rows,
                          const ParallelFor& parallel_for) {
    const int width = values.width() - columns, height = values.height() - rows;
    Image<float> means(values.width(), values.height());
    parallel_for(height, [&](int y) {
        std::vector<float> sums(static_cast<std::size_t>(width)); // sums of the columns of the squares
        const int top = std::max(y - radius, 0), bottom = std::min(y + radius, height - 1);
        for (int row = top; row <= bottom; ++row)
            for (int x = 0; x < width; ++x)
                sums[x] += values(x, row);
        for (int x = 0; x < width; ++x) {
            const int left = std::max(x - radius, 0), right = std::min(x + radius, width - 1);
            float sum = 0;
            for (int i = left; i <= right; ++i)
                sum += sums[i];
            means(x, y) = sum / static_cast<float>((right - left + 1) * (bottom - top + 1));
        }
    });
    return means;
}

namespace {

/// Means along each row. Sums from the left on, in double, have no rounding that would be seen.
void write_row_means(const Image<float>& values, int radius, const ParallelFor& parallel_for,
                     Image<float>& means) {
    const int width = values.width();
    parallel_for(values.height(), [&](int y) {
        std::vector<double> sums(static_cast<std::size_t>(width) + 1);
        for (int x = 0; x < width; ++x)
            sums[static_cast<std::size_t>(x) + 1] =
                sums[static_cast<std::size_t>(x)] + static_cast<double>(values(x, y));
        for (int x = 0; x < width; ++x) {
            const int left = std::max(x - radius, 0), end = std::min(x + radius + 1, width);
            means(x, y) = static_cast<float>(
                (sums[static_cast<std::size_t>(end)] - sums[static_cast<std::size_t>(left)]) / (end - left));
        }
    });
}

} // namespace

void take_wide_means(Image<float>& values, int radius, Image<float>& rows, const ParallelFor& parallel_for) {
    constexpr int strip = 64; // columns
    const int width = values.width(), height = values.height();
    write_row_means(values, radius, parallel_for, rows);
    parallel_for((width + strip - 1) / strip, [&](int s) {
        const int begin = s * strip, end = std::min(begin + strip, width);
        std::array<double, strip> sums{};
        const auto add = [&](int y, double sign) {
            const float* row = rows.row(y) + begin;
            for (int i = 0; i < end - begin; ++i)
                sums[static_cast<std::size_t>(i)] += sign * static_cast<double>(row[i]);
        };
        for (int y = 0; y < std::min(radius, height); ++y)
            add(y, 1);
        for (int y = 0; y < height; ++y) {
            if (y + radius < height)
                add(y + radius, 1);
            if (y > radius)
                add(y - radius - 1, -1);
            const int count = std::min(y + radius, height - 1) - std::max(y - radius, 0) + 1;
            for (int i = 0; i < end - begin; ++i)
                values(begin + i, y) =
                    static_cast<float>(std::max(sums[static_cast<std::size_t>(i)], 0.0) / count);
        }
    });
}

} // namespace tessera
