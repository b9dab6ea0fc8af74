#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

#include <vector>

namespace tessera {

/// The screened Poisson problem: the image I that minimises
///     |Dx I - dx|^2 + |Dy I - dy|^2 + (alpha |I - primal|)^2 ,
/// where Dx and Dy are forward differences inside the image. All images are of one size, at least 1 by 1; the last
/// column of dx and the last row of dy are not looked at. Its normal equations are A I = b with
///     A = alpha^2 + Dx^T Dx + Dy^T Dy,  b = alpha^2 primal + Dx^T dx + Dy^T dy .
struct PoissonProblem {
    const RgbImage& primal;
    const RgbImage& dx;
    const RgbImage& dy;
    float alpha; ///< > 0
};

/// Writes pixels [begin, end) of row y of b to out, 3 values a pixel.
void poisson_right_side(const PoissonProblem& problem, int y, int begin, int end, float* out);

/// Writes pixels [begin, end) of row y of b - A image, worked out in double, to out, 3 values a pixel.
void poisson_defect(const PoissonProblem& problem, const RgbImage& image, int y, int begin, int end, float* out);

/// |b - A image| / |b|, 0 if the former is 0.
double poisson_residual(const PoissonProblem& problem, const RgbImage& image,
                        const ParallelFor& parallel_for = serial_for);

/// Lets a solver for images of `extended` columns serve images of fewer columns.
///
/// On the extended grid the equation is A J = B, with B = b inside (x < width), and beyond the border nothing but
/// an unknown source s(y) in the first column there (x = width). If no flux crosses the border, J(width-1, y) =
/// J(width, y) for all y, then J solves the equation of the smaller image, which has just that for its border. Let
/// Z be the answer without source. Each wave cos(pi l (2y+1) / (2h)) down the columns, with eigenvalue nu_l = 4
/// sin^2(pi l / (2h)), is on its own: with Green's function G_l along the row for mu = alpha^2 + nu_l, the jump of
/// Z over the border must be undone by the source,
///     Z_l(width-1) - Z_l(width) = (G_l(width, width) - G_l(width-1, width)) s_l .
/// G_l is a product of hyperbolic cosines in theta, 2 cosh(theta) = 2 + mu, which leaves (M = extended, N = width)
///     s_l / jump_l = (e^theta + 1) (1 - e^(-2 M theta)) / ((1 + e^(-(2M-2N-1) theta)) (1 - e^(-2 N theta))) ,
/// a number between 1 and (mu + 3) M / N: nothing is blown up. The transform of this ratio is a matrix K with
/// s = K jump,
///     K(y, y') = t(y - y') + t(y + y' + 1),  t(j) = 1/(2h) sum_l e_l (s_l / jump_l) cos(pi l j / h),
/// e_0 = 1, e_l = 2: a circular convolution of t with the jumps mirrored at the lower border.
class BorderSource {
public:
    BorderSource(int width, int extended, int height);

    /// Works out t.
    void prepare(double alpha);

    /// Weight of wave k of the extended row in the jump Z(width-1) - Z(width); of a DCT-II without factors.
    double jump_weight(int k) const;

    /// The DCT-II of a unit source at x = width, at wave k.
    double source_weight(int k) const;

    /// sources = K jumps, for three channels of `height` values each.
    void solve(const double* jumps, float* sources, const ParallelFor& parallel_for) const;

private:
    int width_;
    int extended_;
    int height_;
    std::vector<double> kernel_; ///< t(i - (2 height - 1))
};

/// Uniform image-space control variates [Rousselle 2016]: each pixel's neighbours, with the gradients to it added,
/// are as many estimates of the pixel as there are, and it takes their mean with its own, again and again,
///     I <- I + (sum over neighbours n of I(n) + gradient from n - I) / 5 ,
/// beginning with the primal. That is a descent on the gradients' misfits, and stopping it takes the part of the
/// screened Poisson problem's alpha. A border stands for a neighbour like the pixel itself, so that no light is
/// lost.
///
/// Writes the answer to `image`, which is none of the problem's, whose alpha does not matter. Returns
/// `iterations`, or 0 if stopped, which is looked at between them.
int average_neighbours(const PoissonProblem& problem, int iterations, RgbImage& image,
                       const ParallelFor& parallel_for = serial_for, const SolveWatch& watch = {});

} // namespace tessera
