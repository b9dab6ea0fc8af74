#include "render/scene/light.h"

#include "render/sampling.h"

#include <numeric>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// Splits weights of mean 1 into halves of two: entry i keeps its share up to threshold[i] and gives the rest of
/// its place to alias[i] [Vose 1991].
void build_alias(std::vector<float>& threshold, std::vector<std::uint32_t>& alias) {
    std::vector<std::uint32_t> small, large;
    for (std::uint32_t i = 0; i < threshold.size(); ++i)
        (threshold[i] < 1 ? small : large).push_back(i);
    while (!small.empty() && !large.empty()) {
        const std::uint32_t s = small.back(), l = large.back();
        small.pop_back();
        alias[s] = l;
        threshold[l] -= 1 - threshold[s];
        if (threshold[l] < 1) {
            large.pop_back();
            small.push_back(l);
        }
    }
    for (std::uint32_t i : small)
        threshold[i] = 1; // by rounding
    for (std::uint32_t i : large)
        threshold[i] = 1;
}

} // namespace

LightTable::LightTable(const std::vector<Shape>& shapes, const std::vector<AreaLight>& lights)
    : pdf_a_(lights.size(), 0.0f) {
    for (const AreaLight& light : lights)
        radiance_.push_back(light.radiance);
    std::vector<double> power;
    for (const Shape& shape : shapes) {
        if (shape.area_light < 0 || is_black(lights[shape.area_light].radiance))
            continue;
        for (glm::uvec3 t : shape.mesh.triangles) {
            const glm::vec3 corner = shape.mesh.positions[t.x];
            const glm::vec3 edge1 = shape.mesh.positions[t.y] - corner;
            const glm::vec3 edge2 = shape.mesh.positions[t.z] - corner;
            const float area2 = glm::length(glm::cross(edge1, edge2));
            if (!(area2 > 0))
                continue; // no area, no light
            entries_.push_back({corner, edge1, edge2, front_normal(shape.mesh, t), shape.area_light, 0, 0});
            power.push_back(0.5 * area2 * luminance(lights[shape.area_light].radiance));
        }
    }
    const double total = std::accumulate(power.begin(), power.end(), 0.0);
    for (std::size_t i = 0; i < lights.size(); ++i)
        pdf_a_[i] = total > 0 ? static_cast<float>(luminance(lights[i].radiance) / total) : 0.0f;

    std::vector<float> threshold(entries_.size());
    std::vector<std::uint32_t> alias(entries_.size());
    for (std::size_t i = 0; i < entries_.size(); ++i)
        threshold[i] = static_cast<float>(power[i] / total * static_cast<double>(entries_.size()));
    std::iota(alias.begin(), alias.end(), 0u);
    build_alias(threshold, alias);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        entries_[i].threshold = threshold[i];
        entries_[i].alias = alias[i];
    }
}

LightPoint LightTable::sample(float pick, glm::vec2 u) const {
    const float scaled = pick * static_cast<float>(entries_.size());
    const auto slot = std::min(static_cast<std::size_t>(scaled), entries_.size() - 1);
    const Entry& first = entries_[slot];
    const Entry& e = scaled - static_cast<float>(slot) < first.threshold ? first : entries_[first.alias];
    const glm::vec2 b = sample_triangle(u);
    const auto light = static_cast<std::size_t>(e.area_light);
    return {e.corner + b.x * e.edge1 + b.y * e.edge2, e.normal, radiance_[light], pdf_a_[light]};
}

} // namespace tessera
