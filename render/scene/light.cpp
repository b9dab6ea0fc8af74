#include "render/scene/light.h"

#include "render/sampling/sampling.h"
#include "render/scene/scene.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

std::optional<LightRay> LightPoint::seen_without_surface(glm::vec3 receiver) const {
    if (is_at_infinity())
        return LightRay{position, radiance, pdf};
    const glm::vec3 d = position - receiver;
    const float distance2 = glm::dot(d, d);
    if (!(distance2 > 0))
        return {};
    const glm::vec3 direction = d / std::sqrt(distance2);
    const Rgb intensity = light->toward(-direction);
    if (is_black(intensity))
        return {};
    return LightRay{direction, intensity, pdf * distance2};
}

LightTable::LightTable(const SceneDescription& description, float radius, const std::vector<double>& factors)
    : pdf_a_(description.area_lights.size(), 0.0f), points_(description.point_lights),
      directionals_(description.directional_lights) {
    std::vector<double> weights; // of sources_
    powers_.resize(description.area_lights.size(), 0.0);
    add_shapes(description, factors, weights);
    const auto add = [&](Source source, double watts) {
        const double weight = watts * (factors.empty() ? 1.0 : factors[powers_.size()]);
        powers_.push_back(watts);
        if (!(weight > 0))
            return;
        sources_.push_back(source);
        weights.push_back(weight);
    };
    const double disk = double(pi) * radius * radius; // area through which light from infinity enters the scene
    for (std::size_t i = 0; i < points_.size(); ++i)
        add(Point{i, 0}, points_[i].power());
    for (std::size_t i = 0; i < directionals_.size(); ++i)
        add(Directional{i, 0}, disk * luminance(directionals_[i].irradiance));
    if (!description.environment.empty() && (factors.empty() || factors[powers_.size()] > 0)) {
        environment_ = std::make_shared<const Environment>(description.environment);
        add(Infinite{}, disk * environment_->flux());
    } else {
        powers_.push_back(0);
    }

    choice_ = AliasTable(weights);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (std::size_t i = 0; i < pdf_a_.size() && total > 0; ++i)
        pdf_a_[i] = static_cast<float>((factors.empty() ? 1.0 : factors[i]) * double(pi) *
                                       luminance(description.area_lights[i].radiance.mean()) / total);
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        const float probability = choice_.probability(i);
        if (auto* triangle = std::get_if<LightTriangle>(&sources_[i]))
            triangle->pdf_a = pdf_a_[triangle->light];
        else if (auto* quadric = std::get_if<LightQuadric>(&sources_[i]))
            quadric->probability = probability_of(*quadric->quadric, static_cast<int>(quadric->light));
        else if (auto* point = std::get_if<Point>(&sources_[i]))
            point->probability = probability;
        else if (auto* directional = std::get_if<Directional>(&sources_[i]))
            directional->probability = probability;
        else if (std::holds_alternative<Infinite>(sources_[i]))
            environment_probability_ = probability;
    }
}

namespace {

/// Returns an area light's texture, or null if the radiance is constant.
const Texture* map_of(const AreaLight& light) {
    return light.radiance.is_constant() ? nullptr : &light.radiance;
}

} // namespace

/// Adds the emitting triangles and quadrics. Points have equal density over all triangles of a light, in
/// proportion to its mean radiance.
void LightTable::add_shapes(const SceneDescription& description, const std::vector<double>& factors,
                            std::vector<double>& weights) {
    low_ = glm::vec3(std::numeric_limits<float>::max());
    high_ = glm::vec3(std::numeric_limits<float>::lowest());
    std::vector<Rgb> mean;
    for (const AreaLight& light : description.area_lights)
        mean.push_back(light.radiance.mean());
    for (const Shape& shape : description.shapes) {
        if (shape.area_light < 0)
            continue;
        const auto light = static_cast<std::size_t>(shape.area_light);
        const Texture* map = map_of(description.area_lights[light]);
        /// Returns the weight of an area, and adds its power.
        const auto weigh = [&](double area) {
            const double watts = double(pi) * area * luminance(mean[light]);
            powers_[light] += watts > 0 ? watts : 0;
            return watts * (factors.empty() ? 1.0 : factors[light]);
        };
        const auto add = [&](const Source& source, double weight, std::initializer_list<glm::vec3> corners) {
            sources_.push_back(source);
            weights.push_back(weight);
            has_area_lights_ = true;
            for (const glm::vec3 p : corners) {
                low_ = glm::min(low_, p);
                high_ = glm::max(high_, p);
            }
        };
        if (shape.quadric) {
            const Quadric::Bounds bounds = shape.quadric->bounds();
            if (const double weight = weigh(shape.quadric->area()); weight > 0)
                add(LightQuadric{&*shape.quadric, mean[light], map, 0, light}, weight, {bounds.low, bounds.high});
        }
        const Mesh& mesh = shape.mesh;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const glm::uvec3 t = mesh.triangles[i];
            LightTriangle triangle;
            triangle.corner = mesh.positions[t.x];
            triangle.edge1 = mesh.positions[t.y] - triangle.corner;
            triangle.edge2 = mesh.positions[t.z] - triangle.corner;
            const double area2 = glm::length(glm::cross(glm::dvec3(triangle.edge1), glm::dvec3(triangle.edge2)));
            const double weight = weigh(0.5 * area2);
            if (!(weight > 0))
                continue;
            triangle.normal = front_normal(mesh, t);
            triangle.radiance = mean[light];
            triangle.light = light;
            if (map) {
                triangle.radiance_map = map;
                triangle.mesh = &mesh;
                triangle.index = i;
            }
            add(triangle, weight,
                {triangle.corner, triangle.corner + triangle.edge1, triangle.corner + triangle.edge2});
        }
    }
    // The margin keeps rounding from missing a flat box.
    const glm::vec3 margin = 1e-4f * (glm::max(glm::abs(low_), glm::abs(high_)));
    low_ -= margin;
    high_ += margin;
}

bool LightTable::sample_other(const Source& source, glm::vec3 receiver, const Random& random, int vertex,
                              LightPoint& point) const {
    using Kind = LightPoint::Kind;
    const auto position = [&] { return random.draw_2d(vertex, Draw::emitter_position); };
    if (const auto* quadric = std::get_if<LightQuadric>(&source))
        return quadric->sample(receiver, position(), point);
    if (const auto* chosen = std::get_if<Point>(&source)) {
        const PointLight& light = points_[chosen->index];
        point = {Kind::point, light.position, glm::vec3(0), light.intensity, chosen->probability, &light};
    } else if (const auto* directional = std::get_if<Directional>(&source)) {
        const DirectionalLight& light = directionals_[directional->index];
        point = {Kind::directional, light.to_light, glm::vec3(0), light.irradiance, directional->probability};
    } else {
        const EnvironmentSample drawn =
            environment_->sample(random.draw_2d(vertex, Draw::emitter_cell), position());
        point = {Kind::environment, drawn.direction, glm::vec3(0), Rgb(0), environment_probability_ * drawn.pdf_w};
    }
    return true;
}

LightPoint LightTable::environment_toward(glm::vec3 direction) const {
    LightPoint light{LightPoint::Kind::environment, direction, glm::vec3(0), Rgb(0), 0};
    if (environment_ && glm::dot(direction, direction) > 0.5f) { // guards against a zero or NaN direction
        const EnvironmentLight arriving = environment_->look_up(direction);
        light.radiance = arriving.radiance;
        light.pdf = environment_probability_ * arriving.pdf_w;
    }
    return light;
}

bool LightTable::may_be_hit(const Ray& ray) const {
    if (environment_)
        return true;
    if (!has_area_lights_)
        return false;
    // Slab test [Kay and Kajiya 1986]. 0 / 0 (NaN) arises only for a ray within a face of the padded box, where
    // there are no emitters, or only emitters seen edge-on.
    const glm::vec3 a = (low_ - ray.origin) / ray.direction, b = (high_ - ray.origin) / ray.direction;
    float enter = 0, leave = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) {
        enter = std::max(enter, std::min(a[axis], b[axis]));
        leave = std::min(leave, std::max(a[axis], b[axis]));
    }
    return enter <= leave;
}

LightDerivatives LightTable::differentiate(glm::vec3 receiver, const Random& random, int vertex) const {
    const AliasTable::Choice chosen = choice_.choose(random.draw_2d(vertex, Draw::emitter));
    const glm::vec2 u = random.draw_2d(vertex, Draw::emitter_position);
    if (const auto* triangle = std::get_if<LightTriangle>(&sources_[chosen.index]))
        return {triangle->differentiate(u), chosen.probability};
    if (const auto* quadric = std::get_if<LightQuadric>(&sources_[chosen.index]))
        return {quadric->differentiate(receiver, u), chosen.probability};
    if (!std::holds_alternative<Infinite>(sources_[chosen.index]))
        return {{}, chosen.probability};
    const EnvironmentDerivatives d = environment_->differentiate(random.draw_2d(vertex, Draw::emitter_cell), u);
    return {d.direction, chosen.probability * d.cell_probability};
}

} // namespace tessera
