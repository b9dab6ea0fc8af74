#include "render/surface/microfacet.h"

#include "render/sampling/sampling.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// Returns the inverse of erf by Winitzki's formula and two Newton steps; x is clamped to +-0.999999.
float inverse_erf(float x) {
    const float bounded = std::clamp(x, -0.999999f, 0.999999f);
    const float w = std::log((1 - bounded) * (1 + bounded));
    const float a = 0.147f;
    const float b = 2 / (pi * a) + 0.5f * w;
    const float root = std::sqrt(std::max(std::sqrt(b * b - w / a) - b, 0.0f));
    float y = std::copysign(root, bounded);
    for (int step = 0; step < 2; ++step)
        y -= (std::erf(y) - bounded) * 0.5f * std::sqrt(pi) * std::exp(y * y);
    return y;
}

/// Samples the slope along the viewing direction among visible Beckmann facets with alpha = 1. Inverts the
/// marginal distribution function by Newton's method within a bracket [Jakob 2014].
float sample_beckmann_slope(float cos_theta, float u) {
    const float sin_theta = std::sqrt(std::max(1 - cos_theta * cos_theta, 0.0f));
    const float tan_theta = sin_theta / cos_theta;
    const float cot_theta = 1 / tan_theta;
    // P(slope < inverse_erf(b)) is proportional to 1 + b + tan / sqrt(pi) exp(-inverse_erf(b)^2), b in [-1,
    // erf(cot)].
    const float inv_sqrt_pi = 1 / std::sqrt(pi);
    const float top = std::erf(cot_theta);
    const float total = 1 + top + tan_theta * inv_sqrt_pi * std::exp(-cot_theta * cot_theta);
    const float target = u * total;
    float low = -1;
    float high = top;
    float b = low + u * (high - low);
    float slope = 0;
    for (int step = 0; step < 24; ++step) {
        slope = inverse_erf(b);
        const float error = 1 + b + tan_theta * inv_sqrt_pi * std::exp(-slope * slope) - target;
        if (std::abs(error) < 1e-6f * total)
            break;
        (error > 0 ? high : low) = b;
        const float derivative = 1 - slope * tan_theta;
        const float newton = b - error / derivative;
        b = newton > low && newton < high ? newton : 0.5f * (low + high);
    }
    return slope;
}

/// Samples a visible normal; `alpha` holds the roughness along tangent and bitangent.
glm::vec3 sample_visible_beckmann(glm::vec3 direction, glm::vec2 alpha, glm::vec2 u) {
    const glm::vec3 stretched =
        glm::normalize(glm::vec3(alpha.x * direction.x, alpha.y * direction.y, direction.z));
    const float sin_theta = std::sqrt(stretched.x * stretched.x + stretched.y * stretched.y);
    const float along = sample_beckmann_slope(stretched.z, u.x);
    const float across = inverse_erf(2 * u.y - 1);
    const float cos_phi = sin_theta > 0 ? stretched.x / sin_theta : 1;
    const float sin_phi = sin_theta > 0 ? stretched.y / sin_theta : 0;
    const glm::vec2 slope =
        alpha * glm::vec2(cos_phi * along - sin_phi * across, sin_phi * along + cos_phi * across);
    return glm::normalize(glm::vec3(-slope.x, -slope.y, 1));
}

/// Samples a visible normal by the projected disk [Heitz 2018]; `alpha` as above.
glm::vec3 sample_visible_ggx(glm::vec3 direction, glm::vec2 alpha, glm::vec2 u) {
    const glm::vec3 stretched =
        glm::normalize(glm::vec3(alpha.x * direction.x, alpha.y * direction.y, direction.z));
    glm::vec2 p = sample_disk(u);
    const float s = 0.5f * (1 + stretched.z);
    // Seen from `stretched`, the hemisphere of facets projects to a disk whose lower half is compressed. The
    // second axis points up, so the lower half has negative y.
    const float length = std::sqrt(stretched.x * stretched.x + stretched.y * stretched.y);
    const glm::vec2 toward = length > 1e-6f ? glm::vec2(stretched) * (1 / length) : glm::vec2(0, -1);
    const glm::vec3 t1(-toward.y, toward.x, 0);
    const glm::vec3 t2(-stretched.z * toward, length); // cross(stretched, t1)
    p.y = (1 - s) * std::sqrt(std::max(1 - p.x * p.x, 0.0f)) + s * p.y;
    const glm::vec3 n = p.x * t1 + p.y * t2 + std::sqrt(std::max(1 - p.x * p.x - p.y * p.y, 0.0f)) * stretched;
    return glm::normalize(glm::vec3(alpha.x * n.x, alpha.y * n.y, std::max(n.z, 0.0f)));
}

/// Returns the squared length of a vector stretched along x and compressed along y; fast if isotropic.
float stretched_square(float x, float y, float stretch) {
    if (stretch != 1) [[unlikely]] {
        x *= stretch;
        y /= stretch;
    }
    return x * x + y * y;
}

} // namespace

Microfacets Microfacets::anisotropic(MicrofacetDistribution distribution, float along_tangent,
                                     float along_bitangent) {
    const float u = std::max(along_tangent, smallest_alpha), v = std::max(along_bitangent, smallest_alpha);
    return {distribution, std::sqrt(u * v), std::sqrt(u / v)};
}

float Microfacets::density(glm::vec3 normal) const {
    if (normal.z <= 0)
        return 0;
    const float a2 = alpha * alpha;
    // Maps slopes to those of isotropic facets with `alpha`; the map preserves areas of slopes [Heitz 2014].
    const float sin2 = stretched_square(normal.y, normal.x, stretch);
    const float cos2 = normal.z * normal.z;
    if (distribution == MicrofacetDistribution::ggx) {
        const float d = sin2 + a2 * cos2;
        return inv_pi * a2 / (d * d);
    }
    const float exponent = sin2 / (a2 * cos2);
    return exponent < 80 ? std::exp(-exponent) * inv_pi / (a2 * cos2 * cos2) : 0; // no 0 / 0 at grazing angles
}

float Microfacets::shadowing(glm::vec3 direction, glm::vec3 normal) const {
    if (glm::dot(direction, normal) * direction.z <= 0)
        return 0;
    const float sin2 = stretched_square(direction.x, direction.y, stretch);
    const float cos2 = direction.z * direction.z;
    if (sin2 <= 0)
        return 1;
    if (distribution == MicrofacetDistribution::ggx) {
        const float c = std::abs(direction.z);
        return 2 * c / (c + std::sqrt(cos2 + alpha * alpha * sin2));
    }
    const float a = std::sqrt(cos2 / sin2) / alpha;
    if (a > 4)
        return 1; // shadowing below 1e-9
    const float lambda = 0.5f * (std::erf(a) - 1) + std::exp(-a * a) / (2 * a * std::sqrt(pi));
    return 1 / (1 + std::max(lambda, 0.0f));
}

glm::vec3 Microfacets::sample_visible(glm::vec3 direction, glm::vec2 u) const {
    const glm::vec2 alphas(alpha * stretch, alpha / stretch);
    return distribution == MicrofacetDistribution::ggx ? sample_visible_ggx(direction, alphas, u)
                                                       : sample_visible_beckmann(direction, alphas, u);
}

float Microfacets::visible_pdf(glm::vec3 direction, glm::vec3 normal) const {
    if (direction.z <= 0)
        return 0;
    return density(normal) * shadowing(direction, normal) * std::abs(glm::dot(direction, normal)) / direction.z;
}

} // namespace tessera
