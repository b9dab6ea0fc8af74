#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

#include <cstddef>
#include <functional>

namespace tessera {

/// Returns the mean over the square of edge 2 radius + 1 around each pixel. Squares are cut off at the borders of
/// the image and of its last `columns` and `rows`, which hold no values; there the result is 0. Each pixel's sum
/// is made independently, so that a bright pixel leaves no rounding error in later sums.
Image<float> square_means(const Image<float>& values, int radius, int columns, int rows,
                          const ParallelFor& parallel_for);

/// Sets out[i] to the sum over k < count of in[i + k step], for `size` numbers. Sums of 1, 2, 4, ... numbers are
/// combined, which vectorises; a running sum would not, and would keep the rounding error of a bright pixel.
/// @param in     size + (count - 1) step numbers; overwritten
/// @param count  1 or more
void sum_windows(float* in, std::size_t size, int count, std::size_t step, float* out);

/// Sums the 2 radius + 1 rows around each row, and calls visit(y, begin, end, sums) for 0 <= y < height with the
/// sums of columns [begin, end). It works on strips of columns that fit the cache. Each sum takes three additions
/// for any radius: it joins a sum up to the end of a block of rows and a sum from there on [van Herk 1992]. Each
/// sum depends on its own rows alone.
/// @param width  numbers in a row
/// @param row    row(j) for -radius <= j < height + radius: the numbers of row j; null: zeros
void for_sums_of_rows(
    std::size_t width, int height, int radius, const std::function<const float*(int)>& row,
    const ParallelFor& parallel_for,
    const std::function<void(int y, std::size_t begin, std::size_t end, const float* sums)>& visit);

/// Replaces values by their means over squares, as square_means() without excluded columns and rows. The cost
/// hardly depends on the radius. Values must be >= 0 and their sums along a square's edge finite.
/// @param rows  scratch image of the same size, any content
void take_wide_means(Image<float>& values, int radius, Image<float>& rows, const ParallelFor& parallel_for);

} // namespace tessera
