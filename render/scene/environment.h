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

/// Where a unit direction is on a map in latitude and longitude, as in Mitsuba: u = atan2(x, -z) / 2 pi in [0, 1]
/// and v = acos(y) / pi; +y is up, v = 0 the top row. direction_of_map is the way back.
glm::vec2 map_of_direction(glm::vec3 direction);
glm::vec3 direction_of_map(glm::vec2 uv);

/// Radiance from all directions, mapped as above. Pixels are interpolated bilinearly; as in Mitsuba 3 a column
/// counts at its centre, while rows run from pole to pole: the first is at v = 0, the last at v = 1. One pixel
/// makes a constant environment.
struct EnvironmentMap {
    std::shared_ptr<const Bitmap> bitmap;
    float scale = 1;
    glm::mat3 to_world{1.0f}; ///< a rotation, perhaps mirrored
};

/// A disk of constant radiance at infinity.
struct SunDisk {
    glm::vec3 direction{0, 1, 0}; ///< toward its centre, unit, world
    float radius = 0.004675f;     ///< as an angle, radians
    Rgb radiance{0};
};

/// What a scene has around it: light that arrives from infinity.
struct EnvironmentDescription {
    std::optional<EnvironmentMap> map;
    std::optional<SunDisk> sun;

    bool empty() const { return !map && !sun; }
};

/// What arrives from a direction.
struct EnvironmentLight {
    Rgb radiance;
    float pdf_w; ///< of Environment::sample(), per solid angle
};

/// A direction from which light may arrive.
struct EnvironmentSample {
    glm::vec3 direction; ///< unit, world
    float pdf_w;
};

/// How a direction that is drawn turns with the two numbers of its place on the sun, or in a cell.
struct EnvironmentDerivatives {
    std::array<glm::vec3, 2> direction;
    float cell_probability; ///< of the choice among cells; 1: it is on the sun
};

/// An environment, made ready for look-ups and for sampling by luminance.
class Environment {
public:
    explicit Environment(const EnvironmentDescription& description);

    /// Radiance from a unit direction (world).
    Rgb radiance(glm::vec3 direction) const;

    /// Density of sample(), per solid angle. Positive wherever radiance() is.
    float pdf_w(glm::vec3 direction) const;

    /// radiance() and pdf_w() at once, which costs little more than either.
    EnvironmentLight look_up(glm::vec3 direction) const;

    /// A direction chosen with random numbers in [0, 1)^2: a cell of the map and a place in it, or on the sun. Its
    /// density is that of pdf_w(), but for rounding at the edges of cells.
    EnvironmentSample sample(glm::vec2 u_cell, glm::vec2 u_position) const;

    /// Of the direction that sample() chooses with these numbers. The first of both also tells the sun from the
    /// map, and is used again for the place there.
    EnvironmentDerivatives differentiate(glm::vec2 u_cell, glm::vec2 u_position) const;

    /// Integral of the luminance over all directions; 0: it is black.
    double flux() const { return map_flux_ + sun_flux_; }

private:
    void build_cells();
    glm::vec2 uv_of(glm::vec3 direction) const;
    Rgb map_radiance(glm::vec2 uv) const;
    float map_pdf_w(glm::vec2 uv) const;
    bool is_on_sun(glm::vec3 direction) const;
    float sun_pdf_w() const { return sun_share_ / (pi * sun_chord2_); }
    EnvironmentSample sample_sun(glm::vec2 u) const;
    EnvironmentSample sample_map(glm::vec2 u_cell, glm::vec2 u_position) const;

    EnvironmentDescription description_;
    glm::mat3 to_map_{1.0f};
    // The map's sphere in cells of equal u and v, powers of two; within a cell, directions are uniform by solid
    // angle.
    struct Row {
        float top, bottom; // cosines
        float density;     // of a direction in one of its cells
    };
    glm::ivec2 cell_count_{0};
    int column_bits_ = 0;
    AliasTable cells_;
    std::vector<Row> rows_;
    double map_flux_ = 0, sun_flux_ = 0;
    float sun_share_ = 0;  // probability that sample() takes the sun
    float sun_chord2_ = 0; // square of the distance from the centre to the edge of the disk, on the unit sphere
};

} // namespace tessera
