#include "render/scene/environment.h"

#include "render/sampling/sampling.h"
#include "render/surface/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace tessera {

namespace {

/// Maximum number of sampling cells: a cell is about as wide as the sun, and the table fits a core's cache.
constexpr glm::ivec2 max_cells(512, 256);

/// Returns the pixel at column x, which wraps around, and row y, which is clamped at the poles.
Rgb pixel(const Bitmap& bitmap, int x, int y) {
    x = (x % bitmap.width + bitmap.width) % bitmap.width;
    return glm::max(bitmap.texel(x, std::clamp(y, 0, bitmap.height - 1)),
                    0.0f); // resampled maps can contain negative pixels
}

Rgb bilinear(const Bitmap& bitmap, glm::vec2 uv) {
    const float x = uv.x * static_cast<float>(bitmap.width) - 0.5f;
    const float y = uv.y * static_cast<float>(bitmap.height - 1);
    const float left = std::floor(x), top = std::floor(y);
    const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
    const Rgb upper = glm::mix(pixel(bitmap, x0, y0), pixel(bitmap, x0 + 1, y0), x - left);
    const Rgb lower = glm::mix(pixel(bitmap, x0, y0 + 1), pixel(bitmap, x0 + 1, y0 + 1), x - left);
    return glm::mix(upper, lower, y - top);
}

/// Returns the mean of the bilinear interpolation over the area nearest to a pixel; positive wherever the
/// interpolation is positive there. At a pole only half of that area exists.
double mean_luminance(const Bitmap& bitmap, int x, int y) {
    constexpr double weights[3] = {0.125, 0.75, 0.125};
    double sum = 0;
    double total = 0;
    for (int j = 0; j < 3; ++j) {
        if (y + j - 1 < 0 || y + j - 1 >= bitmap.height)
            continue;
        const bool at_pole = y == 0 || y == bitmap.height - 1;
        const double weight = at_pole && j != 1 ? 0.25 : weights[j];
        total += weight;
        for (int i = 0; i < 3; ++i)
            sum += weights[i] * weight * luminance(pixel(bitmap, x + i - 1, y + j - 1));
    }
    return sum / total;
}

/// Returns the fraction of the sphere's area above v.
double area_above(double v) {
    return 0.5 - 0.5 * std::cos(3.14159265358979323846 * std::clamp(v, 0.0, 1.0));
}

/// Returns the solid angle of the area nearest to a pixel of a row.
double pixel_solid_angle(const Bitmap& bitmap, int row) {
    const double steps = std::max(bitmap.height - 1, 1);
    const double below = bitmap.height == 1 ? 1 : area_above((row + 0.5) / steps);
    const double above = bitmap.height == 1 ? 0 : area_above((row - 0.5) / steps);
    return 4 * 3.14159265358979323846 / bitmap.width * (below - above);
}

} // namespace

glm::vec3 direction_of_map(glm::vec2 uv) {
    const float azimuth = 2 * pi * uv.x;
    const float zenith_angle = pi * uv.y;
    return {std::sin(azimuth) * std::sin(zenith_angle), std::cos(zenith_angle),
            -std::cos(azimuth) * std::sin(zenith_angle)};
}

glm::vec2 map_of_direction(glm::vec3 d) {
    const float u = angle_of(d.x, -d.z) * (0.5f * inv_pi);
    // The arctangent is accurate at the poles, where acos is not.
    return {u < 0 ? u + 1 : u, angle_of(std::sqrt(d.x * d.x + d.z * d.z), d.y) * inv_pi};
}

Environment::Environment(const EnvironmentDescription& description) : description_(description) {
    if (description_.map) {
        to_map_ = glm::inverse(description_.map->to_world);
        build_cells();
    }
    if (description_.sun) {
        const float half_sine = std::sin(description_.sun->radius / 2);
        sun_chord2_ = 4 * half_sine * half_sine;
        sun_flux_ = double(pi) * sun_chord2_ * luminance(description_.sun->radiance);
    }
    sun_probability_ = flux() > 0 ? static_cast<float>(sun_flux_ / flux()) : 0;
}

void Environment::build_cells() {
    const Bitmap& bitmap = *description_.map->bitmap;
    // With powers of two, a 24-bit random number selects all cells equally often, and a shift finds the row.
    cell_count_ = {std::bit_floor(static_cast<unsigned>(std::min(max_cells.x, bitmap.width))),
                   std::bit_floor(static_cast<unsigned>(std::min(max_cells.y, bitmap.height)))};
    std::vector<double> weights(static_cast<std::size_t>(cell_count_.x) * static_cast<std::size_t>(cell_count_.y));
    for (int y = 0; y < bitmap.height; ++y) {
        const double solid_angle = pixel_solid_angle(bitmap, y);
        const int row = std::min(y * cell_count_.y / std::max(bitmap.height - 1, 1), cell_count_.y - 1);
        for (int x = 0; x < bitmap.width; ++x) {
            const int column = static_cast<int>((x + 0.5) / bitmap.width * cell_count_.x);
            const double flux = mean_luminance(bitmap, x, y) * solid_angle * description_.map->scale;
            weights[row * cell_count_.x + column] += flux;
            map_flux_ += flux;
        }
    }
    cells_ = AliasTable(weights);
    column_bits_ = std::countr_zero(static_cast<unsigned>(cell_count_.x));
    for (int row = 0; row < cell_count_.y; ++row) {
        const double top = area_above(double(row) / cell_count_.y);
        const double bottom = area_above((row + 1.0) / cell_count_.y);
        rows_.push_back({static_cast<float>(1 - 2 * top), static_cast<float>(1 - 2 * bottom),
                         static_cast<float>(cell_count_.x / (4 * 3.14159265358979323846 * (bottom - top)))});
    }
}

glm::vec2 Environment::uv_of(glm::vec3 direction) const {
    if (description_.map->bitmap->width == 1 && description_.map->bitmap->height == 1)
        return {0.5f, 0.5f}; // the map is constant
    return map_of_direction(to_map_ * direction);
}

Rgb Environment::map_radiance(glm::vec2 uv) const {
    return description_.map->scale * bilinear(*description_.map->bitmap, uv);
}

float Environment::map_pdf_w(glm::vec2 uv) const {
    if (!(map_flux_ > 0))
        return 0;
    const int column = std::min(static_cast<int>(uv.x * static_cast<float>(cell_count_.x)), cell_count_.x - 1);
    const int row = std::min(static_cast<int>(uv.y * static_cast<float>(cell_count_.y)), cell_count_.y - 1);
    const auto cell = static_cast<std::size_t>(row << column_bits_ | column);
    return (1 - sun_probability_) * cells_.probability(cell) * rows_[row].density;
}

bool Environment::is_on_sun(glm::vec3 direction) const {
    if (!description_.sun)
        return false;
    const glm::vec3 d = direction - description_.sun->direction;
    return glm::dot(d, d) < sun_chord2_;
}

EnvironmentLight Environment::look_up(glm::vec3 direction) const {
    EnvironmentLight light{Rgb(0), 0};
    if (description_.map) {
        const glm::vec2 uv = uv_of(direction);
        light = {map_radiance(uv), map_pdf_w(uv)};
    }
    if (is_on_sun(direction)) {
        light.radiance += description_.sun->radiance;
        light.pdf_w += sun_pdf_w();
    }
    return light;
}

Rgb Environment::radiance(glm::vec3 direction) const {
    Rgb sum(0);
    if (description_.map)
        sum += map_radiance(uv_of(direction));
    if (is_on_sun(direction))
        sum += description_.sun->radiance;
    return sum;
}

float Environment::pdf_w(glm::vec3 direction) const {
    const float of_map = map_flux_ > 0 ? map_pdf_w(uv_of(direction)) : 0;
    return is_on_sun(direction) ? of_map + sun_pdf_w() : of_map;
}

EnvironmentSample Environment::sample(glm::vec2 u_cell, glm::vec2 u_position) const {
    if (u_position.x < sun_probability_)
        return sample_sun({u_position.x / sun_probability_, u_position.y});
    return sample_map(u_cell, {(u_position.x - sun_probability_) / (1 - sun_probability_), u_position.y});
}

EnvironmentSample Environment::sample_sun(glm::vec2 u) const {
    // Uniform on the cap: the squared chord is uniform in [0, sun_chord2_], and the cosine is 1 - chord^2 / 2.
    const float chord2 = u.x * sun_chord2_;
    const float sine = std::sqrt(std::max(chord2 * (1 - chord2 / 4), 0.0f));
    const glm::vec2 around = sin_cos_of_turns(u.y);
    const glm::vec3 direction =
        Frame(description_.sun->direction).to_world({sine * around.y, sine * around.x, 1 - chord2 / 2});
    return {direction, sun_pdf_w() + (map_flux_ > 0 ? map_pdf_w(uv_of(direction)) : 0)};
}

EnvironmentSample Environment::sample_map(glm::vec2 u_cell, glm::vec2 u_position) const {
    const AliasTable::Choice cell = cells_.choose(u_cell);
    const Row& row = rows_[cell.index >> column_bits_];
    const auto column = static_cast<float>(cell.index & ((std::size_t{1} << column_bits_) - 1));
    const float cosine = row.top + u_position.y * (row.bottom - row.top);
    const float sine = std::sqrt(std::max(1 - cosine * cosine, 0.0f));
    const glm::vec2 around = sin_cos_of_turns((column + u_position.x) / static_cast<float>(cell_count_.x));
    const glm::vec3 direction =
        glm::normalize(description_.map->to_world * glm::vec3(sine * around.x, cosine, -sine * around.y));
    const float pdf_w = (1 - sun_probability_) * cell.probability * row.density;
    return {direction, is_on_sun(direction) ? pdf_w + sun_pdf_w() : pdf_w};
}

EnvironmentDerivatives Environment::differentiate(glm::vec2 u_cell, glm::vec2 u_position) const {
    // Derivatives of the point at height z and azimuth `turns` (in turns) as z changes by `rise` or turns by
    // `turn`.
    const auto on_sphere = [](float z, float rise, float turns, float turn) {
        const float sine = std::sqrt(std::max(1 - z * z, 1e-12f));
        const glm::vec2 sc = sin_cos_of_turns(turns);
        return std::pair(glm::vec3(-z / sine * rise * sc.y, -z / sine * rise * sc.x, rise),
                         2 * pi * turn * sine * glm::vec3(-sc.x, sc.y, 0));
    };
    if (u_position.x < sun_probability_) {
        const float z = 1 - u_position.x / sun_probability_ * sun_chord2_ / 2;
        const auto [outward, around] = on_sphere(z, -sun_chord2_ / (2 * sun_probability_), u_position.y, 1);
        const Frame frame(description_.sun->direction);
        return {{frame.to_world(outward), frame.to_world(around)}, 1};
    }
    const AliasTable::Choice cell = cells_.choose(u_cell);
    const Row& row = rows_[cell.index >> column_bits_];
    const auto column = static_cast<float>(cell.index & ((std::size_t{1} << column_bits_) - 1));
    const auto columns = static_cast<float>(cell_count_.x);
    const float z = row.top + u_position.y * (row.bottom - row.top);
    const float turns = (column + (u_position.x - sun_probability_) / (1 - sun_probability_)) / columns;
    const auto [down, around] = on_sphere(z, row.bottom - row.top, turns, 1 / (columns * (1 - sun_probability_)));
    const auto to_world = [&](glm::vec3 v) { return description_.map->to_world * glm::vec3(v.y, v.z, -v.x); };
    return {{to_world(around), to_world(down)}, cell.probability};
}

} // namespace tessera
