#include "recon/norm.h"

namespace tessera {

std::string_view to_string(Norm norm) {
    constexpr std::array<std::string_view, all_norms.size()> names = {
        "none", "l2", "l1", "mixed", "uniform", "weighted", "guided", "smoothed", "oidn"};
    return names[static_cast<int>(norm)];
}

std::string_view to_string(Convergence convergence) {
    constexpr std::string_view names[] = {"unbiased", "consistent", "biased"};
    return names[static_cast<int>(convergence)];
}

Guarantee guarantee_of(Norm norm) {
    using enum Convergence;
    switch (norm) {
    case Norm::none:
        return {unbiased, "The mean of unbiased samples."};
    case Norm::l2:
        return {unbiased, "A linear function of the samples."};
    case Norm::uniform:
        return {unbiased, "A linear function of the samples."};
    case Norm::l1:
        return {consistent, "At few samples it follows the median of the primal, which is darker than the mean."};
    case Norm::mixed:
        return {consistent, "Gradients taken for outliers weigh less: edges may shift at few samples."};
    case Norm::weighted:
        return {consistent, "Weights depend on the same samples: details may be too smooth at few samples."};
    case Norm::guided:
    case Norm::smoothed:
        return {consistent,
                "Fireflies are clamped, noise is filtered; both vanish as samples grow."};
    case Norm::oidn:
        return {biased, "A neural network decides what is noise."};
    }
    return {biased, ""};
}

bool reconstructs_components(Norm norm) {
    return norm == Norm::l2 || norm == Norm::l1 || norm == Norm::mixed || norm == Norm::weighted;
}

} // namespace tessera
