#include "render/surface/layered.h"

#include "render/surface/material.h"
#include "render/surface/scattering.h"

#include <algorithm>

#include <glm/exponential.hpp>

namespace tessera {

namespace {

/// A refracted direction inside the layer, mirrored to the upper side.
struct Inside {
    glm::vec3 direction;
    float transmittance; ///< of the boundary
};

/// Refracts a direction into the layer.
Inside enter(glm::vec3 d, float eta) {
    const DielectricFresnel f = fresnel_dielectric(d.z, eta);
    return {{d.x / eta, d.y / eta, -f.cos_next}, f.cos_next == 0 ? 0 : 1 - f.reflectance};
}

/// Refracts a direction out of the layer; empty at total internal reflection.
std::optional<glm::vec3> leave(glm::vec3 d, float eta) {
    const float sin2 = (d.x * d.x + d.y * d.y) * eta * eta;
    if (sin2 >= 1)
        return {};
    return glm::vec3(d.x * eta, d.y * eta, std::sqrt(1 - sin2));
}

/// Returns the transmittance of the layer on the ways down and up (Beer's law).
Rgb layer_transmittance(const Coated& c, float cos_in, float cos_out) {
    return glm::exp(-c.material->thickness * c.material->sigma_a.evaluate(c.at) * (1 / cos_in + 1 / cos_out));
}

float mean(Rgb c) {
    return (c.r + c.g + c.b) / 3;
}

/// Returns the probability of sampling the reflection at the top of the layer.
float specular_probability(const Coated& c, float transmittance) {
    const float specular = (1 - transmittance) * mean(c.material->specular_reflectance.evaluate(c.at));
    const float base = transmittance * mean(layer_transmittance(c, 1, 1));
    return specular > 0 ? specular / (specular + base) : 0;
}

} // namespace

BsdfValue Coated::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    if (to_previous.z <= 0 || to_next.z <= 0)
        return {};
    const float eta = material->eta;
    const Inside previous = enter(to_previous, eta), next = enter(to_next, eta);
    if (!(previous.transmittance > 0) || !(next.transmittance > 0))
        return {};
    const BsdfValue v = material->base->resolve(at).evaluate(previous.direction, next.direction);
    if (is_black(v.f_cos))
        return {};
    // Solid angle inside per solid angle outside [Walter 2007, eq. 17 for a flat boundary].
    const float inside_per_outside = to_next.z / (eta * eta * next.direction.z);
    const float share = previous.transmittance * next.transmittance * inside_per_outside;
    return {v.f_cos * layer_transmittance(*this, previous.direction.z, next.direction.z) * share,
            v.pdf_w * inside_per_outside * (1 - specular_probability(*this, previous.transmittance))};
}

DeltaValue Coated::evaluate_delta(glm::vec3 to_previous, Scatter scatter) const {
    if (to_previous.z <= 0 || scatter != Scatter::reflect)
        return {};
    const Inside previous = enter(to_previous, material->eta);
    const float specular = specular_probability(*this, previous.transmittance);
    DeltaValue sum{reflect(to_previous),
                   material->specular_reflectance.filtered(at) * (1 - previous.transmittance), specular};
    if (!(previous.transmittance > 0))
        return sum;
    // A mirror below the layer reflects in the same direction as the layer's top.
    const DeltaValue base = material->base->resolve(at).evaluate_delta(previous.direction, scatter);
    if (!is_black(base.value)) {
        const float z = previous.direction.z;
        sum.value +=
            base.value * layer_transmittance(*this, z, z) * (previous.transmittance * previous.transmittance);
        sum.probability += (1 - specular) * base.probability;
    }
    return sum;
}

std::optional<BsdfSample> Coated::sample(glm::vec3 to_previous, float lobe, glm::vec2 u) const {
    if (to_previous.z <= 0)
        return {};
    const Inside previous = enter(to_previous, material->eta);
    const float specular = specular_probability(*this, previous.transmittance);
    bool is_delta = lobe < specular;
    std::optional<glm::vec3> to_next;
    if (!is_delta) {
        if (!(previous.transmittance > 0))
            return {};
        const float base_lobe = std::min((lobe - specular) / (1 - specular), 0x1.fffffep-1f);
        const auto s = material->base->resolve(at).sample(previous.direction, base_lobe, u);
        if (!s)
            return {};
        is_delta = s->is_delta;
        to_next = leave(s->to_next, material->eta);
    }
    if (is_delta) {
        const DeltaValue v = evaluate_delta(to_previous, Scatter::reflect);
        return std::make_optional<BsdfSample>(v.to_next, v.value, v.probability, true, Scatter::reflect);
    }
    if (!to_next)
        return {};
    const BsdfValue v = evaluate(to_previous, *to_next);
    if (!(v.pdf_w > 0) || is_black(v.f_cos))
        return {};
    return std::make_optional<BsdfSample>(*to_next, v.f_cos, v.pdf_w, false, Scatter::reflect);
}

/// Treats the light's second crossing of the boundary as lossless.
Rgb Coated::albedo(glm::vec3 to_previous) const {
    const Inside previous = enter({to_previous.x, to_previous.y, std::abs(to_previous.z)}, material->eta);
    const float in = previous.transmittance, z = previous.direction.z;
    const Rgb below =
        in > 0 ? material->base->resolve(at).albedo(previous.direction) * layer_transmittance(*this, z, z)
               : Rgb(0);
    return (1 - in) * material->specular_reflectance.filtered(at) + in * below;
}

float Coated::roughness() const {
    return material->base->resolve(at).roughness();
}

namespace {

/// Calls body(component, weight) for each component with a positive weight.
template <class Body>
void for_each_component(const Mixture& m, const Body& body) {
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

// Components return no sample where their value is black. Their pdf must not count there, or energy would be
// lost.

BsdfValue Mixture::evaluate(glm::vec3 to_previous, glm::vec3 to_next) const {
    BsdfValue sum;
    for_each_component(*this, [&](const Bsdf& part, float weight) {
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
    for_each_component(*this, [&](const Bsdf& part, float weight) {
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
    float rest = lobe * sum_of_weights(*this);
    std::optional<BsdfSample> s;
    bool is_chosen = false;
    for_each_component(*this, [&](const Bsdf& part, float weight) {
        if (!is_chosen && rest < weight) {
            is_chosen = true;
            s = part.sample(to_previous, std::min(rest / weight, 0x1.fffffep-1f), u);
        }
        rest -= weight;
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

Rgb Mixture::albedo(glm::vec3 to_previous) const {
    Rgb sum(0);
    for_each_component(*this, [&](const Bsdf& part, float weight) { sum += weight * part.albedo(to_previous); });
    return sum;
}

float Mixture::roughness() const {
    float largest = 0;
    for_each_component(*this, [&](const Bsdf& part, float) { largest = std::max(largest, part.roughness()); });
    return largest;
}

float Mixture::relative_index(glm::vec3 to_previous) const {
    float index = 1;
    for_each_component(*this, [&](const Bsdf& part, float) {
        if (const float i = part.relative_index(to_previous); i != 1)
            index = i;
    });
    return index;
}

} // namespace tessera
