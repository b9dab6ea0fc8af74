#pragma once

#include "recon/solvers/poisson_problem.h"
#include "recon/solvers/poisson_weighted.h"

#include <vector>

#include <Eigen/Sparse>

namespace tessera::test {

/// Solves a screened Poisson problem in double precision with a sparse Cholesky factorisation.
/// @param weights  of gradients; null: all 1
inline RgbImage solve_sparse(const PoissonProblem& p, const EdgeWeights* weights = nullptr) {
    const int width = p.primal.width(), height = p.primal.height(), count = width * height;
    const double alpha_squared = static_cast<double>(p.alpha) * p.alpha;
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd right_side(count, 3);
    for (int i = 0; i < count; ++i) {
        entries.emplace_back(i, i, alpha_squared);
        for (int c = 0; c < 3; ++c)
            right_side(i, c) = alpha_squared * p.primal.data()[i][c];
    }
    const auto link = [&](int i, int j, Rgb difference, double weight) {
        entries.emplace_back(i, i, weight);
        entries.emplace_back(j, j, weight);
        entries.emplace_back(i, j, -weight);
        entries.emplace_back(j, i, -weight);
        for (int c = 0; c < 3; ++c) {
            right_side(i, c) -= weight * difference[c];
            right_side(j, c) += weight * difference[c];
        }
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int i = y * width + x;
            if (x + 1 < width)
                link(i, i + 1, p.dx(x, y), weights ? weights->x(x, y) : 1);
            if (y + 1 < height)
                link(i, i + width, p.dy(x, y), weights ? weights->y(x, y) : 1);
        }
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factorised(matrix);
    const Eigen::MatrixXd answer = factorised.solve(right_side);
    RgbImage image(width, height);
    for (int i = 0; i < count; ++i)
        image.data()[i] = {answer(i, 0), answer(i, 1), answer(i, 2)};
    return image;
}

} // namespace tessera::test
