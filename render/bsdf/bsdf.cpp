#include "render/bsdf/bsdf.h"

namespace tessera {

std::optional<BsdfSample> Bsdf::sample_bent(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    if (is_cut(to_previous))
        return {};
    auto s = std::visit([&](const auto& b) { return b.sample(to_previous, lobe, u); }, kind);
    if (s && is_cut(s->to_next))
        s.reset();
    return s;
}

} // namespace tessera
