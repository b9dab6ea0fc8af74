#include "render/bsdf/mixture.h"

#include "render/scene/material.h"

#include <algorithm>

namespace tessera {

namespace {

/// Calls body(part, weight) for each part that counts.
template <class Body>
void for_each_part(const Mixture& m, const Body& body) {
    for (std::size_t i = 0; i < m.material->parts.size(); ++i)
        if (const float weight = m.material->weight(i, m.at); weight > 0)
            body(m.material->parts[i]->resolve(m.at), weight);
}

float sum_of_weights(const Mixture& m) {
    float sum = 0;
    for (std::size_t i = 0; i < m.material->parts.size(); ++i)
        sum += m.material->weight(i, m.at);
    return sum;
}

} // namespace

// A part gives no sample where its value is black: there its density must not count, or light would be lost.

BsdfValue Mixture::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    BsdfValue sum;
    for_each_part(*this, [&](const Bsdf& part, float weight) {
        const BsdfValue v = part.evaluate(to_previous, to_next);
        if (is_black(v.f_cos))
            return;
        sum.f_cos += weight * v.f_cos;
        sum.pdf_w += weight * v.pdf_w;
    });
    if (sum.pdf_w > 0)
        sum.pdf_w /= sum_of_weights(*this);
    return sum;
}

DeltaValue Mixture::evaluate_delta(glm::vec3 to_previous, Scatter scatter) const {
    DeltaValue sum;
    for_each_part(*this, [&](const Bsdf& part, float weight) {
        const DeltaValue v = part.evaluate_delta(to_previous, scatter);
        if (is_black(v.value))
            return;
        sum.to_next = v.to_next;
        sum.value += weight * v.value;
        sum.probability += weight * v.probability;
    });
    if (sum.probability > 0)
        sum.probability /= sum_of_weights(*this);
    return sum;
}

std::optional<BsdfSample> Mixture::sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    float left = lobe * sum_of_weights(*this);
    std::optional<BsdfSample> s;
    bool is_chosen = false;
    for_each_part(*this, [&](const Bsdf& part, float weight) {
        if (!is_chosen && left < weight) {
            is_chosen = true;
            s = part.sample(to_previous, std::min(left / weight, 0x1.fffffep-1f), u);
        }
        left -= weight;
    });
    if (!s)
        return {};
    if (s->is_delta) {
        const DeltaValue v = evaluate_delta(to_previous, s->scatter);
        return std::make_optional<BsdfSample>(v.to_next, v.value, v.probability, true, s->scatter);
    }
    const BsdfValue v = evaluate(to_previous, s->to_next);
    if (!(v.pdf_w > 0))
        return {};
    return std::make_optional<BsdfSample>(s->to_next, v.f_cos, v.pdf_w, false, s->scatter);
}

float Mixture::roughness() const {
    float largest = 0;
    for_each_part(*this, [&](const Bsdf& part, float) { largest = std::max(largest, part.roughness()); });
    return largest;
}

float Mixture::relative_index(glm::vec3 to_previous) const {
    float index = 1;
    for_each_part(*this, [&](const Bsdf& part, float) {
        if (const float i = part.relative_index(to_previous); i != 1)
            index = i;
    });
    return index;
}

} // namespace tessera
