#include "recon/square_means.h"

#include <algorithm>
#include <vector>

namespace tessera {

Image<float> square_means(const Image<float>& values, int radius, int columns, int rows,
                          const ParallelFor& parallel_for) {
    const int width = values.width() - columns, height = values.height() - rows;
    Image<float> means(values.width(), values.height(), Unfilled());
    parallel_for(values.height(), [&](int y) {
        std::fill_n(means.row(y), values.width(), 0.0f);
        if (y >= height)
            return;
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
    std::size_t numbers = size + static_cast<std::size_t>(count - 1) * step, offset = 0;
    for (bool is_first = true;; count /= 2, step *= 2) {
        if (count % 2 == 1) {
            if (is_first)
                std::copy_n(in, size, out);
            else
                for (std::size_t i = 0; i < size; ++i)
                    out[i] += in[offset + i];
            is_first = false;
            offset += step;
        }
        if (count == 1)
            return;
        numbers -= step;
        for (std::size_t i = 0; i < numbers; ++i)
            in[i] += in[i + step];
    }
}

namespace {

/// Does the same as for_sums_of_rows() for one strip: calls visit(y, sums).
template <class Row, class Visit>
void for_sums_of_strip(std::size_t width, int height, int radius, Row&& row, Visit&& visit) {
    const int count = 2 * radius + 1;
    PixelVector<float> suffix_sums(static_cast<std::size_t>(count + 1) * width), prefix_sum(width);
    const auto suffix_sum = [&](int k) { return suffix_sums.data() + static_cast<std::size_t>(k) * width; };
    std::fill_n(suffix_sum(count), width, 0.0f);
    for (int first = 0; first < height; first += count) {
        for (int k = count - 1; k >= 0; --k) {
            const float *added = row(first + k - radius), *next = suffix_sum(k + 1);
            float* sums = suffix_sum(k);
            if (added == nullptr)
                std::copy_n(next, width, sums);
            else
                for (std::size_t i = 0; i < width; ++i)
                    sums[i] = next[i] + added[i];
        }
        visit(first, suffix_sum(0));
        std::fill(prefix_sum.begin(), prefix_sum.end(), 0.0f);
        for (int k = 1; k < std::min(count, height - first); ++k) {
            float *sums = suffix_sum(k), *prefix = prefix_sum.data();
            if (const float* added = row(first + k + radius))
                for (std::size_t i = 0; i < width; ++i)
                    prefix[i] += added[i];
            for (std::size_t i = 0; i < width; ++i)
                sums[i] += prefix[i];
            visit(first + k, sums);
        }
    }
}

} // namespace

void for_sums_of_rows(std::size_t width, int height, int radius, const std::function<const float*(int)>& row,
                      const ParallelFor& parallel_for,
                      const std::function<void(int, std::size_t, std::size_t, const float*)>& visit) {
    constexpr std::size_t strip = 64;
    parallel_for(static_cast<int>((width + strip - 1) / strip), [&](int s) {
        const std::size_t begin = static_cast<std::size_t>(s) * strip, end = std::min(begin + strip, width);
        const auto part_of_row = [&](int y) {
            const float* numbers = row(y);
            return numbers == nullptr ? nullptr : numbers + begin;
        };
        for_sums_of_strip(end - begin, height, radius, part_of_row,
                          [&](int y, const float* sums) { visit(y, begin, end, sums); });
    });
}

namespace {

/// Writes means along each row over the columns within the radius.
void write_row_means(const Image<float>& values, int radius, const ParallelFor& parallel_for,
                     Image<float>& means) {
    const int width = values.width(), reach = std::min(radius, width - 1);
    parallel_for(values.height(), [&](int y) {
        PixelVector<float> padded(static_cast<std::size_t>(width + 2 * reach));
        std::fill_n(padded.begin(), reach, 0.0f);
        std::copy_n(values.row(y), width, padded.begin() + reach);
        std::fill_n(padded.end() - reach, reach, 0.0f);
        float* row = means.row(y);
        sum_windows(padded.data(), static_cast<std::size_t>(width), 2 * reach + 1, 1, row);
        for (int x = 0; x < width; ++x)
            row[x] /= static_cast<float>(std::min(x + reach, width - 1) - std::max(x - reach, 0) + 1);
    });
}

} // namespace

void take_wide_means(Image<float>& values, int radius, Image<float>& rows, const ParallelFor& parallel_for) {
    const int height = values.height(), reach = std::min(radius, height - 1);
    write_row_means(values, radius, parallel_for, rows);
    const auto row = [&](int y) { return y < 0 || y >= height ? nullptr : rows.row(y); };
    for_sums_of_rows(static_cast<std::size_t>(values.width()), height, reach, row, parallel_for,
                     [&](int y, std::size_t begin, std::size_t end, const float* sums) {
                         const int count = std::min(y + reach, height - 1) - std::max(y - reach, 0) + 1;
                         const float share = 1 / static_cast<float>(count);
                         for (std::size_t i = begin; i < end; ++i)
                             values.row(y)[i] = share * sums[i - begin];
                     });
}

} // namespace tessera
