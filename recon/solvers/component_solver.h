#pragma once

#include "recon/image.h"
#include "recon/norm.h"
#include "recon/parallel.h"
#include "recon/solvers/poisson_direct.h"
#include "recon/solvers/poisson_weighted.h"

#include <cstdint>
#include <vector>

namespace tessera {

/// Reconstructs a coefficient E = sum of s^l E^l, theory (31), from all its components at once [Fang 2024, eq.
/// 19]: minimises the sum over the pixels of
///     sum over l of w_x^l |Dx E^l - dx^l|^2 + w_y^l |Dy E^l - dy^l|^2
///     + v_x |Dx E - dx|^2 + v_y |Dy E - dy|^2 + (alpha |E - primal|)^2 ,
/// where components have the unit of E (render/estimator/basis.h). With one component of projection 1, this is the
/// screened Poisson problem. (Eq. 19 divides the first row by the number of components, and has other units: its
/// lambda is alpha^2 4.75 / parts. For `weighted`, alpha is weighted_alpha().)
///   l2        w = 1, v = 0: linear in the data, up to the truncation error of conjugate gradients
///   mixed     lengths in place of the first row's squares, by reweighting [Fang 2024, 4]; v = 0
///   l1        the same as mixed, since [Fang 2024] squares the primal in L1
///   weighted  w and v from variances (weights_of_gradients): components count where they are smoother, and
///             gradients of the whole elsewhere. This replaces mixing finished pictures [Fang 2024, 3.3].
///
/// The method is conjugate gradients over all components, preconditioned by the direct solver for each [Concus and
/// Golub 1973]. It starts from each component's own solution.
class ComponentSolver {
public:
    /// @param width, height  >= 1
    ComponentSolver(int width, int height) : solver_(width, height) {}

    /// Returns the bytes of such a solver, used by so many threads.
    static std::uint64_t bytes(int width, int height, int components, int threads);

    /// Returns the number of components for which it has memory.
    int components() const { return static_cast<int>(components_.size()); }

    /// Writes E to `image`. Returns the number of inner solves over all components, or 0 if stopped between two of
    /// them. The result has the same bits for any parallel_for.
    /// @param images  with at least one component
    /// @param norm    l2, l1, mixed or weighted
    /// @param alpha   > 0
    int solve(const GradientImages& images, Norm norm, float alpha, RgbImage& image,
              const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

private:
    struct Component {
        RgbImage image, residual, solved, applied, direction, applied_step;
        EdgeWeights weights;
    };

    void make_room(int components);
    void start(const GradientImages& images, float alpha, const ParallelFor& parallel_for);
    void weigh(const GradientImages& images, float alpha, const ParallelFor& parallel_for);
    void reweigh(const GradientImages& images, float unit, const ParallelFor& parallel_for);
    void sum(const GradientImages& images, RgbImage Component::* summand, const ParallelFor& parallel_for);
    void find_residual(const GradientImages& images, float alpha, const ParallelFor& parallel_for);
    bool descend(const GradientImages& images, float alpha, int iterations, const ParallelFor& parallel_for,
                 const SolveWatch& watch);

    PoissonSolver solver_;
    std::vector<Component> components_;
    EdgeWeights whole_;      ///< v; empty: 0
    RgbImage sum_;           ///< sum of projections times one image of each component
    RgbImage of_whole_;      ///< terms of E in the normal equations, before multiplication by a projection
    int done_ = 0, all_ = 0; ///< inner solves
};

} // namespace tessera
