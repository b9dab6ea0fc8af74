#pragma once

#include <optional>
#include <stop_token>
#include <string_view>

#include "recon/gradient_images.h"
#include "recon/parallel.h"

namespace tessera {

enum class Norm { none, l2, l1 };

/// "none", "l2", "l1".
std::string_view to_string(Norm norm);
/// Empty: no such norm.
std::optional<Norm> norm_from_name(std::string_view name);

struct ReconstructionSettings {
    Norm norm = Norm::l2;
    float alpha = 0.2f; ///< weight of the primal image against its gradients, > 0

    bool operator==(const ReconstructionSettings&) const = default;
};

struct Reconstruction {
    RgbImage image;     ///< radiance, very direct light included; empty when stopped
    double residual = 0;  ///< relative residual of the normal equations (L2)
    int iterations = 0; ///< inner solves; 1 for L2, 0 for none
    double seconds = 0; ///< wall time
};

/// The image whose gradients are (dx, dy) and whose values are the primal's, as nearly as the norm and alpha
/// allow (screened Poisson), plus very direct light. Without gradients, or with Norm::none, it is the primal
/// plus very direct light.
Reconstruction reconstruct(const GradientImages& images, const ReconstructionSettings& settings,
                           const ParallelFor& parallel_for = serial_for, std::stop_token stop = {});

} // namespace tessera
