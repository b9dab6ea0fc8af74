#include "render/scene/light.h"

#include "render/sampling.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
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

LightPoint LightTriangle::sample(glm::vec2 u) const {
    const glm::vec2 b = sample_triangle(u);
    return {corner + b.x * edge1 + b.y * edge2, normal, radiance, pdf_a};
}

LightTable::LightTable(const std::vector<Shape>& shapes, const std::vector<AreaLight>& lights)
    : pdf_a_(lights.size(), 0.0f), low_(std::numeric_limits<float>::max()),
      high_(std::numeric_limits<float>::lowest()) {
    std::vector<double> power;
    std::vector<int> light_of;
    for (const Shape& shape : shapes) {
        if (shape.area_light < 0)
            continue;
        const Rgb radiance = lights[static_cast<std::size_t>(shape.area_light)].radiance;
        for (const glm::uvec3 t : shape.mesh.triangles) {
            const glm::vec3 corner = shape.mesh.positions[t.x];
            const glm::vec3 edge1 = shape.mesh.positions[t.y] - corner;
            const glm::vec3 edge2 = shape.mesh.positions[t.z] - corner;
            const double area2 = glm::length(glm::cross(glm::dvec3(edge1), glm::dvec3(edge2)));
            if (!(area2 > 0) || is_black(radiance))
                continue; // no area, no light
            entries_.push_back({{corner, edge1, edge2, front_normal(shape.mesh, t), radiance, 0}, 0, 0});
            power.push_back(0.5 * area2 * luminance(radiance));
            light_of.push_back(shape.area_light);
            for (const glm::vec3 p : {corner, corner + edge1, corner + edge2}) {
                low_ = glm::min(low_, p);
                high_ = glm::max(high_, p);
            }
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
        entries_[i].triangle.pdf_a = pdf_a(light_of[i]);
        entries_[i].threshold = threshold[i];
        entries_[i].alias = alias[i];
    }
    // A flat box has no inside for rounding to hit.
    const glm::vec3 margin = 1e-4f * (glm::max(glm::abs(low_), glm::abs(high_)));
    low_ -= margin;
    high_ += margin;
}

const LightTriangle& LightTable::choose(glm::vec2 u) const {
    // A number of its own for the threshold: of one float, many entries would leave few bits for it.
    const auto slot = static_cast<std::size_t>(u.x * static_cast<float>(entries_.size()));
    const Entry& first = entries_[std::min(slot, entries_.size() - 1)];
    return (u.y < first.threshold ? first : entries_[first.alias]).triangle;
}

bool LightTable::may_be_hit(const Ray& ray) const {
    // Slabs [Kay and Kajiya 1986]; a NaN of 0 / 0, on a slab's very face, leaves the other slabs to decide.
    const glm::vec3 a = (low_ - ray.origin) / ray.direction, b = (high_ - ray.origin) / ray.direction;
    float enter = 0, leave = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) {
        enter = std::max(enter, std::min(a[axis], b[axis]));
        leave = std::min(leave, std::max(a[axis], b[axis]));
    }
    return enter <= leave;
}

} // namespace tessera
