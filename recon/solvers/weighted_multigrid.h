#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

#include <cstdint>
#include <vector>

namespace tessera {

struct EdgeWeights;

/// About the inverse of A = alpha^2 + Dx^T w_x Dx + Dy^T w_y Dy (WeightedSolver): one V-cycle of multigrid,
/// linear, symmetric and positive definite, as what preconditions conjugate gradients has to be.
///
/// A cell of the next level is 2x2 of this one, as far as there are so many, down to a single cell. Its screening
/// is the sum of theirs. Between two cells lie two edges of this level; their sum would be the weight of
/// Galerkin's matrix P^T A P for values that are even in each cell (aggregation [Braess 1995]), which is twice too
/// stiff where weights are even, as centres of cells are twice as far apart; and half of it too soft where weights
/// jump. In between are three quarters.
///
/// On each level, before and after the correction from the next, a step of Jacobi's method: x += s (b - A x) with
/// s = 0.9 over the diagonal. No eigenvalue of A over its diagonal is above 2, so that this converges.
class WeightedMultigrid {
public:
    /// `width` and `height` are >= 1.
    WeightedMultigrid(int width, int height);
    ~WeightedMultigrid();

    WeightedMultigrid(const WeightedMultigrid&) = delete;
    WeightedMultigrid& operator=(const WeightedMultigrid&) = delete;

    /// The memory that it takes, if it works on so many threads.
    static std::uint64_t bytes(int width, int height, int threads);

    /// Makes the levels of a matrix. Keeps a reference to `weights`, for the next calls of apply().
    void prepare(const EdgeWeights& weights, float alpha, const ParallelFor& parallel_for = serial_for);

    /// Makes z about A^-1 r. The same bits for any parallel_for.
    void apply(const RgbImage& r, RgbImage& z, const ParallelFor& parallel_for = serial_for);

private:
    struct Level;

    std::vector<Level> levels_;
};

} // namespace tessera
