#include "render/estimator/basis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace tessera {

namespace {

// Length of the functions. With orthonormal functions, s^l of a diffuse surface is A_k / pi times the harmonics
// of its normal, A = pi, 2 pi / 3, pi / 4, 0 by degree k [Ramamoorthi 2001], and the sum of squares is (1 + 4/3 +
// 5/16) / (4 pi). With functions of a length of the root of that, it is 1.
constexpr float length = 0.458907f;

/// g_0, 0.3 times g of a diffuse surface in the direction of its normal (docs/decisions.md).
constexpr float g_0 = 0.3f * inv_pi;

/// One vector of lanes.
using Eight = float __attribute__((vector_size(lanes_per_vector * sizeof(float))));

Eight load(const FloatLanes& lanes, int first) {
    Eight numbers;
    std::memcpy(&numbers, &lanes[first], sizeof numbers);
    return numbers;
}

/// Evaluates the first `parts` real spherical harmonics, degree by degree up to 3, for one direction or eight.
template <class Number>
void harmonics(int components, Number x, Number y, Number z, Number* values) {
    values[0] = 0 * x + length * 0.282095f;
    values[1] = length * 0.488603f * y;
    values[2] = length * 0.488603f * z;
    values[3] = length * 0.488603f * x;
    if (components == 4)
        return;
    values[4] = length * 1.092548f * x * y;
    values[5] = length * 1.092548f * y * z;
    values[6] = length * 0.315392f * (3 * z * z - 1);
    values[7] = length * 1.092548f * x * z;
    values[8] = length * 0.546274f * (x * x - y * y);
    if (components == 9)
        return;
    values[9] = length * 0.590044f * y * (3 * x * x - y * y);
    values[10] = length * 2.890611f * x * y * z;
    values[11] = length * 0.457046f * y * (5 * z * z - 1);
    values[12] = length * 0.373176f * z * (5 * z * z - 3);
    values[13] = length * 0.457046f * x * (5 * z * z - 1);
    values[14] = length * 1.445306f * z * (x * x - y * y);
    values[15] = length * 0.590044f * x * (x * x - 3 * y * y);
}

constexpr int boxes = 9;
constexpr float height_of_box = length * 0.846284f; // 1 / sqrt(solid angle of a box)

/// Returns the box of a direction. Nine boxes have the same solid angle: three slices of z, each with three of
/// azimuth.
int box_of(glm::vec3 d) {
    constexpr float sin_120 = 0.866025f;
    const int slice = (d.z >= -1 / 3.0f) + (d.z >= 1 / 3.0f);
    const int third = d.y >= 0 ? sin_120 * d.x + 0.5f * d.y <= 0 : 1 + (sin_120 * d.x - 0.5f * d.y >= 0);
    return 3 * slice + third;
}

float fraction(double a) {
    return std::min(static_cast<float>(a - std::floor(a)), 0x1.fffffep-1f);
}

} // namespace

int component_count(Basis basis) {
    switch (basis) {
    case Basis::none:
    case Basis::albedo:
        return 0;
    case Basis::sh1:
        return 4;
    case Basis::sh2:
        return 9;
    case Basis::sh3:
        return 16;
    case Basis::box:
        return boxes;
    }
    return 0;
}

void evaluate_basis(Basis basis, glm::vec3 direction, float* values) {
    if (basis != Basis::box)
        return harmonics(component_count(basis), direction.x, direction.y, direction.z, values);
    std::fill_n(values, boxes, 0.0f);
    values[box_of(direction)] = height_of_box;
}

void project_evenly(Basis basis, float* s) {
    const bool is_box = basis == Basis::box;
    std::fill_n(s, component_count(basis), is_box ? 1 / 3.0f : 0.0f);
    if (!is_box)
        s[0] = 1;
}

void project(const Vertex& x, Basis basis, int directions, float* sums) {
    const int components = component_count(basis);
    const Rgb albedo = x.bsdf.albedo(x.to_previous);
    float even[max_components], here[max_components];
    project_evenly(basis, even);
    for (int i = 0; i < directions; ++i) { // the R3 sequence [Roberts 2018]
        const float lobe = fraction(0.5 + i * 0.8191725133961645);
        const glm::vec2 u{fraction(0.5 + i * 0.6710436067037893), fraction(0.5 + i * 0.5497004779019703)};
        const auto s = x.bsdf.sample(x.to_previous, lobe, u);
        if (!s)
            continue;
        if (!s->is_delta)
            evaluate_basis(basis, x.to_world(s->to_next), here);
        const float component = luminance(s->f_cos / albedo) / (s->pdf_w * static_cast<float>(directions));
        for (int l = 0; l < components; ++l)
            sums[l] += component * (s->is_delta ? even[l] : here[l] / (length * length));
    }
}

void ArrivingLight::reset(Basis basis, std::span<const Rgb> albedos) {
    basis_ = basis;
    components_ = component_count(basis);
    count_ = components_ > 0 ? static_cast<int>(albedos.size()) : 0;
    while (light_.size() < static_cast<std::size_t>(components_))
        light_.push_back(std::make_unique<Vec3Lanes>());
    for (int m = 0; m < padded(count_); ++m)
        least_f_cos_.set(m, m < count_ ? glm::max(g_0 * albedos[m], 1e-20f) : Rgb(1));
    for (int l = 0; l < components_; ++l)
        for (int m = 0; m < padded(count_); ++m)
            component(l).set(m, Rgb(0));
}

void ArrivingLight::add(const FirstScatter& scatter, const Vec3Lanes& carried) {
    for (int first = 0; first < count_; first += lanes_per_vector)
        add_eight(first, scatter, carried);
}

void ArrivingLight::add_eight(int first, const FirstScatter& scatter, const Vec3Lanes& carried) {
    const Eight r = load(carried.x, first), g = load(carried.y, first), b = load(carried.z, first);
    const auto carries = r + g + b > 0;
    if (std::none_of(&carries[0], &carries[0] + lanes_per_vector, [](auto lane) { return lane != 0; }))
        return;
    const auto arriving = [first](const Eight& c, const FloatLanes& f_cos, const FloatLanes& least) {
        const Eight f = load(f_cos, first), l = load(least, first);
        return c / (f > l ? f : l);
    };
    const Eight t[3] = {arriving(r, scatter.f_cos.x, least_f_cos_.x), arriving(g, scatter.f_cos.y, least_f_cos_.y),
                        arriving(b, scatter.f_cos.z, least_f_cos_.z)};
    // Directions are undefined in lanes without light.
    const auto direction = [&](const FloatLanes& lanes) { return carries ? load(lanes, first) : Eight{}; };
    const Eight x = direction(scatter.direction.x), y = direction(scatter.direction.y),
                z = direction(scatter.direction.z);
    Eight values[max_components];
    if (basis_ == Basis::box)
        for (int j = 0; j < lanes_per_vector; ++j) {
            float one[boxes];
            evaluate_basis(basis_, {x[j], y[j], z[j]}, one);
            for (int l = 0; l < boxes; ++l)
                values[l][j] = one[l];
        }
    else
        harmonics(components_, x, y, z, values);
    for (int l = 0; l < components_; ++l) {
        const auto add_to = [&](FloatLanes& sums, const Eight& light) {
            const Eight sum = load(sums, first) + values[l] * light;
            std::memcpy(&sums[first], &sum, sizeof sum);
        };
        add_to(component(l).x, t[0]);
        add_to(component(l).y, t[1]);
        add_to(component(l).z, t[2]);
    }
}

void ArrivingLight::add(int lane, glm::vec3 direction, Rgb f_cos, Rgb carried) {
    float values[max_components];
    evaluate_basis(basis_, direction, values);
    const Rgb arriving = carried / glm::max(f_cos, least_f_cos_[lane]);
    for (int l = 0; l < components_; ++l)
        component(l).set(lane, component(l)[lane] + values[l] * arriving);
}

void ArrivingLight::expand(int m, Rgb coefficient, const float* projection, Rgb* components) const {
    float squares = 0;
    Rgb seen(0);
    for (int l = 0; l < components_; ++l) {
        squares += projection[l] * projection[l];
        seen += projection[l] * component(l)[m];
    }
    const Rgb residual = (coefficient - seen) / squares;
    for (int l = 0; l < components_; ++l)
        components[l] = component(l)[m] + projection[l] * residual;
}

} // namespace tessera
