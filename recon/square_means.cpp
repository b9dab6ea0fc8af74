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

void sum_windows(float* in, std::size_t size, int count, std::size_t step, float* out) {
    std::fill_n(out, size, 0.0f);
    std::size_t numbers = size + static_cast<std::size_t>(count - 1) * step, from = 0;
    for (;; count /= 2, step *= 2) {
        if (count % 2 == 1) {
            for (std::size_t i = 0; i < size; ++i)
                out[i] += in[from + i];
            from += step;
        }
        if (count == 1)
            return;
        numbers -= step;
        for (std::size_t i = 0; i < numbers; ++i)
            in[i] += in[i + step];
    }
}

namespace {

/// Means along each row, as far as there is one.
void write_row_means(const Image<float>& values, int radius, const ParallelFor& parallel_for,
                     Image<float>& means) {
    const int width = values.width(), reach = std::min(radius, width - 1);
    parallel_for(values.height(), [&](int y) {
        std::vector<float> padded(static_cast<std::size_t>(width + 2 * reach));
        std::copy_n(values.row(y), width, padded.begin() + reach);
        float* row = means.row(y);
        sum_windows(padded.data(), static_cast<std::size_t>(width), 2 * reach + 1, 1, row);
        for (int x = 0; x < width; ++x)
            row[x] /= static_cast<float>(std::min(x + reach, width - 1) - std::max(x - reach, 0) + 1);
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
