#pragma once

#include "recon/image.h"
#include "render/sampling/sampling.h"
#include "render/scene/environment.h"
#include "render/scene/point_light.h"
#include "render/surface/mesh.h"
#include "render/surface/texture.h"
#include "render/trace/rays.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

class Scene;
struct SceneDescription;

/// Emission from the front side of a mesh; the radiance is the same in all directions.
struct AreaLight {
    Texture radiance{Rgb(1)};
};

/// Light that arrives from the same direction everywhere.
struct DirectionalLight {
    glm::vec3 to_light{0, 0, 1}; ///< unit
    Rgb irradiance{1};           ///< on a surface perpendicular to it
};

/// A light point as seen from a receiver. The constructor allows std::make_optional to build it in place.
struct LightRay {
    glm::vec3 direction; ///< unit, toward the light
    Rgb radiance;        ///< incident radiance; a point light's intensity; a directional light's irradiance
    float pdf_w;       ///< pdf of emitter sampling per solid angle. For point and directional lights it is defined
                       ///< such that the estimate of emitter sampling is f cos radiance / pdf_w.
    float fixed_pdf_w; ///< per solid angle, a density on the light that is the same for all receivers. |J| of a
                       ///< reconnection to the light is the base's over the offset's, theory (14).

    LightRay(glm::vec3 direction_, Rgb radiance_, float pdf_w_)
        : LightRay(direction_, radiance_, pdf_w_, pdf_w_) {}
    LightRay(glm::vec3 direction_, Rgb radiance_, float pdf_w_, float fixed_pdf_w_)
        : direction(direction_), radiance(radiance_), pdf_w(pdf_w_), fixed_pdf_w(fixed_pdf_w_) {}
};

/// The end of a light path at a light, found by emitter sampling or by BSDF sampling.
struct LightPoint {
    enum class Kind : std::uint8_t { surface, ball, point, directional, environment };
    Kind kind = Kind::surface;
    glm::vec3 position{0}; ///< at infinity: the unit direction toward the light
    glm::vec3 normal{0};   ///< unit, on the emitting side of a surface or ball; else 0
    Rgb radiance{0};       ///< radiance toward the receiver; irradiance of a directional light
    float pdf = 0; ///< pdf of emitter sampling, independent of the receiver: per area (surface), per solid angle
                   ///< (environment), or a probability (ball, point, directional). The directions toward a ball
                   ///< are uniform in the cone that the receiver sees.
    const PointLight* light = nullptr; ///< null unless kind is point
    const Quadric* ball = nullptr;     ///< null unless kind is ball

    /// Returns whether the light has an area and is not at infinity.
    bool has_area() const { return kind == Kind::surface || kind == Kind::ball; }
    /// Returns whether BSDF sampling can find this light, too.
    bool can_be_hit() const { return has_area() || kind == Kind::environment; }
    bool is_at_infinity() const { return kind == Kind::directional || kind == Kind::environment; }
    float distance_from(glm::vec3 receiver) const {
        return is_at_infinity() ? std::numeric_limits<float>::infinity() : glm::distance(position, receiver);
    }

    /// Returns the light as seen from a receiver, ignoring occlusion; empty if it sends no light there. Converts
    /// the pdf of a surface point from area to solid angle.
    std::optional<LightRay> seen_from(glm::vec3 receiver) const {
        if (!has_area())
            return seen_without_surface(receiver);
        const glm::vec3 d = position - receiver;
        const float facing = -glm::dot(d, normal); // cosine times distance
        if (!(facing > 0))
            return {};
        const float distance2 = glm::dot(d, d);
        if (!(distance2 > 0))
            return {};
        const float distance = std::sqrt(distance2), per_angle = pdf * distance2 * distance / facing;
        if (kind == Kind::ball)
            return std::make_optional<LightRay>(d / distance, radiance, pdf * ball->cone_pdf_w(receiver),
                                                per_angle);
        return std::make_optional<LightRay>(d / distance, radiance, per_angle);
    }
    /// Returns the pdf of emitter sampling per solid angle at a receiver. The light must have an area.
    /// @param geometry  cosine at the light over the squared distance: solid angle over area
    float pdf_w(glm::vec3 receiver, float geometry) const {
        return kind == Kind::ball ? pdf * ball->cone_pdf_w(receiver) : pdf / geometry;
    }

private:
    std::optional<LightRay> seen_without_surface(glm::vec3 receiver) const;
};

/// An emitting triangle.
struct LightTriangle {
    glm::vec3 corner, edge1, edge2;
    glm::vec3 normal; ///< unit, on the emitting side
    Rgb radiance;
    float pdf_a;       ///< pdf of choosing this triangle and a point on it, per area
    std::size_t light; ///< index of its area light

    const Texture* radiance_map = nullptr; ///< textured radiance; null: `radiance` holds
    const Mesh* mesh = nullptr;            ///< set with radiance_map, for its look-ups
    std::size_t index = 0;                 ///< triangle of `mesh`

    /// Returns whether a point lies on the emitting side.
    bool faces(glm::vec3 point) const { return glm::dot(point - corner, normal) > 0; }
    /// Returns the derivatives of the point that sample() returns, by u.x and u.y.
    std::array<glm::vec3, 2> differentiate(glm::vec2 u) const {
        const float root = std::sqrt(1 - u.x);
        return {(edge1 - u.y * edge2) / (2 * root), root * edge2};
    }
    /// Sets `point` to a point that is uniform on the triangle.
    void sample(glm::vec2 u, LightPoint& point) const {
        const glm::vec2 b = sample_triangle(u);
        point.kind = LightPoint::Kind::surface;
        point.position = corner + b.x * edge1 + b.y * edge2;
        point.normal = normal;
        point.radiance = radiance_map ? radiance_map->evaluate(surface_point(*mesh, index, b)) : radiance;
        point.pdf = pdf_a;
    }
};

/// An emitting quadric. A ball is sampled by the cone of directions in which the receiver sees it, all others by
/// area.
struct LightQuadric {
    const Quadric* quadric;
    Rgb radiance;
    const Texture* radiance_map; ///< textured radiance; null: `radiance` holds
    float probability;           ///< of choosing this light
    std::size_t light;           ///< index of its area light

    /// Sets `point` to a sampled point. Returns false if the light certainly sends nothing to the receiver.
    bool sample(glm::vec3 receiver, glm::vec2 u, LightPoint& point) const;
    /// Returns the derivatives of the point that sample() returns, by u.x and u.y.
    std::array<glm::vec3, 2> differentiate(glm::vec3 receiver, glm::vec2 u) const;
};

/// Derivatives of a sampled light point by the two numbers of Draw::emitter_position. The numbers that choose a
/// light or an environment cell contribute no derivative. See docs/theory.md, "Path differentials".
struct LightDerivatives {
    std::array<glm::vec3, 2> position{}; ///< derivatives of LightPoint::position; 0 if the light has only one
    float chance = 1; ///< probability of the choices; |position[0] x position[1]| / chance = 1 / LightPoint::pdf,
                      ///< except that it is per solid angle at the receiver for a ball
};

/// The lights of a scene. An alias table over all emitting triangles, quadrics and other lights makes the choice
/// independent of their number. A light is chosen in proportion to its power times a learned factor.
class LightTable {
public:
    LightTable() = default;
    /// Keeps pointers into `description`.
    /// @param radius   of the scene's bounding sphere; lights at infinity have power in proportion to its disk
    /// @param factors  factors on the probabilities, in the order of powers(); empty: all 1; 0 removes a light
    LightTable(const SceneDescription& description, float radius, const std::vector<double>& factors = {});

    /// Returns the power of each light in the order of the description: area lights, point lights, directional
    /// lights and the environment. The constructor's factors on probabilities do not change it, except that an
    /// environment with factor 0 has power 0.
    const std::vector<double>& powers() const { return powers_; }

    bool empty() const { return sources_.empty(); }
    std::size_t size() const { return sources_.size(); } ///< number of emitting triangles, quadrics, other lights

    /// Samples a light point with the random numbers of a path vertex. Returns false if the point certainly sends
    /// no light to the receiver. The table must not be empty. The radiance of an environment is left black,
    /// because its look-up is expensive and most directions are occluded; complete() adds it.
    bool sample(glm::vec3 receiver, const Random& random, int vertex, LightPoint& point) const {
        const Source& source = sources_[choice_.choose(random.draw_2d(vertex, Draw::emitter)).index];
        const auto* triangle = std::get_if<LightTriangle>(&source);
        if (!triangle)
            return sample_other(source, receiver, random, vertex, point);
        if (!triangle->faces(receiver))
            return false;
        triangle->sample(random.draw_2d(vertex, Draw::emitter_position), point);
        return true;
    }

    /// Returns the derivatives of the point that sample() chooses with the same arguments.
    LightDerivatives differentiate(glm::vec3 receiver, const Random& random, int vertex) const;

    /// Looks up the environment radiance that sample() left out.
    void complete(LightPoint& point) const {
        if (point.kind == LightPoint::Kind::environment)
            point.radiance = environment_->radiance(point.position);
    }

    /// Returns LightPoint::pdf (per area), which is constant over the triangles of an area light.
    float pdf_a(int area_light) const { return pdf_a_[area_light]; }
    /// Returns the probability of choosing a quadric of an area light.
    float probability_of(const Quadric& quadric, int area_light) const {
        return static_cast<float>(double(pdf_a_[area_light]) * quadric.area());
    }

    /// Returns the light in a unit direction from which a ray leaves the scene; black without an environment.
    LightPoint environment_toward(glm::vec3 direction) const;
    /// Returns whether any light is an emitting surface.
    bool has_surfaces() const { return has_area_lights_; }
    const Environment* environment() const { return environment_.get(); } ///< null: none

    /// Returns whether the ray may meet a light; a conservative test without ray tracing.
    bool may_be_hit(const Ray& ray) const;

    const std::vector<PointLight>& points() const { return points_; }
    const std::vector<DirectionalLight>& directionals() const { return directionals_; }

private:
    struct Point {
        std::size_t index;
        float probability;
    };
    struct Directional {
        std::size_t index;
        float probability;
    };
    struct Infinite {};
    using Source = std::variant<LightTriangle, Point, Directional, Infinite, LightQuadric>;

    void add_shapes(const SceneDescription& description, const std::vector<double>& factors,
                    std::vector<double>& weights);
    bool sample_other(const Source& source, glm::vec3 receiver, const Random& random, int vertex,
                      LightPoint& point) const;

    AliasTable choice_;
    std::vector<Source> sources_;
    std::vector<double> powers_;
    std::vector<float> pdf_a_;
    std::vector<PointLight> points_;
    std::vector<DirectionalLight> directionals_;
    std::shared_ptr<const Environment> environment_;
    float environment_probability_ = 0;
    bool has_area_lights_ = false;
    glm::vec3 low_{0}, high_{0}; // bounding box of the emitting surfaces
};

/// Learns factors on the power of each light for emitter sampling, in the order of LightTable::powers(). Power
/// alone favours an environment around a large scene over lamps in it. So the lights are sampled at the vertices
/// of 144 paths from the camera: the 31 strongest one by one, all weaker ones as one group, which has one factor.
/// Deterministic. Returns an empty vector for fewer than two lights with power, or if no light reaches the paths.
/// See docs/theory.md, "Choice of lights".
std::vector<double> learn_light_selection(const Scene& scene);

} // namespace tessera
