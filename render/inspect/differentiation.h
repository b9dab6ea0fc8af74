#pragma once

#include "render/paths/tracer.h"
#include "render/settings/settings.h"
#include "render/trace/intersector.h"

#include <array>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// A vector for each random number of a path, side by side, for loops that the compiler turns into vector code.
/// What lies beyond, to a whole vector, is read, too, and 0.
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

/// How a point of a path moves with the random numbers, each uniform in [0, 1], that it was made of.
struct PathDerivatives {
    int count = 0;                                   ///< of those that move it: numbers drawn later do not
    NumberVectors position;                          ///< units of the scene, in the plane across the normal
    std::array<float, NumberVectors::most> gradient; ///< relative, of f cos along the path so far, by luminance
    std::array<float, NumberVectors::most> choice;   ///< chance of the choice that each number was drawn after
    glm::vec3 normal{0};                             ///< geometric, unit
    float chance = 1; ///< of all choices that let the path come here, roulette among them
    int numbers = 0;  ///< of the path; more than `count`, if the others do not move the point
};

/// A scatter as a path has it: into what direction, and by which numbers.
struct Scattering {
    float lobe;        ///< Draw::lobe
    glm::vec2 u;       ///< Draw::direction; a delta scatter draws none
    glm::vec3 to_next; ///< unit, in the vertex's frame
    Rgb f_cos;
    float pdf_w; ///< of all lobes together; of a delta scatter its probability
    bool is_delta;
    Scatter scatter;
    float survival; ///< probability of the roulette on path length that the path goes on
};

/// A direction, unit and of the world, with what it does to light; or how both change.
struct Turn {
    glm::vec3 direction{0};
    float log_value = 0;
};

/// Carries derivatives along a path as it is traced [Suykens 2001, 3 and 4.2]: by two numbers that say where in
/// its pixel it begins, and two more for each scatter by a lobe. The numbers that choose among lobes make steps
/// only: they move nothing, but what is drawn after a choice of little chance stands for more.
///
/// What a scatter does is linear: it turns how the vertex moves over its plane, how the direction turns in which
/// it is met, and its own two numbers, into how the next direction turns. Those six columns are found once a
/// scatter, in closed form where a surface is diffuse, and else as differences of the sampling routine; by the
/// position of the vertex only where textures make it matter, as a curved surface just turns with its frame. So
/// all BSDFs have them, and a long path costs little more a vertex than a short one. What a texture changes of a
/// diffuse reflectance is not part of the gradient: that is what footprints average over.
class Differentiation {
public:
    Differentiation() = default;
    /// Copies no more than the numbers that there are.
    Differentiation(const Differentiation& other);
    Differentiation& operator=(const Differentiation& other);

    /// At a point of the picture, in pixels, and one of the lens.
    void start(const Projection& projection, glm::vec2 pixel, glm::vec2 lens);

    /// Transfer to a surface [A.2; with the sign that it lacks there].
    /// @param normal  of the triangle that the ray meets after `distance`
    void arrive(const Ray& ray, float distance, glm::vec3 normal);

    /// The scatter at that surface.
    /// @param ray, hit  how it was met; x: what is there
    void scatter(const Scene& scene, const Ray& ray, const Hit& hit, const Vertex& x, const Scattering& s);

    /// Where the path has arrived; until the next call.
    const PathDerivatives& derivatives() const { return here_; }

private:
    /// What vectors along unit directions bring, by their length.
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
