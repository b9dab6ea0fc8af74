#pragma once

#include "recon/image.h"
#include "recon/parallel.h"

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

/// The same of b - A image, worked out in double.
void poisson_defect(const PoissonProblem& problem, const RgbImage& image, int y, int begin, int end, float* out);

/// |b - A image| / |b|, 0 if the former is 0.
double poisson_residual(const PoissonProblem& problem, const RgbImage& image,
                        const ParallelFor& parallel_for = serial_for);

} // namespace tessera
