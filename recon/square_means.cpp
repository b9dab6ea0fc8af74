#include "recon/square_means.h"

#include <algorithm>
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

} // namespace tessera
