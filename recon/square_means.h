#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

#include <cstddef>
#include <functional>

namespace tessera {

/// The mean over the square of edge 2 radius + 1 around each pixel, as far as something is measured there: not
/// beyond the image, and not in its last `columns` and `rows`, where the result is 0, too. Sums are made anew for
/// each pixel, so that no rounding is left behind a bright one.
Image<float> square_means(const Image<float>& values, int radius, int columns, int rows,
                          const ParallelFor& parallel_for);

/// out[i] = sum over k < count of in[i + k step], for `size` numbers, by sums of 1, 2, 4 ... and of these as many
/// as it takes: many at a time, where running sums would go one by one, and would leave the rounding of a bright
/// pixel behind it.
/// @param in     size + (count - 1) step numbers, which are overwritten
/// @param count  1 or more
void sum_windows(float* in, std::size_t size, int count, std::size_t step, float* out);

/// Sums of the 2 radius + 1 rows around each row, a strip of columns at a time, which stays in the cache: calls
/// visit(y, begin, end, sums) for 0 <= y < height with those of the numbers [begin, end). By three additions a
/// number, whatever the radius: each sum is one up to the end of a block of as many rows, and one from there on
/// [van Herk 1992]. It is of its own rows alone, as with sum_windows.
/// @param width  of numbers in a row
/// @param row    row(j) of the rows -radius <= j < height + radius: where its numbers are; null: they are 0
void for_sums_of_rows(
    std::size_t width, int height, int radius, const std::function<const float*(int)>& row,
    const ParallelFor& parallel_for,
    const std::function<void(int y, std::size_t begin, std::size_t end, const float* sums)>& visit);

/// Puts the same of numbers that are not negative, and whose sums along a square's edge are finite, in their
/// place, at a cost that hardly depends on the radius: along rows by sum_windows, down columns by
/// for_sums_of_rows.
/// @param rows  of the same size: anything, and anything after
void take_wide_means(Image<float>& values, int radius, Image<float>& rows, const ParallelFor& parallel_for);

} // namespace tessera
