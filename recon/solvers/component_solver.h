#pragma once

#include "recon/image.h"
#include "recon/parallel.h"
#include "recon/norm.h"
#include "recon/solvers/poisson_direct.h"
#include "recon/solvers/poisson_weighted.h"

#include <cstdint>
#include <vector>

namespace tessera {

/// Reconstructs a coefficient E = sum of s^l E^l from its parts, all of them at once [Fang 2024, eq. 19]:
/// minimises the sum over the pixels of
///     sum over l of w_x^l |Dx E^l - dx^l|^2 + w_y^l |Dy E^l - dy^l|^2
///     + v_x |Dx E - dx|^2 + v_y |Dy E - dy|^2 + (alpha |E - primal|)^2 ,
/// where parts have the unit of E (render/estimator/basis.h), so that with one part of projection 1 this is the
/// screened Poisson problem. (Eq. 19 divides the first row by the number of parts, and has other units: its lambda
/// is alpha^2 4.75 / parts. For `weighted`, alpha is weighted_alpha().)
///   l2        w = 1, v = 0: linear in the data, but for what a last step of conjugate gradients would add, a
///             thousandth of the error
///   mixed     lengths in place of the first row's squares, by reweighting [Fang 2024, 4]; v = 0
///   l1        the same: what is called L1 there has the primal squared
///   weighted  w and v from variances, as control variates have them (weights_of_gradients): parts count where
///             they are the smoother ones, the gradients of the whole where these are. That takes the place of
///             mixing finished pictures [Fang 2024, 3.3].
///
/// Conjugate gradients over all parts, preconditioned by the direct solver for each [Concus and Golub 1973].
/// The start is each part by itself.
class ComponentSolver {
public:
    /// `width` and `height` are >= 1.
    ComponentSolver(int width, int height) : solver_(width, height) {}

    /// The memory that such a solver takes, if it works on so many threads.
    static std::uint64_t bytes(int width, int height, int parts, int threads);

    /// Of how many parts it has memory already.
    int parts() const { return static_cast<int>(parts_.size()); }

    /// Writes E to `image`; returns the number of inner solves over all parts, 0 if stopped, which is looked at
    /// between them. The same bits for any parallel_for.
    /// @param images  with one part at least
    /// @param norm    l2, l1, mixed or weighted
    /// @param alpha   > 0
    int solve(const GradientImages& images, Norm norm, float alpha, RgbImage& image,
              const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

private:
    struct Part {
        RgbImage image, residual, solved, applied, direction, applied_step;
        EdgeWeights weights;
    };

    void make_room(int parts);
    void start(const GradientImages& images, float alpha, const ParallelFor& parallel_for);
    void weigh(const GradientImages& images, float alpha, const ParallelFor& parallel_for);
    void reweigh(const GradientImages& images, float unit, const ParallelFor& parallel_for);
    void sum(const GradientImages& images, RgbImage Part::*summand, const ParallelFor& parallel_for);
    void find_residual(const GradientImages& images, float alpha, const ParallelFor& parallel_for);
    bool descend(const GradientImages& images, float alpha, int iterations, const ParallelFor& parallel_for,
                 const SolveWatch& watch);

    PoissonSolver solver_;
    std::vector<Part> parts_;
    EdgeWeights whole_;      ///< v; empty: 0
    RgbImage sum_;           ///< of the parts at hand, times their projections
    RgbImage of_whole_;      ///< what the terms of E make of that, alike for all parts but for their projections
    int done_ = 0, all_ = 0; ///< inner solves
};

} // namespace tessera
