// Path differentials against paths of which one random number is moved by little.
#include "render/estimator/base_path.h"
#include "render/inspect/path_differentials.h"
#include "tests/support/rooms.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(64, 48);

/// Where a path goes by given numbers: two for the pixel, two for each scatter. It is cut short where a lobe that
/// was chosen is another one, or where nothing is met.
struct Numbers {
    std::vector<float> u;
    std::vector<float> lobes;
    std::vector<bool> is_delta;
};

Numbers numbers_of(const BasePath& path, glm::vec2 pixel) {
    Numbers n{{pixel.x, pixel.y}, {}, {}};
    for (int i = 0; i + 1 < path.size(); ++i) {
        n.lobes.push_back(path.random.draw(i + 1, Draw::lobe));
        n.is_delta.push_back(path[i].is_delta);
        const glm::vec2 u = path.random.draw_2d(i + 1, Draw::direction);
        if (!path[i].is_delta)
            n.u.insert(n.u.end(), {u.x, u.y});
    }
    return n;
}

struct Place {
    glm::vec3 position, normal;
};

std::vector<Place> replay(const Tracer& tracer, const Projection& projection, const Numbers& n) {
    std::vector<Place> places;
    Vertex x;
    Ray ray = projection.ray({n.u[0], n.u[1]});
    std::size_t used = 2;
    for (std::size_t i = 0; tracer.closest(ray, x, RayKind::bounce); ++i) {
        places.push_back({x.position, x.geometric_normal});
        if (i == n.lobes.size())
            break;
        const glm::vec2 u = n.is_delta[i] ? glm::vec2(0.5f) : glm::vec2(n.u[used], n.u[used + 1]);
        used += n.is_delta[i] ? 0 : 2;
        const auto s = x.bsdf.sample(x.to_previous, n.lobes[i], u);
        if (!s || s->is_delta != n.is_delta[i])
            break;
        ray = tracer.leave(x, x.to_world(s->to_next));
    }
    return places;
}

/// Derivative of vertex i by number j. Empty: paths nearby leave its surface, or it is not linear there.
std::optional<glm::vec3> measured(const Tracer& tracer, const Projection& projection, const Numbers& n,
                                  std::size_t i, std::size_t j, float step) {
    const auto at = [&](float by) -> std::optional<Place> {
        Numbers moved = n;
        moved.u[j] += by;
        if (j >= 2 && (moved.u[j] <= 0 || moved.u[j] >= 1))
            return {};
        const std::vector<Place> places = replay(tracer, projection, moved);
        return i < places.size() ? std::optional(places[i]) : std::nullopt;
    };
    const auto middle = at(0), less = at(-step), more = at(step);
    if (!middle || !less || !more || glm::dot(less->normal, more->normal) < 0.99999f ||
        glm::dot(middle->normal, more->normal) < 0.99999f)
        return {};
    const glm::vec3 right = (more->position - middle->position) / step,
                    left = (middle->position - less->position) / step;
    if (glm::length(right - left) > 0.05f * glm::length(right + left))
        return {};
    return 0.5f * (right + left);
}

struct Tally {
    std::vector<double> errors;
    /// What that share of them is below; they are sorted.
    double below(double share) const { return errors[static_cast<std::size_t>(share * double(errors.size()))]; }
};

template <class Visit>
void for_paths(const Scene& scene, Visit&& visit) {
    Counters counters;
    const Tracer tracer{scene, counters, {6, 1, 0}};
    const Projection projection(scene.camera(), size);
    for (std::uint32_t i = 0; i < 400; ++i) {
        const Random random(11, i, 0);
        const glm::vec2 pixel = random.draw_2d(0, Draw::direction) * glm::vec2(size);
        BasePath path;
        trace_base_path(tracer, projection.ray(pixel), projection.pixel_width(), random, path);
        visit(tracer, projection, pixel, path, differentiate(tracer, projection, pixel, glm::vec2(0), path));
    }
}

Tally compare(const Scene& scene) {
    Tally tally;
    for_paths(scene, [&](const Tracer& tracer, const Projection& projection, glm::vec2 pixel, const BasePath& path,
                         const PathDifferentials& d) {
        const Numbers n = numbers_of(path, pixel);
        for (std::size_t i = 0; i < d.vertices.size(); ++i)
            for (std::size_t j = 0; j < d.vertices[i].position.size(); ++j) {
                const auto truth = measured(tracer, projection, n, i, j, j < 2 ? 0.05f : 5e-4f);
                // Tiny ones are rounding.
                if (truth && glm::length(*truth) * (j < 2 ? 0.05f : 5e-4f) > 2e-4f)
                    tally.errors.push_back(double(glm::distance(*truth, d.vertices[i].position[j])) /
                                           double(glm::length(*truth)));
            }
    });
    return tally;
}

TEST(PathDifferentials, AreThoseOfPathsThatAreReplayed) {
    const auto judge = [](const char* name, const std::shared_ptr<const Scene>& scene) {
        Tally t = compare(*scene);
        ASSERT_GT(t.errors.size(), 500u) << name;
        std::sort(t.errors.begin(), t.errors.end());
        std::printf("%s: %zu derivatives, median %.2g, 99 %% below %.2g\n", name, t.errors.size(), t.below(0.5),
                    t.below(0.99));
        EXPECT_LT(t.below(0.5), 1e-3) << name;
        EXPECT_LT(t.below(0.99), 0.05) << name;
    };
    judge("diffuse", Room().build());
    {
        Room r;
        r.sphere({-0.4f, -0.5f, 0}, 0.4f, r.mirror());
        r.sphere({0.5f, -0.5f, 0.2f}, 0.4f, r.glass());
        judge("mirror and glass", r.build());
    }
    {
        Room r;
        r.quad({-1, -0.99f, 1}, {2, 0, 0}, {0, 0, -2}, r.conductor(0.2f));
        r.sphere({-0.4f, -0.5f, 0}, 0.4f, r.phong(Rgb(0.3f), Rgb(0.4f), 40));
        r.sphere({0.5f, -0.5f, 0.2f}, 0.4f, r.plastic(Rgb(0.3f), 0.1f));
        judge("metal, Phong, plastic", r.build());
    }
}

TEST(PathDifferentials, ReducedSumsKeepMostOfTheirArea) {
    for (std::uint32_t i = 0; i < 300; ++i) {
        std::vector<glm::vec3> segments;
        for (int j = 0; j < 2 + int(i % 7); ++j) {
            const glm::vec2 u = Random(5, i, 0).draw_2d(j, Draw::direction) - 0.5f;
            segments.emplace_back(u, 0);
        }
        const float all = area_of_sum(segments, {0, 0, 1}), two = reduce(segments, {0, 0, 1}).area();
        EXPECT_LE(two, all * 1.0001f);
        if (segments.size() == 2) {
            EXPECT_NEAR(two, all, 1e-5f);
        } else {
            EXPECT_GT(two, 0.3f * all);
        }
    }
}

/// A pixel's footprint at x_1 is what lies between its neighbours.
TEST(PathDifferentials, AtTheFirstVertexCoverAPixel) {
    int count = 0;
    for_paths(*Room().build(), [&](const Tracer&, const Projection& projection, glm::vec2 pixel, const BasePath&,
                                   const PathDifferentials& d) {
        if (d.vertices.empty())
            return;
        ++count;
        const PathDifferentials::Vertex& x = d.vertices[0];
        const auto at = [&](glm::vec2 p) {
            const Ray ray = projection.ray(pixel + p), middle = projection.ray(pixel);
            const glm::vec3 point = middle.origin + x.distance * middle.direction;
            return ray.origin +
                   ray.direction * (glm::dot(point - ray.origin, x.normal) / glm::dot(ray.direction, x.normal));
        };
        const float area = glm::length(glm::cross(at({1, 0}) - at({0, 0}), at({0, 1}) - at({0, 0})));
        EXPECT_NEAR(footprint(d, 0, {}).area() / area, 1, 0.15f);
        EXPECT_NEAR(footprint(d, 0, {16}).area() / footprint(d, 0, {}).area(), 1.0 / 16, 1e-3);
        EXPECT_LE(footprint(d, 0, {1, true, 0.1f}).area(), footprint(d, 0, {}).area());
    });
    EXPECT_GT(count, 300);
}

} // namespace

} // namespace tessera::test
