#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

#include <cstdint>
#include <vector>

namespace tessera {

struct EdgeWeights;

/// Approximate inverse of A = alpha^2 + Dx^T w_x Dx + Dy^T w_y Dy (WeightedSolver): one V-cycle of multigrid. It
/// is linear, symmetric and positive definite, as a preconditioner of conjugate gradients must be.
///
/// A cell of the next level is 2x2 cells of this one (fewer at the border), down to a single cell. Its screening
/// is the sum of theirs. Two edges of this level join two cells. Their sum is the weight of the Galerkin matrix
/// P^T A P for values that are constant in each cell (aggregation [Braess 1995]). Where weights are constant, it
/// is twice too stiff, as centres of cells are twice as far apart; half of it is too soft where weights jump. The
/// solver uses three quarters.
///
/// Each level has one step of Jacobi's method, x += s (b - A x) with s = 0.9 over the diagonal, before and after
/// the correction from the next level. It converges, as no eigenvalue of A over its diagonal is above 2.
class WeightedMultigrid {
public:
    /// @param width, height  >= 1
    WeightedMultigrid(int width, int height);
    ~WeightedMultigrid();

    WeightedMultigrid(const WeightedMultigrid&) = delete;
    WeightedMultigrid& operator=(const WeightedMultigrid&) = delete;

    /// Returns the bytes that it takes, used by so many threads.
    static std::uint64_t bytes(int width, int height, int threads);

    /// Builds the levels of a matrix. Keeps a reference to `weights` for calls of apply().
    void prepare(const EdgeWeights& weights, float alpha, const ParallelFor& parallel_for = serial_for);

    /// Sets z to about A^-1 r. The result has the same bits for any parallel_for.
    void apply(const RgbImage& r, RgbImage& z, const ParallelFor& parallel_for = serial_for);

private:
    struct Level;

    std::vector<Level> levels_;
};

} // namespace tessera
