#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

#include <vector>

namespace tessera {

/// The screened Poisson problem, reconstruction (33): the image I that minimises
///     |Dx I - dx|^2 + |Dy I - dy|^2 + (alpha |I - primal|)^2 ,
/// where Dx and Dy are forward differences inside the image. All images have one size, at least 1 by 1. The last
/// column of dx and the last row of dy are not read. Its normal equations are A I = b with
///     A = alpha^2 + Dx^T Dx + Dy^T Dy,  b = alpha^2 primal + Dx^T dx + Dy^T dy .
struct PoissonProblem {
    const RgbImage& primal;
    const RgbImage& dx;
    const RgbImage& dy;
    float alpha; ///< > 0
};

/// Writes pixels [begin, end) of row y of b to out, 3 values a pixel.
void poisson_right_side(const PoissonProblem& problem, int y, int begin, int end, float* out);

/// Writes pixels [begin, end) of row y of b - A image, computed in double, to out, 3 values a pixel.
void poisson_defect(const PoissonProblem& problem, const RgbImage& image, int y, int begin, int end, float* out);

/// Returns |b - A image| / |b|, or 0 if the numerator is 0.
double poisson_residual(const PoissonProblem& problem, const RgbImage& image,
                        const ParallelFor& parallel_for = serial_for);

/// Adapts a solver for images of `extended` columns to images of fewer columns.
///
/// On the extended grid the equation is A J = B, with B = b inside (x < width), and outside 0 except for an
/// unknown source s(y) in the first column there (x = width). If no flux crosses the border, J(width-1, y) =
/// J(width, y) for all y, then J solves the equation of the smaller image, whose border condition this is. Let Z
/// be the solution without source. Each wave cos(pi l (2y+1) / (2h)) along the columns, with eigenvalue nu_l = 4
/// sin^2(pi l / (2h)), is independent. With Green's function G_l along the row for mu = alpha^2 + nu_l, the source
/// must cancel the jump of Z across the border,
///     Z_l(width-1) - Z_l(width) = (G_l(width, width) - G_l(width-1, width)) s_l .
/// G_l is a product of hyperbolic cosines in theta, 2 cosh(theta) = 2 + mu, so that (M = extended, N = width)
///     s_l / jump_l = (e^theta + 1) (1 - e^(-2 M theta)) / ((1 + e^(-(2M-2N-1) theta)) (1 - e^(-2 N theta))) ,
/// a number between 1 and (mu + 3) M / N: errors are not amplified. The transform of this ratio is a matrix K with
/// s = K jump,
///     K(y, y') = t(y - y') + t(y + y' + 1),  t(j) = 1/(2h) sum_l e_l (s_l / jump_l) cos(pi l j / h),
/// e_0 = 1, e_l = 2: a circular convolution of t with the jumps mirrored at the lower border.
class BorderSource {
public:
    BorderSource(int width, int extended, int height);

    /// Computes t.
    void prepare(double alpha);

    /// Returns the weight of wave k of an unnormalised DCT-II of the extended row in the jump Z(width-1) -
    /// Z(width).
    double jump_weight(int k) const;

    /// Returns the DCT-II at wave k of a unit source at x = width.
    double source_weight(int k) const;

    /// Sets sources = K jumps, for three channels of `height` values each.
    void solve(const double* jumps, float* sources, const ParallelFor& parallel_for) const;

private:
    int width_;
    int extended_;
    int height_;
    std::vector<double> kernel_; ///< t(i - (2 height - 1))
};

/// Uniform image-space control variates, reconstruction (36) [Rousselle 2016]. Each neighbour plus the gradient to
/// the pixel is an estimate of the pixel, which takes the mean of these and of itself, repeatedly from the primal
/// on,
///     I <- I + (sum over neighbours n of I(n) + gradient from n - I) / 5 .
/// This is gradient descent on the gradients' misfits. Stopping it takes the role of alpha in the screened Poisson
/// problem. At the border, the pixel itself replaces a missing neighbour, so that the mean is kept.
///
/// Writes the result to `image`, which must not be an image of the problem. The problem's alpha is not used.
/// Returns `iterations`, or 0 if stopped between two of them.
int average_neighbours(const PoissonProblem& problem, int iterations, RgbImage& image,
                       const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

} // namespace tessera
