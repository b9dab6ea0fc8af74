#pragma once

#include "recon/parallel.h"
#include "recon/solvers/poisson_direct.h"

#include <cstdint>

namespace tessera {

/// Norm and numbers of iterations of an L1 solve.
struct L1Settings {
    bool square_primal = false; ///< reconstruction (35): the primal's misfit is squared, which keeps its mean
    int cold_iterations = 25;   ///< inner solves of a cold start, >= 1
    int warm_iterations = 5;    ///< inner solves of a warm start, >= 1
};

/// Returns a typical value of an image: the median over its lit pixels of their largest channel, from some
/// thousand pixels. Outliers hardly change it. Returns 1 for a black image.
float typical_value(const RgbImage& image);

/// The screened Poisson problem with lengths of colours, so that the channels agree on outliers, reconstruction
/// (34). Minimises the sum over the pixels of
///     |Dx I - dx| + |Dy I - dy| + alpha |I - primal| ,
/// or, with square_primal, with (alpha |I - primal|)^2 / typical_value(primal) as last term, which has the same
/// unit, reconstruction (35).
///
/// The method is the alternating direction method of multipliers [Boyd et al. 2011, 3 and 6.1]. Let K = (Dx, Dy,
/// 1) and g = (dx, dy, primal). K I is split off as d, with the scaled dual variable u, and in turn
///     I = argmin |W (K I - d + u)|^2,   d = argmin |d - g| / rho + |W (K I + u - d)|^2 / 2,   u = u + K I - d ,
/// W = (1, 1, beta). The first is the screened Poisson problem. For the second and third let q = K I + u: then u
/// is q - g clamped to the length t = 1 / rho (for a square: times a number below 1), and d = q - u. Only q is
/// kept. Where d = K I, g cancels, so that outliers of any size leave no rounding error.
///
/// The solver keeps q - g: the next solve of similar data starts where the last one ended (a warm start).
class L1Solver {
public:
    /// @param width, height  >= 1
    L1Solver(int width, int height);

    /// Returns the bytes of such a solver, used by so many threads.
    static std::uint64_t bytes(int width, int height, int threads);

    /// Writes the solution to `image`, which must not be an image of the problem. Returns the number of inner
    /// solves, or 0 if stopped between two of them. The result has the same bits for any parallel_for. Allocates
    /// images in the first call only.
    int solve(const PoissonProblem& problem, const L1Settings& settings, RgbImage& image,
              const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

    /// Makes the next solve start cold, for data that differ from the last.
    void forget() { threshold_ = 0; }

private:
    struct Step;

    void start(const PoissonProblem& problem, float scale, RgbImage& image, const ParallelFor& parallel_for);
    void iterate(const PoissonProblem& problem, const Step& step, RgbImage& image,
                 const ParallelFor& parallel_for);
    void update_band(const PoissonProblem& problem, const Step& step, const RgbImage& image, int band);
    void update_row(const PoissonProblem& problem, const Step& step, const RgbImage& image, int y, float* below);

    PoissonSolver solver_;
    RgbImage primal_, dx_, dy_; ///< q of the three terms; q - g between solves
    RgbImage right_side_;       ///< of the inner problem
    RgbImage borders_;          ///< row b: contribution of band b's last row to the right side of the next band
    float threshold_ = 0;       ///< t of q; 0: q is unset
};

} // namespace tessera
