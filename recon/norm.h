#pragma once

#include "recon/enumeration.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace tessera {

/// Reconstruction of a picture from primal, gradients and features, reconstruction (32) to (37). All but `guided`
/// and `smoothed` use raw samples, as published.
enum class Norm {
    none,     ///< the raw primal
    l2,       ///< screened Poisson: least squares of gradients and primal, reconstruction (33) [Kettunen 2015]
    l1,       ///< least sum of lengths of the misfits of gradients and primal, reconstruction (34) [Kettunen 2015]
    mixed,    ///< lengths of the gradients' misfits, squares of the primal's, reconstruction (35)
    uniform,  ///< uniform control variates: iterated means of neighbours plus gradients, reconstruction (36)
    weighted, ///< least squares with weights from the variances (weights_of_gradients), reconstruction (37)
    guided,   ///< Tessera's denoiser on `weighted` (recon/guided/guided.h)
    smoothed, ///< Tessera's denoiser on the primal, without gradients
    oidn      ///< Intel Open Image Denoise on the raw radiance
};

/// All reconstructions, in the order above.
inline constexpr std::array all_norms = {Norm::none,     Norm::l2,     Norm::l1,       Norm::mixed, Norm::uniform,
                                         Norm::weighted, Norm::guided, Norm::smoothed, Norm::oidn};
static_assert(all_norms.size() == enumerator_count<Norm>);

/// Returns whether a reconstruction is a denoiser, which is biased at few samples.
inline bool denoises(Norm norm) {
    return norm == Norm::guided || norm == Norm::smoothed || norm == Norm::oidn;
}

/// Returns the default reconstruction of a method: `guided` with gradients, raw samples without.
inline Norm default_norm(bool has_gradients) {
    return has_gradients ? Norm::guided : Norm::none;
}

/// Returns the reconstruction that is used for a setting: raw samples in place of one that needs gradients, if
/// there are none.
inline Norm applied(Norm norm, bool has_gradients) {
    return has_gradients || norm == Norm::smoothed || norm == Norm::oidn ? norm : Norm::none;
}

/// Returns "none", "l2", "l1", "mixed", "uniform", "weighted", "guided", "smoothed" or "oidn".
std::string_view to_string(Norm norm);

/// Relation of the expected picture of n samples a pixel to the exact one.
enum class Convergence : std::uint8_t {
    unbiased,   ///< equal for every n
    consistent, ///< equal in the limit n -> infinity; biased for finite n
    biased      ///< different even in the limit
};

/// Returns "unbiased", "consistent" or "biased".
std::string_view to_string(Convergence convergence);

/// Bias of a reconstruction, with default settings otherwise.
struct Guarantee {
    Convergence convergence;
    std::string_view reason; ///< one sentence: the reason, and the bias at few samples
};

/// Returns the guarantee of a reconstruction. Help, tooltips and the table in docs/reconstruction.md have their
/// words from here.
/// @param norm  as applied() returns it
Guarantee guarantee_of(Norm norm);

/// Returns whether a reconstruction solves for the components of a basis. The others reconstruct e as a whole.
bool reconstructs_components(Norm norm);

} // namespace tessera
