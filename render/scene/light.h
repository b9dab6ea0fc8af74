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

/// A mesh that gives off light on its front side, the same in every direction.
struct AreaLight {
    Texture radiance{Rgb(1)};
};

/// Light that arrives from one direction everywhere.
struct DirectionalLight {
    glm::vec3 to_light{0, 0, 1}; ///< unit
    Rgb irradiance{1};           ///< on a surface that faces it
};

/// How a receiver sees a point on a light. (The constructor lets std::make_optional write it in its place.)
struct LightRay {
    glm::vec3 direction; ///< unit, toward the light
    Rgb radiance;        ///< that arrives; of a point the intensity, of a directional light the irradiance
    float pdf_w;         ///< of emitter sampling per solid angle, or what stands for it where light comes from one
                         ///< direction alone: f cos radiance / pdf_w is what emitter sampling brings

    LightRay(glm::vec3 direction_, Rgb radiance_, float pdf_w_)
        : direction(direction_), radiance(radiance_), pdf_w(pdf_w_) {}
};

/// The end of a light path, whoever chose it: emitter sampling, or a ray that happened to meet a light.
struct LightPoint {
    enum class Kind : std::uint8_t { surface, point, directional, environment };
    Kind kind = Kind::surface;
    glm::vec3 position{0}; ///< or, at infinity, the unit direction toward it
    glm::vec3 normal{0};   ///< of a surface: unit, the side that gives light; else 0
    Rgb radiance{0};       ///< given off toward the receiver; of a directional light its irradiance
    float pdf = 0; ///< of emitter sampling: per area, per solid angle (environment) or a probability; does not
                   ///< depend on the receiver
    const PointLight* light = nullptr; ///< of a point

    /// Whether rays can meet it, so that BSDF sampling could have found it, too.
    bool can_be_hit() const { return kind == Kind::surface || kind == Kind::environment; }
    bool is_at_infinity() const { return kind == Kind::directional || kind == Kind::environment; }
    float distance_from(glm::vec3 receiver) const {
        return is_at_infinity() ? std::numeric_limits<float>::infinity() : glm::distance(position, receiver);
    }

    /// The light as a receiver at that point sees it, without what may stand between; empty: no light goes that
    /// way.
    std::optional<LightRay> seen_from(glm::vec3 receiver) const {
        if (kind != Kind::surface)
            return seen_without_surface(receiver);
        const glm::vec3 d = position - receiver;
        const float facing = -glm::dot(d, normal); // cos times the distance
        if (!(facing > 0))
            return {};
        const float distance2 = glm::dot(d, d);
        if (!(distance2 > 0))
            return {};
        const float distance = std::sqrt(distance2);
        return std::make_optional<LightRay>(d / distance, radiance, pdf * distance2 * distance / facing);
    }

private:
    std::optional<LightRay> seen_without_surface(glm::vec3 receiver) const;
};

/// An emitting triangle.
struct LightTriangle {
    glm::vec3 corner, edge1, edge2;
    glm::vec3 normal; ///< unit, the side that gives light
    Rgb radiance;
    float pdf_a;       ///< of choosing this triangle and a point on it, per area
    std::size_t light; ///< index of its area light

    // Where radiance varies, its texture is looked up, for which one must know which triangle of which mesh this
    // is.
    const Texture* radiance_map = nullptr;
    const Mesh* mesh = nullptr;
    std::size_t index = 0;

    /// Whether it sends light toward a point, from anywhere on it.
    bool faces(glm::vec3 point) const { return glm::dot(point - corner, normal) > 0; }
    /// Of the point that sample() takes, by both numbers.
    std::array<glm::vec3, 2> differentiate(glm::vec2 u) const {
        const float root = std::sqrt(1 - u.x);
        return {(edge1 - u.y * edge2) / (2 * root), root * edge2};
    }
    void sample(glm::vec2 u, LightPoint& point) const {
        const glm::vec2 b = sample_triangle(u);
        point.kind = LightPoint::Kind::surface;
        point.position = corner + b.x * edge1 + b.y * edge2;
        point.normal = normal;
        point.radiance = radiance_map ? radiance_map->evaluate(surface_point(*mesh, index, b)) : radiance;
        point.pdf = pdf_a;
    }
};

/// How a point that emitter sampling draws moves with the two numbers that say where on its light it lies
/// (Draw::emitter_position), which is all that moves it: those of the choice among lights, and among the cells of
/// an environment, make steps.
struct LightDerivatives {
    std::array<glm::vec3, 2>
        position{};   ///< of LightPoint::position: at infinity of the direction; 0 0: there is but one
    float chance = 1; ///< of these choices; the area of both vectors together over that is 1 / LightPoint::pdf
};

/// The lights of a scene, chosen in proportion to their power and factors on it, by an alias table over all
/// emitting triangles and all other lights: the choice costs the same for one and for thousands.
class LightTable {
public:
    LightTable() = default;
    /// Keeps pointers into the description. `radius` is that of a sphere around the scene: light from infinity has
    /// power in proportion to its disk. Each light is chosen in proportion to its power times its factor, in the
    /// order of powers(); no factors: to its power. A light of factor 0 is not there.
    LightTable(const SceneDescription& description, float radius, const std::vector<double>& factors = {});

    /// Of each light, whether or not it has a factor: area lights, then points, directional lights, and the
    /// environment, in the order of the description.
    const std::vector<double>& powers() const { return powers_; }

    bool empty() const { return sources_.empty(); }
    std::size_t size() const { return sources_.size(); } ///< emitting triangles and other lights

    /// Chooses a point of a light with the numbers of a path's vertex. False: it surely sends no light to the
    /// receiver. Not for an empty table. Of the environment the radiance is left black, as it is dear, and most
    /// directions turn out to be blocked: complete() looks it up. (In place: this is where paths spend their
    /// time.)
    bool sample(glm::vec3 receiver, const Random& random, int vertex, LightPoint& point) const {
        const Source& source = sources_[choice_.choose(random.draw_2d(vertex, Draw::emitter)).index];
        const auto* triangle = std::get_if<LightTriangle>(&source);
        if (!triangle)
            point = sample_other(source, random, vertex);
        else if (triangle->faces(receiver))
            triangle->sample(random.draw_2d(vertex, Draw::emitter_position), point);
        else
            return false;
        return true;
    }

    /// Of the point that sample() chooses with these numbers.
    LightDerivatives differentiate(const Random& random, int vertex) const;

    /// Looks up the radiance that sample() has left out.
    void complete(LightPoint& point) const {
        if (point.kind == LightPoint::Kind::environment)
            point.radiance = environment_->radiance(point.position);
    }

    /// LightPoint::pdf at any point of an area light.
    float pdf_a(int area_light) const { return pdf_a_[area_light]; }

    /// What a ray meets that leaves the scene in a unit direction. Black without an environment.
    LightPoint environment_toward(glm::vec3 direction) const;
    const Environment* environment() const { return environment_.get(); } ///< null: none

    /// Whether the ray may meet a light: cheaper than tracing it, where only lights count.
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
    using Source = std::variant<LightTriangle, Point, Directional, Infinite>;

    void add_triangles(const SceneDescription& description, const std::vector<double>& factors,
                       std::vector<double>& weights);
    LightPoint sample_other(const Source& source, const Random& random, int vertex) const;

    AliasTable choice_;
    std::vector<Source> sources_;
    std::vector<double> powers_;
    std::vector<float> pdf_a_;
    std::vector<PointLight> points_;
    std::vector<DirectionalLight> directionals_;
    std::shared_ptr<const Environment> environment_;
    float environment_probability_ = 0;
    bool has_triangles_ = false;
    glm::vec3 low_{0}, high_{0}; // of the emitting triangles
};

/// How often emitter sampling should choose each light, beside its power: factors on that, in the order of
/// LightTable::powers(). Learnt from some hundred paths from the scene's camera, at whose ends every light is
/// tried: by power alone, an environment around a large scene takes all samples from two spots in it. Empty: there
/// is one light at most, or none that could be seen to bring anything. The same for any number of threads.
std::vector<double> learn_light_factors(const Scene& scene);

} // namespace tessera
