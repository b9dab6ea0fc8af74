#pragma once

#include "recon/image.h"
#include "render/sampling/sampling.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

struct Bitmap;

/// Maps a unit direction to a latitude-longitude map as Mitsuba does: u = atan2(x, -z) / 2 pi in [0, 1] and v =
/// acos(y) / pi. +y is up and v = 0 is the top row. direction_of_map is the inverse.
glm::vec2 map_of_direction(glm::vec3 direction);
glm::vec3 direction_of_map(glm::vec2 uv);

/// Radiance from all directions, as a latitude-longitude map with bilinear interpolation. As in Mitsuba 3,
/// columns are sampled at their centres, and the first and last rows lie at v = 0 and v = 1. A map of one pixel
/// is constant.
struct EnvironmentMap {
    std::shared_ptr<const Bitmap> bitmap;
    float scale = 1;
    glm::mat3 to_world{1.0f}; ///< a rotation or a reflection
};

/// A disk of constant radiance at infinity.
struct SunDisk {
    glm::vec3 direction{0, 1, 0}; ///< toward the centre, unit, world
    float radius = 0.004675f;     ///< angular radius, radians
    Rgb radiance{0};
};

/// The light that arrives from infinity: a map, a sun, both, or none.
struct EnvironmentDescription {
    std::optional<EnvironmentMap> map;
    std::optional<SunDisk> sun;

    bool empty() const { return !map && !sun; }
};

/// Light from one direction.
struct EnvironmentLight {
    Rgb radiance;
    float pdf_w; ///< pdf of Environment::sample(), per solid angle
};

/// A direction drawn by Environment::sample().
struct EnvironmentSample {
    glm::vec3 direction; ///< unit, world
    float pdf_w;         ///< per solid angle
};

/// Derivatives of a sampled direction by the two random numbers that place it on the sun or within a map cell.
struct EnvironmentDerivatives {
    std::array<glm::vec3, 2> direction;
    float cell_probability; ///< probability of the chosen cell; 1 if the direction is on the sun
};

/// An environment prepared for look-ups and for sampling in proportion to luminance.
class Environment {
public:
    explicit Environment(const EnvironmentDescription& description);

    /// Returns the radiance from a unit direction (world).
    Rgb radiance(glm::vec3 direction) const;

    /// Returns the pdf of sample() per solid angle; positive wherever radiance() is.
    float pdf_w(glm::vec3 direction) const;

    /// Returns radiance() and pdf_w() together, which costs little more than one of them.
    EnvironmentLight look_up(glm::vec3 direction) const;

    /// Samples a direction with random numbers in [0, 1)^2, which choose a map cell and a position in it, or a
    /// position on the sun. The pdf equals pdf_w() except for rounding at the edges of cells.
    EnvironmentSample sample(glm::vec2 u_cell, glm::vec2 u_position) const;

    /// Differentiates sample() by u_position. u_position.x chooses between sun and map and is then rescaled for
    /// reuse.
    EnvironmentDerivatives differentiate(glm::vec2 u_cell, glm::vec2 u_position) const;

    /// Returns the integral of the luminance over all directions; 0 if the environment is black.
    double flux() const { return map_flux_ + sun_flux_; }

private:
    void build_cells();
    glm::vec2 uv_of(glm::vec3 direction) const;
    Rgb map_radiance(glm::vec2 uv) const;
    float map_pdf_w(glm::vec2 uv) const;
    bool is_on_sun(glm::vec3 direction) const;
    float sun_pdf_w() const { return sun_probability_ / (pi * sun_chord2_); }
    EnvironmentSample sample_sun(glm::vec2 u) const;
    EnvironmentSample sample_map(glm::vec2 u_cell, glm::vec2 u_position) const;

    EnvironmentDescription description_;
    glm::mat3 to_map_{1.0f};
    // Cells of equal size in u and v, in powers of two; sampling is uniform by solid angle within a cell.
    struct Row {
        float top, bottom; // cosines of the zenith angles
        float density;     // pdf of a direction given its cell, per solid angle
    };
    glm::ivec2 cell_count_{0};
    int column_bits_ = 0;
    AliasTable cells_;
    std::vector<Row> rows_;
    double map_flux_ = 0, sun_flux_ = 0;
    float sun_probability_ = 0; // probability that sample() chooses the sun
    float sun_chord2_ = 0;      // squared chord from the disk's centre to its edge on the unit sphere
};

} // namespace tessera
