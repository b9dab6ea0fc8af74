#pragma once

#include "recon/parallel.h"
#include "recon/solvers/poisson_direct.h"

#include <cstdint>

namespace tessera {

/// What an L1 solve minimises, and for how long.
struct L1Settings {
    bool square_primal = false; ///< mixed norms: the primal's misfit is squared, which keeps its mean
    int cold_iterations = 25; ///< inner solves of a first start, >= 1
    int warm_iterations = 5;  ///< of a warm start, >= 1
};

/// Typical value of an image: the median over its lit pixels of their largest channel, from some thousand pixels;
/// a scale that an outlier does not move. 1 for a black image.
float typical_value(const RgbImage& image);

/// The screened Poisson problem with lengths of colours for squares, so that the channels agree on outliers.
/// Minimises the sum over the pixels of
///     |Dx I - dx| + |Dy I - dy| + alpha |I - primal| ,
/// or with (alpha |I - primal|)^2 / typical_value(primal) for the last (square_primal), whose unit is then that of
/// the others. A cold start comes within 1 % of the least sum in the default iterations.
///
/// This is done by the alternating direction method of multipliers [Boyd et al. 2011, 3 and 6.1]. With K = (Dx,
/// Dy, 1) and g = (dx, dy, primal), the answer's K I is split off as d with the (scaled) dual variable u, and in
/// turn
///     I = argmin |W (K I - d + u)|^2,   d = argmin |d - g| / rho + |W (K I + u - d)|^2 / 2,   u = u + K I - d ,
/// W = (1, 1, beta). The first is the screened Poisson problem. For the second and third let q = K I + u: then u
/// is q - g cut to the length t = 1 / rho (of a square: times a number below 1), and d = q - u. So q is all there
/// is to keep. Where d follows K I, g does not enter in it, and outliers of any size leave no rounding behind.
///
/// An object keeps q - g: the next solve of similar data starts where the last one ended (a warm start).
class L1Solver {
public:
    /// `width` and `height` are >= 1.
    L1Solver(int width, int height);

    /// The memory that such a solver takes, if it works on so many threads.
    static std::uint64_t bytes(int width, int height, int threads);

    /// Writes the answer to `image`, which is none of the problem's; returns the number of inner solves, 0 if
    /// stopped, which is looked at between them. The same bits for any parallel_for. Allocates images in the first
    /// call only.
    int solve(const PoissonProblem& problem, const L1Settings& settings, RgbImage& image,
              const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

    /// The next solve starts from nothing: right for data unlike the last.
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
    RgbImage borders_;          ///< row b: what the last row of band b adds to the right side of the next band
    float threshold_ = 0;       ///< t of q; 0: there is none yet
};

} // namespace tessera
