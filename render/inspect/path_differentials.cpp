#include "render/inspect/path_differentials.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// Returns the delta of number j without the limit on the change of light. Global deltas are equal for all j.
float even_delta(const PathDerivatives& x, std::size_t j, const DeltaRule& rule) {
    if (rule.is_global)
        return std::exp2(-std::log2(rule.samples * x.chance) / static_cast<float>(x.numbers));
    const bool is_of_pixel = j < 2 && x.count == x.numbers;
    return 1 / std::sqrt(is_of_pixel ? rule.samples : rule.splits * x.choice[j]);
}

/// Returns log(f cos / pdf_w) of a light sample moved by `offset`, with the pdf of emitter sampling per solid
/// angle at x. Empty: the moved light does not reach x.
std::optional<float> log_contribution(const Vertex& x, LightPoint light, glm::vec3 offset) {
    light.position += offset;
    const std::optional<LightRay> seen = light.seen_from(x.position);
    if (!seen)
        return {};
    const float value = luminance(x.evaluate(x.to_local(seen->direction)).f_cos) / seen->pdf_w;
    return value > 0 ? std::optional(std::log(value)) : std::nullopt;
}

/// Returns the derivative of log_contribution() along a vector, by central differences.
float gradient_along(const Vertex& x, const LightPoint& light, glm::vec3 along) {
    const float step = 1e-3f * glm::distance(x.position, light.position) / std::max(glm::length(along), 1e-20f);
    const auto more = log_contribution(x, light, step * along), less = log_contribution(x, light, -step * along);
    return more && less ? (*more - *less) / (2 * step) : 0;
}

} // namespace

Scattering scattering_of(const BasePath& path, int i) {
    const BaseVertex& x = path[i];
    return {path.random.draw(i + 1, Draw::lobe),
            path.random.draw_2d(i + 1, Draw::direction),
            x.to_next,
            x.f_cos,
            x.pdf_w,
            x.is_delta,
            x.scatter,
            x.survival};
}

PathDerivatives differentiate_light(const Tracer& tracer, const BasePath& path, int i,
                                    const PathDerivatives& vertex) {
    const LightPoint& light = path.light(i).light;
    const LightDerivatives by = tracer.scene.lights().differentiate(path[i].vertex.position, path.random, i + 1);
    PathDerivatives d{};
    d.count = 2;
    d.normal = light.normal;
    d.chance = vertex.chance * by.chance;
    d.numbers = vertex.numbers + 2;
    for (const std::size_t j : {0, 1}) {
        d.position.set(static_cast<int>(j), by.position[j]);
        d.gradient[j] = gradient_along(path[i].vertex, light, by.position[j]);
        d.choice[j] = by.chance;
    }
    return d;
}

float Footprint::area() const {
    return glm::length(glm::cross(a, b));
}

NumberVectors differential_vectors(const PathDerivatives& point, const DeltaRule& rule) {
    NumberVectors vectors; // only the first padded(count) entries are set
    const auto count = static_cast<std::size_t>(NumberVectors::padded(point.count));
    const float most = rule.most_change > 0 ? rule.most_change : std::numeric_limits<float>::infinity();
    std::array<float, NumberVectors::most> deltas;
    std::fill_n(deltas.begin(), count, rule.is_global ? std::min(even_delta(point, 0, rule), 1.0f) : 0);
    if (!rule.is_global)
        for (std::size_t j = 0; j < static_cast<std::size_t>(point.count); ++j)
            deltas[j] = std::min(even_delta(point, j, rule), 1.0f);
    for (std::size_t j = 0; j < count; ++j) {
        const float limit = most / std::abs(point.gradient[j]), delta = limit < deltas[j] ? limit : deltas[j];
        vectors.x[j] = delta * point.position.x[j];
        vectors.y[j] = delta * point.position.y[j];
        vectors.z[j] = delta * point.position.z[j];
    }
    return vectors;
}

Footprint footprint(const PathDerivatives& point, const DeltaRule& rule) {
    return reduce(differential_vectors(point, rule), point.count, point.normal);
}

namespace {

/// One vector per lane.
struct LaneVectors {
    alignas(32) std::array<float, NumberVectors::lanes> x{}, y{}, z{};

    /// Returns the sum over lanes by pairwise addition, which shortens dependency chains.
    glm::vec3 sum() {
        for (std::size_t half = x.size() / 2; half > 0; half /= 2)
            for (std::size_t lane = 0; lane < half; ++lane) {
                x[lane] += x[lane + half];
                y[lane] += y[lane + half];
                z[lane] += z[lane + half];
            }
        return {x[0], y[0], z[0]};
    }
};

glm::vec3 longest_of(const NumberVectors& v, std::size_t count) {
    LaneVectors best;
    alignas(32) std::array<float, NumberVectors::lanes> length2{};
    for (std::size_t i = 0; i < count; i += length2.size())
        for (std::size_t lane = 0; lane < length2.size(); ++lane) {
            const float x = v.x[i + lane], y = v.y[i + lane], z = v.z[i + lane], l2 = x * x + y * y + z * z;
            const bool is_longer = l2 > length2[lane];
            length2[lane] = is_longer ? l2 : length2[lane];
            best.x[lane] = is_longer ? x : best.x[lane];
            best.y[lane] = is_longer ? y : best.y[lane];
            best.z[lane] = is_longer ? z : best.z[lane];
        }
    const auto lane = static_cast<std::size_t>(std::max_element(length2.begin(), length2.end()) - length2.begin());
    return {best.x[lane], best.y[lane], best.z[lane]};
}

/// Flips all vectors to the side of `to`, and returns the sum of those with no negative component along `across`.
/// With `across` = 0 it is the sum of all.
glm::vec3 sum_across(const NumberVectors& v, std::size_t count, glm::vec3 to, glm::vec3 across) {
    LaneVectors sums;
    for (std::size_t i = 0; i < count; i += sums.x.size())
        for (std::size_t lane = 0; lane < sums.x.size(); ++lane) {
            const float x = v.x[i + lane], y = v.y[i + lane], z = v.z[i + lane];
            const float sign = std::copysign(1.0f, x * to.x + y * to.y + z * to.z);
            const float factor = sign * (x * across.x + y * across.y + z * across.z) >= 0 ? sign : 0.0f;
            sums.x[lane] += factor * x;
            sums.y[lane] += factor * y;
            sums.z[lane] += factor * z;
        }
    return sums.sum();
}

} // namespace

Footprint reduce(const NumberVectors& segments, int count, glm::vec3 normal) {
    const auto lanes = static_cast<std::size_t>(NumberVectors::padded(count));
    // A segment has no sign: all are flipped to the side of the longest one.
    const glm::vec3 one_side = longest_of(segments, lanes);
    const glm::vec3 sum = sum_across(segments, lanes, one_side, glm::vec3(0));
    Footprint f;
    f.a = sum_across(segments, lanes, one_side, glm::cross(normal, sum));
    f.b = sum - f.a;
    return f;
}

float area_of_sum(const NumberVectors& segments, int count, glm::vec3 normal) {
    float area = 0;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < i; ++j)
            area += std::abs(glm::dot(normal, glm::cross(segments[i], segments[j])));
    return area;
}

void scalar_footprints(const BasePath& path, PixelWidth pixel, glm::vec3 origin, float log_samples,
                       std::vector<float>& widths) {
    widths.resize(static_cast<std::size_t>(path.size()));
    if (path.empty())
        return;
    ScalarFootprint along(pixel);
    glm::vec3 way = path[0].vertex.position - origin;
    float distance = glm::length(way);
    for (int i = 0;; ++i) {
        const BaseVertex& x = path[i];
        const glm::vec3 normal = x.vertex.geometric_normal;
        along.arrive(distance, std::abs(glm::dot(way, normal)) / distance);
        widths[i] = along.width(log_samples);
        if (i + 1 == path.size())
            return;
        way = path[i + 1].vertex.position - x.vertex.position;
        distance = glm::length(way);
        const float cosine = std::abs(glm::dot(way, normal)) / distance;
        along.scatter(cosine, x.is_delta, x.vertex.bsdf.roughness(), x.pdf_w, x.survival);
    }
}

} // namespace tessera
