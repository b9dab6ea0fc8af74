#pragma once

#include "render/paths/tracer.h"
#include "render/settings/settings.h"
#include "render/trace/intersector.h"

#include <array>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// One vector for each random number of a path, as arrays for loops that the compiler vectorises. Loops run to
/// padded(count); the entries from `count` on must be 0.
struct NumberVectors {
    static constexpr int lanes = 8;
    static constexpr int most = (2 * (most_edges + 2) + lanes - 1) / lanes * lanes;
    alignas(32) std::array<float, most> x, y, z;

    glm::vec3 operator[](int j) const {
        const auto i = static_cast<std::size_t>(j);
        return {x[i], y[i], z[i]};
    }
    void set(int j, glm::vec3 v) {
        const auto i = static_cast<std::size_t>(j);
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
    static int padded(int count) { return (count + lanes - 1) / lanes * lanes; }
};

/// Derivatives of a point of a path by the random numbers, uniform in [0, 1], that determine it.
struct PathDerivatives {
    int count = 0;          ///< of the numbers that move the point
    NumberVectors position; ///< derivatives of the position, perpendicular to the normal, scene units
    std::array<float, NumberVectors::most> gradient; ///< relative derivatives of the path's f cos, by luminance
    std::array<float, NumberVectors::most> choice;   ///< P of the choice before each number was drawn
    glm::vec3 normal{0};                             ///< geometric normal, unit
    float chance = 1; ///< product of the probabilities of all choices so far, including roulette
    int numbers = 0;  ///< of the path, at least `count`: some do not move a light sample
};

/// A scatter of a path with its random numbers.
struct Scattering {
    float lobe;        ///< Draw::lobe
    glm::vec2 u;       ///< Draw::direction; unused by a delta scatter
    glm::vec3 to_next; ///< unit, in the vertex's frame
    Rgb f_cos;
    float pdf_w; ///< per solid angle, of all lobes together; probability of a delta scatter
    bool is_delta;
    Scatter scatter;
    float survival; ///< survival probability of the roulette on path length
};

/// A unit direction in world space with the logarithm of f cos toward it; or derivatives of both.
struct Turn {
    glm::vec3 direction{0};
    float log_value = 0;
};

/// Propagates derivatives along a path [Suykens 2001, 3 and 4.2; docs/theory.md, "Path differentials"]. The path
/// has two random numbers for its position in the pixel, and two for each scatter by a lobe. Numbers that choose
/// among lobes have a derivative of 0, but their probabilities enlarge the footprint.
///
/// The derivative of a scatter is a linear map to changes of the next direction, with six columns: two each for
/// the vertex's position, the incident direction, and the scatter's own numbers. The columns are computed once per
/// scatter: in closed form for diffuse surfaces, otherwise as differences of the sampling routine, which every
/// BSDF has. Differences by position are taken only where textures change the scatter; otherwise the frame's turn
/// suffices. The gradient excludes changes of diffuse reflectance by textures, because footprints average over
/// these.
class Differentiation {
public:
    Differentiation() = default;
    /// Copies the used entries only.
    Differentiation(const Differentiation& other);
    Differentiation& operator=(const Differentiation& other);

    /// Starts a path at a point of the picture, in pixels, and of the lens (CameraSample::lens).
    void start(const Projection& projection, glm::vec2 pixel, glm::vec2 lens);

    /// Transfers the derivatives along a ray to a surface, theory (24).
    /// @param normal  of the triangle that the ray hits after `distance`
    void arrive(const Ray& ray, float distance, glm::vec3 normal);

    /// Scatters at that surface.
    /// @param ray, hit  ray to the surface and its hit
    /// @param x         the vertex there
    void scatter(const Scene& scene, const Ray& ray, const Hit& hit, const Vertex& x, const Scattering& s);

    /// Returns the derivatives at the current vertex; valid until the next call.
    const PathDerivatives& derivatives() const { return here_; }

private:
    /// Derivatives `by` for motion along two directions.
    struct Turns {
        std::array<glm::vec3, 2> along{glm::vec3(0), glm::vec3(0)};
        std::array<Turn, 2> by{};
    };
    void turn(const Turns& position, const Turns& direction);
    void turn_with_frame(const ShapeRecord& shape, const Ray& ray, const Hit& hit, const Vertex& x, glm::vec3 next,
                         const Turns& seen);
    void add_numbers(float choice, const std::array<Turn, 2>& turns);

    PathDerivatives here_;
    NumberVectors direction_;
};

} // namespace tessera
