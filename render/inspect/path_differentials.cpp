#include "render/inspect/path_differentials.h"

#include "render/estimator/base_path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// A direction with what it does to light.
struct Scattered {
    glm::vec3 direction;
    float log_value;
};

/// A vertex that may be moved over its triangle, and be seen from a direction that is turned.
class MovableVertex {
public:
    MovableVertex(const Tracer& tracer, const Hit& hit, const Ray& ray) : tracer_(tracer), hit_(hit), ray_(ray) {
        const ShapeRecord& shape = tracer.scene.record(hit.shape);
        const glm::uvec3 t = shape.triangles[hit.triangle];
        edge1_ = shape.positions[t.y] - shape.positions[t.x];
        edge2_ = shape.positions[t.z] - shape.positions[t.x];
        if (hit.placement) {
            edge1_ = hit.placement->vector(edge1_);
            edge2_ = hit.placement->vector(edge2_);
        }
    }

    /// The vertex that lies `position` further, and is met along a direction that differs by `direction`.
    void move(glm::vec3 position, glm::vec3 direction, Vertex& vertex) const {
        Hit hit = hit_;
        hit.barycentric += in_edges(position);
        const glm::vec3 turned = glm::normalize(ray_.direction + direction);
        const glm::vec3 at = ray_.origin + hit.distance * ray_.direction + position;
        make_vertex(tracer_.scene, hit, {at - hit.distance * turned, turned}, vertex);
    }

private:
    glm::vec2 in_edges(glm::vec3 v) const {
        const float aa = glm::dot(edge1_, edge1_), ab = glm::dot(edge1_, edge2_), bb = glm::dot(edge2_, edge2_);
        const float a = glm::dot(v, edge1_), b = glm::dot(v, edge2_), determinant = aa * bb - ab * ab;
        return determinant > 0 ? glm::vec2(bb * a - ab * b, aa * b - ab * a) / determinant : glm::vec2(0);
    }

    const Tracer& tracer_;
    Hit hit_;
    Ray ray_;
    glm::vec3 edge1_, edge2_;
};

/// Follows a path, and carries the derivatives along: of where its ray begins, and of its direction.
class Differentiation {
public:
    Differentiation(const Tracer& tracer, const BasePath& path) : tracer_(tracer), path_(path) {}

    void start(const Projection& projection, glm::vec2 pixel, glm::vec2 lens) {
        ray_ = projection.ray(pixel, lens);
        for (const glm::vec2 half : {glm::vec2(0.5f, 0), glm::vec2(0, 0.5f)}) {
            const Ray more = projection.ray(pixel + half, lens), less = projection.ray(pixel - half, lens);
            origin_.push_back(more.origin - less.origin);
            direction_.push_back(more.direction - less.direction);
            gradient_.push_back(0);
        }
    }

    /// The transfer along the ray [Suykens 2001, A.2]. Empty: it meets something else than the path did.
    std::optional<PathDifferentials::Vertex> arrive(int i) {
        if (!tracer_.scene.intersector().closest(ray_, hit_) ||
            glm::distance(ray_.origin + hit_.distance * ray_.direction, path_[i].vertex.position) >
                1e-3f * hit_.distance)
            return {};
        const glm::vec3 d = ray_.direction, n = path_[i].vertex.geometric_normal;
        const float t = hit_.distance, cosine = glm::dot(d, n);
        PathDifferentials::Vertex x{
            n, {}, gradient_, survival_, t, std::abs(cosine), cosine_before_, kept_angle_, scatter_angle_};
        for (std::size_t j = 0; j < origin_.size(); ++j) {
            const glm::vec3 moved = origin_[j] + t * direction_[j];
            origin_[j] = moved - glm::dot(moved, n) / cosine * d; // the plane is met earlier or later
            x.position.push_back(origin_[j]);
        }
        return x;
    }

    /// The scatter [Suykens 2001, A.3]: each event's own derivatives are differences of its sampling routine, with
    /// the vertex moved and the numbers changed by little. False: the path ends.
    bool scatter(int i) {
        const BaseVertex& x = path_[i];
        if (i + 1 == path_.size())
            return false;
        const MovableVertex vertex(tracer_, hit_, ray_);
        const float roughness = x.is_delta ? 1 : std::clamp(10 * x.vertex.bsdf.roughness(), 0.1f, 1.0f);
        const glm::vec2 u = path_.random.draw_2d(i + 1, Draw::direction);
        for (std::size_t j = 0; j < origin_.size(); ++j) {
            const float speed =
                std::max(glm::length(direction_[j]), glm::length(origin_[j]) / hit_.distance) + 1e-20f;
            const float step = 2e-3f * roughness / speed;
            differ(sample(vertex, i, step * origin_[j], step * direction_[j], u),
                   sample(vertex, i, -step * origin_[j], -step * direction_[j], u), 2 * step, j);
        }
        if (!x.is_delta)
            for (const glm::vec2 axis : {glm::vec2(1, 0), glm::vec2(0, 1)}) {
                constexpr float step = 2e-3f;
                const glm::vec2 more = glm::min(u + step * axis, 0x1.fffffep-1f),
                                less = glm::max(u - step * axis, 0.0f);
                origin_.emplace_back(0);
                direction_.emplace_back(0);
                gradient_.push_back(0);
                differ(sample(vertex, i, glm::vec3(0), glm::vec3(0), more),
                       sample(vertex, i, glm::vec3(0), glm::vec3(0), less), glm::dot(more - less, axis),
                       origin_.size() - 1);
            }
        ray_ = tracer_.leave(x.vertex, x.vertex.to_world(x.to_next));
        cosine_before_ = std::abs(glm::dot(ray_.direction, x.vertex.geometric_normal));
        kept_angle_ = x.is_delta ? 1 : 1 - std::min(x.vertex.bsdf.roughness(), 1.0f);
        scatter_angle_ = x.is_delta ? 0 : std::sqrt(1 / x.pdf_w);
        survival_ *= double(x.survival);
        return true;
    }

private:
    std::optional<Scattered> sample(const MovableVertex& vertex, int i, glm::vec3 position, glm::vec3 direction,
                                    glm::vec2 u) {
        vertex.move(position, direction, moved_);
        moved_.guide = path_[i].vertex.guide;
        const auto s = moved_.sample(path_.random.draw(i + 1, Draw::lobe), u);
        if (!s || s->is_delta != path_[i].is_delta || s->scatter != path_[i].scatter)
            return {};
        return Scattered{moved_.to_world(s->to_next), std::log(luminance(s->f_cos))};
    }

    void differ(const std::optional<Scattered>& more, const std::optional<Scattered>& less, float step,
                std::size_t j) {
        direction_[j] = more && less ? (more->direction - less->direction) / step : glm::vec3(0);
        gradient_[j] += more && less ? (more->log_value - less->log_value) / step : 0;
    }

    const Tracer& tracer_;
    const BasePath& path_;
    Ray ray_{};
    Hit hit_{};
    std::vector<glm::vec3> origin_, direction_; // derivatives by each number
    std::vector<float> gradient_;
    double survival_ = 1;
    float scatter_angle_ = 0, cosine_before_ = 1, kept_angle_ = 1;
    Vertex moved_;
};

/// How large a part of its interval a number stands for at that vertex, whatever light does.
float even_delta(const PathDifferentials::Vertex& x, bool of_pixel, const DeltaRule& rule) {
    const double numbers = static_cast<double>(x.position.size());
    const double even = rule.is_global ? std::pow(rule.samples * x.survival, -1 / numbers)
                        : of_pixel     ? 1 / std::sqrt(rule.samples)
                                       : 1;
    return static_cast<float>(std::min(even, 1.0));
}

/// The same of number j, within which light changes by no more than it may.
float delta(const PathDifferentials::Vertex& x, std::size_t j, const DeltaRule& rule) {
    const float even = even_delta(x, j < 2, rule), change = std::abs(x.gradient[j]);
    return rule.most_change > 0 && change * even > rule.most_change ? rule.most_change / change : even;
}

} // namespace

PathDifferentials differentiate(const Tracer& tracer, const Projection& projection, glm::vec2 pixel,
                                glm::vec2 lens, const BasePath& path) {
    PathDifferentials result{{}, projection.pixel_width()};
    Differentiation along(tracer, path);
    along.start(projection, pixel, lens);
    for (int i = 0; i < path.size(); ++i) {
        const std::optional<PathDifferentials::Vertex> x = along.arrive(i);
        if (!x)
            break;
        result.vertices.push_back(*x);
        if (!along.scatter(i))
            break;
    }
    return result;
}

float Footprint::area() const {
    return glm::length(glm::cross(a, b));
}

std::vector<glm::vec3> differential_vectors(const PathDifferentials& path, int i, const DeltaRule& rule) {
    const PathDifferentials::Vertex& x = path.vertices[static_cast<std::size_t>(i)];
    std::vector<glm::vec3> segments;
    for (std::size_t j = 0; j < x.position.size(); ++j)
        segments.push_back(delta(x, j, rule) * x.position[j]);
    return segments;
}

Footprint footprint(const PathDifferentials& path, int i, const DeltaRule& rule) {
    return reduce(differential_vectors(path, i, rule), path.vertices[static_cast<std::size_t>(i)].normal);
}

Footprint reduce(const std::vector<glm::vec3>& segments, glm::vec3 normal) {
    // A segment has no sign: all are turned to one side, that of the longest.
    const auto longest = std::max_element(segments.begin(), segments.end(), [](glm::vec3 a, glm::vec3 b) {
        return glm::dot(a, a) < glm::dot(b, b);
    });
    glm::vec3 sum(0);
    const auto to_one_side = [&](glm::vec3 v) { return glm::dot(v, *longest) < 0 ? -v : v; };
    for (const glm::vec3 v : segments)
        sum += to_one_side(v);
    const glm::vec3 across = glm::cross(normal, sum);
    Footprint f;
    for (const glm::vec3 v : segments)
        if (glm::dot(to_one_side(v), across) > 0)
            f.a += to_one_side(v);
    f.b = sum - f.a;
    return f;
}

float area_of_sum(const std::vector<glm::vec3>& segments, glm::vec3 normal) {
    float area = 0;
    for (std::size_t i = 0; i < segments.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            area += std::abs(glm::dot(normal, glm::cross(segments[i], segments[j])));
    return area;
}

float scalar_area(const PathDifferentials& path, int i, const DeltaRule& rule) {
    const PathDifferentials::Vertex& end = path.vertices[static_cast<std::size_t>(i)];
    const float of_pixel = even_delta(end, true, rule), of_scatters = even_delta(end, false, rule);
    float width = of_pixel * path.pixel.least, angle = of_pixel * path.pixel.angle;
    for (int k = 0; k <= i; ++k) {
        const PathDifferentials::Vertex& x = path.vertices[static_cast<std::size_t>(k)];
        angle = x.kept_angle * angle + of_scatters * x.scatter_angle;
        // Squares of the same area: across the way from the vertex before, and on the surface.
        width = (width * std::sqrt(x.cosine_before) + angle * x.distance) / std::sqrt(x.cosine);
    }
    return width * width;
}

} // namespace tessera
