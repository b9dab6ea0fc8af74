#pragma once

#include "recon/enumeration.h"

#include <array>
#include <string_view>

namespace tessera {

/// How a picture is made. mixed: L1 of the gradients, L2 of the primal. uniform: averages of neighbours
/// (average_neighbours; alpha does not matter). weighted: L2, where gradients count the less the noisier they are
/// (weights_of_gradients). guided: weighted, then smoothed where pixels look alike as far as two halves of the
/// samples disagree (recon/picture/guided.h). smoothed: the primal, smoothed so. oidn: guided, shrunk toward what
/// Open Image Denoise makes of each pixel's own paths (recon/picture/oidn.h, shrinkage.h); of one pass, whose
/// noise nobody knows, that alone. Without gradients, these last two are the primal, smoothed or denoised (as it
/// was sampled, spikes in full), and all others are none. All but l1, and oidn without gradients, keep the
/// primal's mean (with parts: nearly), until what l1, mixed, weighted and these leave below black is lifted to it,
/// unless the primal is below, too.
enum class Norm { none, l2, l1, mixed, uniform, weighted, guided, smoothed, oidn };

/// All of them, in the order above.
inline constexpr std::array all_norms = {Norm::none,     Norm::l2,     Norm::l1,       Norm::mixed, Norm::uniform,
                                         Norm::weighted, Norm::guided, Norm::smoothed, Norm::oidn};
static_assert(all_norms.size() == enumerator_count<Norm>);

/// What it comes to: without gradients, none but for those that smooth the primal.
inline Norm applied(Norm norm, bool has_gradients) {
    return has_gradients || norm == Norm::smoothed || norm == Norm::oidn ? norm : Norm::none;
}

/// "none", "l2", "l1", "mixed", "uniform", "weighted", "guided", "smoothed", "oidn".
std::string_view to_string(Norm norm);

/// Whether the image is a linear function of primal and gradients, and so as unbiased as they are, if spikes count
/// in full.
bool is_linear(Norm norm);

/// Whether a coefficient's parts are reconstructed with it, where there are any; else it is, as a whole.
bool expands(Norm norm);

/// What becomes of samples far above the others of their pixel (recon/picture/spikes.h).
enum class Spikes {
    off,       ///< they count in full: with a linear norm, the picture is unbiased
    consistent ///< the less they count, the fewer samples there are
};

/// "off", "consistent".
std::string_view to_string(Spikes spikes);

} // namespace tessera
