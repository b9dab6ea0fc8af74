#include "render/surface/bsdf.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/vec2.hpp>

namespace tessera {

namespace {

constexpr std::string_view kind_names[] = {"diffuse",    "roughdiffuse",    "roughconductor", "conductor",
                                           "dielectric", "roughdielectric", "thindielectric", "plastic",
                                           "phong",      "mixture",         "coating"}; // of Bsdf::kind
static_assert(std::size(kind_names) == std::variant_size_v<decltype(Bsdf::kind)>);

} // namespace

std::string_view kind_name(const Bsdf& bsdf) {
    return kind_names[bsdf.kind.index()];
}

float Bsdf::shadowing(glm::vec3 to_next) const {
    const float cosine = glm::dot(unbent_normal, to_next);
    const float tan2 = std::max(1 / (cosine * cosine) - 1, 0.0f);
    return 2 / (1 + std::sqrt(1 + terminator * tan2)); // [Estevez 2019, 12.3]
}

std::optional<BsdfSample> Bsdf::sample_bent(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    auto s = std::visit([&](const auto& b) { return b.sample(to_previous, lobe, u); }, kind);
    if (!s || is_cut(to_previous, s->to_next))
        return {};
    s->f_cos *= shadowing(s->to_next);
    return s;
}

} // namespace tessera
