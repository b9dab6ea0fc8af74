#include "render/io/exr_color.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace tessera {

namespace {

glm::dvec3 xyz_of(glm::dvec2 xy) {
    return {xy.x, xy.y, 1 - xy.x - xy.y};
}

/// Returns the matrix that adapts XYZ from one white to another.
glm::dmat3 adaptation(glm::dvec3 from, glm::dvec3 to) {
    const glm::dmat3 cones = glm::transpose(
        glm::dmat3{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}});
    const glm::dvec3 scale = (cones * to) / (cones * from);
    return glm::inverse(cones) * glm::dmat3{{scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}} * cones;
}

bool is_near(glm::dvec2 a, glm::dvec2 b) {
    return std::abs(a.x - b.x) < 1e-3 && std::abs(a.y - b.y) < 1e-3;
}

bool is_finite(const glm::dmat3& m) {
    double sum = 0;
    for (int i = 0; i < 3; ++i)
        sum += m[i].x + m[i].y + m[i].z;
    return std::isfinite(sum);
}

/// Returns the two samples next to a pixel of one axis, and the weight of the second.
struct Between {
    int first, second;
    float weight;
};

Between between(int pixel, int step, int samples) {
    const int first = pixel / step;
    return {std::min(first, samples - 1), std::min(first + 1, samples - 1),
            static_cast<float>(pixel % step) / static_cast<float>(step)};
}

} // namespace

glm::dmat3 xyz_of_primaries(const Chromaticities& c) {
    const glm::dmat3 primaries{xyz_of(c.red), xyz_of(c.green), xyz_of(c.blue)};
    const glm::dvec3 white = xyz_of(c.white) / c.white.y;
    const glm::dvec3 scale = glm::inverse(primaries) * white;
    const glm::dmat3 result{primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z};
    if (std::abs(glm::determinant(primaries)) < 1e-6 || !is_finite(result))
        throw std::runtime_error("the chromaticities in its header span no colours");
    return result;
}

std::optional<glm::dmat3> rec709_of_primaries(const Chromaticities& c) {
    const Chromaticities rec709;
    if (is_near(c.red, rec709.red) && is_near(c.green, rec709.green) && is_near(c.blue, rec709.blue) &&
        is_near(c.white, rec709.white))
        return {};
    const glm::dmat3 from_xyz = glm::inverse(xyz_of_primaries(rec709));
    if (is_near(c.red, {1, 0}) && is_near(c.green, {0, 1}) && is_near(c.blue, {0, 0}))
        return from_xyz;
    const glm::dmat3 to_xyz = xyz_of_primaries(c);
    const glm::dvec3 white = to_xyz * glm::dvec3(1), target = xyz_of(rec709.white) / rec709.white.y;
    const glm::dmat3 result = from_xyz * adaptation(white, target) * to_xyz;
    if (!is_finite(result))
        throw std::runtime_error("the chromaticities in its header span no colours");
    return result;
}

Rgb rgb_of_luminance_chroma(Rgb y_ry_by, glm::dvec3 weights) {
    const double y = y_ry_by.x, r = (y_ry_by.y + 1.0) * y, b = (y_ry_by.z + 1.0) * y;
    return Rgb(glm::dvec3(r, (y - weights.r * r - weights.b * b) / weights.g, b));
}

Image<float> upsampled(const Image<float>& samples, glm::ivec2 step, int width, int height) {
    Image<float> result(width, height);
    for (int y = 0; y < height; ++y) {
        const Between row = between(y, step.y, samples.height());
        for (int x = 0; x < width; ++x) {
            const Between column = between(x, step.x, samples.width());
            const auto at = [&](int j) {
                return std::lerp(samples(column.first, j), samples(column.second, j), column.weight);
            };
            result(x, y) = std::lerp(at(row.first), at(row.second), row.weight);
        }
    }
    return result;
}

} // namespace tessera
