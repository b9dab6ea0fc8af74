// Parallel loops over the pixels of images. The results have the same bits for any ParallelFor.
#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace tessera {

/// Calls visit(i) for all pixels of a picture, with i = y width + x.
template <class Visit>
void for_pixels(int width, int height, const ParallelFor& parallel_for, Visit&& visit) {
    parallel_for(height, [&](int y) {
        for (std::size_t i = static_cast<std::size_t>(y) * width, end = i + width; i < end; ++i)
            visit(i);
    });
}

/// Returns the sum of term(i) over all pixels. Each row has eight independent sums, which the compiler vectorises;
/// then the rows are added in order.
template <class Term>
double sum_over_pixels(int width, int height, const ParallelFor& parallel_for, Term&& term) {
    std::vector<double> rows(static_cast<std::size_t>(height));
    parallel_for(height, [&](int y) {
        constexpr std::size_t side_by_side = 8;
        double sums[side_by_side] = {};
        std::size_t i = static_cast<std::size_t>(y) * width;
        const std::size_t end = i + width;
        for (; i + side_by_side <= end; i += side_by_side)
            for (std::size_t k = 0; k < side_by_side; ++k)
                sums[k] += static_cast<double>(term(i + k));
        for (; i < end; ++i)
            sums[0] += static_cast<double>(term(i));
        rows[static_cast<std::size_t>(y)] = std::accumulate(sums, sums + side_by_side, 0.0);
    });
    return std::accumulate(rows.begin(), rows.end(), 0.0);
}

/// Returns an image of one value, filled in parallel.
template <class Pixel>
Image<Pixel> filled_image(int width, int height, Pixel value, const ParallelFor& parallel_for) {
    Image<Pixel> image(width, height, Unfilled());
    parallel_for(height, [&](int y) { std::fill_n(image.row(y), width, value); });
    return image;
}

/// Returns a copy, made in parallel.
template <class Pixel>
Image<Pixel> copy_of(const Image<Pixel>& image, const ParallelFor& parallel_for) {
    Image<Pixel> copy(image.width(), image.height(), Unfilled());
    parallel_for(image.height(), [&](int y) { std::copy_n(image.row(y), image.width(), copy.row(y)); });
    return copy;
}

} // namespace tessera
