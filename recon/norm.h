#pragma once

#include "recon/enumeration.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace tessera {

/// How a picture is made of primal, gradients and features. All but `guided` and `smoothed` work on raw samples,
/// as published.
enum class Norm {
    none,     ///< the raw primal
    l2,       ///< screened Poisson: least squares of gradients and primal [Kettunen 2015]
    l1,       ///< least absolute misfits of gradients and primal [Kettunen 2015]
    mixed,    ///< least absolute misfits of the gradients, least squares of the primal
    uniform,  ///< uniform control variates: iterated means of neighbours plus gradients [Rousselle 2016]
    weighted, ///< least squares with weights from the variances (weights_of_gradients) [Rousselle 2016]
    guided,   ///< Tessera's denoiser on `weighted` (recon/guided/guided.h)
    smoothed, ///< Tessera's denoiser on the primal, without gradients
    oidn      ///< Intel's Open Image Denoise on the raw primal
};

/// All of them, in the order above.
inline constexpr std::array all_norms = {Norm::none,     Norm::l2,     Norm::l1,       Norm::mixed, Norm::uniform,
                                         Norm::weighted, Norm::guided, Norm::smoothed, Norm::oidn};
static_assert(all_norms.size() == enumerator_count<Norm>);

/// Whether a reconstruction denoises, and so is biased at few samples, rather than using raw samples as published.
inline bool denoises(Norm norm) {
    return norm == Norm::guided || norm == Norm::smoothed || norm == Norm::oidn;
}

/// The reconstruction that a method has by default: `guided` with gradients, raw samples without.
inline Norm default_norm(bool has_gradients) {
    return has_gradients ? Norm::guided : Norm::none;
}

/// The reconstruction that a setting amounts to: a method without gradients has the raw primal in place of those
/// that need gradients.
inline Norm applied(Norm norm, bool has_gradients) {
    return has_gradients || norm == Norm::smoothed || norm == Norm::oidn ? norm : Norm::none;
}

/// "none", "l2", "l1", "mixed", "uniform", "weighted", "guided", "smoothed", "oidn".
std::string_view to_string(Norm norm);

/// What the expected picture of n samples a pixel has to do with the exact one.
enum class Convergence : std::uint8_t {
    unbiased,   ///< equal for every n
    consistent, ///< equal in the limit n -> infinity; biased before
    biased      ///< not even in the limit
};

/// "unbiased", "consistent", "biased".
std::string_view to_string(Convergence convergence);

/// What is known of a reconstruction's bias, with the default settings otherwise.
struct Guarantee {
    Convergence convergence;
    std::string_view reason; ///< one sentence: why, and what the bias is at few samples
};

/// The only table of such claims: help, tooltips and METHODS.md take them from here.
/// @param norm  as applied() returns it
Guarantee guarantee_of(Norm norm);

/// Whether the components of a basis are reconstructed with it; otherwise the coefficient is, as a whole.
bool expands(Norm norm);

} // namespace tessera
