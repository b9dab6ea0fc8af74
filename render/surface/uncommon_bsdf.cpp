#include "render/surface/uncommon_bsdf.h"

namespace tessera {

// Out of line, so that callers that visit a Bsdf stay small.

BsdfValue UncommonBsdf::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    return std::visit([&](const auto& b) { return b.evaluate(to_previous, to_next); }, kind);
}

std::optional<BsdfSample> UncommonBsdf::sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    return std::visit([&](const auto& b) { return b.sample(to_previous, lobe, u); }, kind);
}

DeltaValue UncommonBsdf::evaluate_delta(glm::vec3 to_previous, Scatter scatter) const {
    return std::visit([&](const auto& b) { return b.evaluate_delta(to_previous, scatter); }, kind);
}

float UncommonBsdf::roughness() const {
    return std::visit([](const auto& b) { return b.roughness(); }, kind);
}

Rgb UncommonBsdf::albedo(glm::vec3 to_previous) const {
    return std::visit([&](const auto& b) { return b.albedo(to_previous); }, kind);
}

float UncommonBsdf::relative_index(glm::vec3 to_previous) const {
    return std::visit([&](const auto& b) { return relative_index_of(b, to_previous); }, kind);
}

} // namespace tessera
