// Path differentials, compared with finite differences of replayed paths in one random number.
#include "render/inspect/path_differentials.h"
#include "render/paths/base_path.h"
#include "tests/support/rooms.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr glm::ivec2 size(64, 48);

/// Random numbers of a path: two for the pixel, two for each non-delta scattering event, and the lobe choices.
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
    float log_value; ///< natural logarithm of the product of f cos of the scattering events before the vertex
};

/// Traces the path of these numbers. It ends early if a ray misses the scene or a sample changes between delta and
/// non-delta.
std::vector<Place> replay(const Tracer& tracer, const Projection& projection, const Numbers& n) {
    std::vector<Place> places;
    Vertex x;
    Ray ray = projection.ray({n.u[0], n.u[1]});
    std::size_t used = 2;
    float log_value = 0;
    for (std::size_t i = 0; tracer.closest(ray, x, RayKind::bounce, tracer.lookup()); ++i) {
        places.push_back({x.position, x.geometric_normal, log_value});
        if (i == n.lobes.size())
            break;
        const glm::vec2 u = n.is_delta[i] ? glm::vec2(0.5f) : glm::vec2(n.u[used], n.u[used + 1]);
        used += n.is_delta[i] ? 0 : 2;
        const auto s = x.bsdf.sample(x.to_previous, n.lobes[i], u);
        if (!s || s->is_delta != n.is_delta[i])
            break;
        log_value += std::log(luminance(s->f_cos));
        ray = tracer.leave(x, x.to_world(s->to_next));
    }
    return places;
}

/// Derivatives of vertex i with respect to number j, by finite differences.
struct Measured {
    glm::vec3 position;
    float gradient;
};

/// Returns empty if neighbouring paths leave the surface, or the position is not linear in the number.
std::optional<Measured> measured(const Tracer& tracer, const Projection& projection, const Numbers& n,
                                 std::size_t i, std::size_t j, float step) {
    const auto at = [&](float offset) -> std::optional<Place> {
        Numbers moved = n;
        moved.u[j] += offset;
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
    return Measured{0.5f * (right + left), (more->log_value - less->log_value) / (2 * step)};
}

struct Tally {
    std::vector<double> errors, gradient_errors;
};

/// Returns the quantile of the numbers. `probability` is in [0, 1).
double quantile(std::vector<double>& numbers, double probability) {
    std::sort(numbers.begin(), numbers.end());
    return numbers[static_cast<std::size_t>(probability * double(numbers.size()))];
}

/// Base path with the derivatives of its vertices.
struct Differentiated {
    const Tracer& tracer;
    const Projection& projection;
    glm::vec2 pixel;
    BasePath path;
    std::vector<PathDerivatives> vertices;
};

template <class Visit>
void for_paths(const Scene& scene, Visit&& visit) {
    Counters counters;
    std::vector<Hit> hits;
    const Tracer tracer{scene, counters, {6, 0}, {}, nullptr, &hits};
    const Projection projection(scene.camera(), size);
    Differentiation along;
    for (std::uint32_t i = 0; i < 400; ++i) {
        const Random random(11, i, 0);
        Differentiated d{tracer, projection, random.draw_2d(0, Draw::direction) * glm::vec2(size), {}, {}};
        hits.clear();
        trace_base_path(tracer, projection.ray(d.pixel), projection.pixel_width(), random, d.path);
        differentiate(scene, projection, d.pixel, glm::vec2(0), d.path, hits, along,
                      [&](int, const PathDerivatives& x) { d.vertices.push_back(x); });
        visit(d);
    }
}

Tally compare(const Scene& scene) {
    Tally tally;
    for_paths(scene, [&](const Differentiated& d) {
        const Numbers n = numbers_of(d.path, d.pixel);
        for (std::size_t i = 0; i < d.vertices.size(); ++i)
            for (int k = 0; k < d.vertices[i].count; ++k) {
                const auto j = static_cast<std::size_t>(k);
                const auto truth = measured(d.tracer, d.projection, n, i, j, j < 2 ? 0.05f : 5e-4f);
                // Tiny derivatives are dominated by rounding.
                if (!truth || glm::length(truth->position) * (j < 2 ? 0.05f : 5e-4f) <= 2e-4f)
                    continue;
                tally.errors.push_back(double(glm::distance(truth->position, d.vertices[i].position[k])) /
                                       double(glm::length(truth->position)));
                if (std::abs(truth->gradient) > (j < 2 ? 0.01f : 0.3f))
                    tally.gradient_errors.push_back(
                        std::abs(double(d.vertices[i].gradient[j]) / double(truth->gradient) - 1));
            }
    });
    return tally;
}

TEST(PathDifferentials, MatchReplayedPaths) {
    const auto expect_accurate = [](const char* name, const std::shared_ptr<const Scene>& scene) {
        Tally t = compare(*scene);
        ASSERT_GT(t.errors.size(), 500u) << name;
        ASSERT_GT(t.gradient_errors.size(), 200u) << name;
        std::printf(
            "%s: %zu derivatives, median %.2g, 99 %% below %.2g; %zu gradients, median %.2g, 90 %% below %.2g\n",
            name, t.errors.size(), quantile(t.errors, 0.5), quantile(t.errors, 0.99), t.gradient_errors.size(),
            quantile(t.gradient_errors, 0.5), quantile(t.gradient_errors, 0.9));
        EXPECT_LT(quantile(t.errors, 0.5), 2e-4) << name;
        EXPECT_LT(quantile(t.errors, 0.95), 2e-3) << name;
        EXPECT_LT(quantile(t.errors, 0.99), 0.03) << name;
        EXPECT_LT(quantile(t.gradient_errors, 0.5), 1e-3) << name;
        EXPECT_LT(quantile(t.gradient_errors, 0.9), 0.01) << name;
    };
    expect_accurate("diffuse", Room().build());
    {
        Room r;
        r.sphere({-0.4f, -0.5f, 0}, 0.4f, r.mirror());
        r.sphere({0.5f, -0.5f, 0.2f}, 0.4f, r.glass());
        expect_accurate("mirror and glass", r.build());
    }
    {
        Room r;
        r.quad({-1, -0.99f, 1}, {2, 0, 0}, {0, 0, -2}, r.conductor(0.2f));
        r.sphere({-0.4f, -0.5f, 0}, 0.4f, r.phong(Rgb(0.3f), Rgb(0.4f), 40));
        r.sphere({0.5f, -0.5f, 0.2f}, 0.4f, r.plastic(Rgb(0.3f), 0.1f));
        expect_accurate("metal, Phong, plastic", r.build());
    }
    {
        Room r;
        r.ball({-0.4f, -0.5f, 0}, 0.4f, r.mirror());
        r.ball({0.5f, -0.5f, 0.2f}, 0.4f, r.plastic(Rgb(0.3f), 0.1f));
        glm::mat4 tube(0.3f);
        tube[3] = {-0.5f, 0.3f, -0.4f, 1};
        r.quadric(Quadric(Quadric::Kind::cylinder, tube, false), r.diffuse(white));
        expect_accurate("quadrics", r.build());
    }
}

TEST(PathDifferentials, ReducedSumsKeepMostOfTheirArea) {
    for (std::uint32_t i = 0; i < 300; ++i) {
        NumberVectors segments{};
        const int count = 2 + int(i % 7);
        for (int j = 0; j < count; ++j)
            segments.set(j, glm::vec3(Random(5, i, 0).draw_2d(j, Draw::direction) - 0.5f, 0));
        const float all = area_of_sum(segments, count, {0, 0, 1}), two = reduce(segments, count, {0, 0, 1}).area();
        EXPECT_LE(two, all * 1.0001f);
        if (count == 2) {
            EXPECT_NEAR(two, all, 1e-5f);
        } else {
            EXPECT_GT(two, 0.3f * all);
        }
    }
}

/// A pixel's footprint at x_1 is the parallelogram between the points that neighbouring pixels see.
TEST(PathDifferentials, CoverAPixelAtTheFirstVertex) {
    int count = 0;
    for_paths(*Room().build(), [&](const Differentiated& d) {
        if (d.vertices.empty())
            return;
        ++count;
        const PathDerivatives& x = d.vertices[0];
        const glm::vec3 point = d.path[0].vertex.position;
        const auto at = [&](glm::vec2 p) {
            const Ray ray = d.projection.ray(d.pixel + p);
            return ray.origin +
                   ray.direction * (glm::dot(point - ray.origin, x.normal) / glm::dot(ray.direction, x.normal));
        };
        const float area = glm::length(glm::cross(at({1, 0}) - at({0, 0}), at({0, 1}) - at({0, 0})));
        EXPECT_NEAR(footprint(x, {}).area() / area, 1, 0.15f);
        EXPECT_NEAR(footprint(x, {16}).area() / footprint(x, {}).area(), 1.0 / 16, 1e-3);
    });
    EXPECT_GT(count, 300);
}

/// Local deltas follow 1/sqrt(samples) and 1/sqrt(splits). With most_change, the light of a path changes by at
/// most that fraction.
TEST(PathDifferentials, DeltasFollowTheirRules) {
    int count = 0, limited = 0;
    for_paths(*Room().build(), [&](const Differentiated& d) {
        for (const PathDerivatives& x : d.vertices) {
            const NumberVectors local = differential_vectors(x, {16, false}),
                                split = differential_vectors(x, {16, false, 0, 4}),
                                all = differential_vectors(x, {16, true}),
                                limited_change = differential_vectors(x, {16, true, 0.1f});
            const float even = std::pow(16 * x.chance, -1.0f / static_cast<float>(x.count));
            for (int j = 0; j < x.count; ++j, ++count) {
                const float whole = glm::length(x.position[j]);
                if (!(whole > 0))
                    continue;
                EXPECT_NEAR(glm::length(local[j]) / whole, j < 2 ? 0.25f : 1, 1e-4f);
                EXPECT_NEAR(glm::length(split[j]) / whole, j < 2 ? 0.25f : 0.5f, 1e-4f);
                EXPECT_NEAR(glm::length(all[j]) / whole, std::min(even, 1.0f), 1e-4);
                const float change =
                    std::abs(x.gradient[static_cast<std::size_t>(j)]) * glm::length(limited_change[j]) / whole;
                EXPECT_LE(change, 0.1f * 1.0001f);
                limited += glm::length(limited_change[j]) < 0.999f * glm::length(all[j]);
            }
        }
    });
    EXPECT_GT(count, 1000);
    EXPECT_GT(limited, 100);
}

/// The scalar form approximates the area of the sum of all vectors, if all surfaces are diffuse and flat.
TEST(PathDifferentials, ScalarFormApproximatesAreas) {
    for (const std::size_t i : {0, 1}) {
        std::vector<double> ratios;
        std::vector<float> widths;
        for_paths(*Room().build(), [&](const Differentiated& d) {
            if (i >= d.vertices.size())
                return;
            const PathDerivatives& x = d.vertices[i];
            const float all = area_of_sum(differential_vectors(x, {}), x.count, x.normal);
            scalar_footprints(d.path, d.projection.pixel_width(), d.projection.ray(d.pixel).origin, 0, widths);
            if (all > 0)
                ratios.push_back(double(widths[i] * widths[i] / all));
        });
        ASSERT_GT(ratios.size(), 200u);
        // At x_1, it uses the pixel in the middle of the picture, which is the largest.
        EXPECT_NEAR(quantile(ratios, 0.5), 1, i == 0 ? 0.25 : 0.15) << i;
    }
}

/// The choice probability is 1 for a BSDF with one lobe. For lobes that do not overlap, it is the probability of
/// the sampled lobe.
TEST(PathDifferentials, LobeChoicesHaveTheirProbabilities) {
    Room r;
    r.quad({-1, -0.99f, 1}, {2, 0, 0}, {0, 0, -2}, r.conductor(0.3f));
    r.sphere({-0.4f, -0.5f, 0}, 0.4f, r.plastic(Rgb(0.3f), 0));
    r.sphere({0.5f, -0.5f, 0.2f}, 0.4f, r.glass());
    std::vector<double> alone;
    int coated = 0, delta = 0;
    for_paths(*r.build(), [&](const Differentiated& d) {
        float chance = 1;
        for (std::size_t i = 0; i + 1 < d.vertices.size(); ++i) {
            const BaseVertex& x = d.path[int(i)];
            const PathDerivatives& next = d.vertices[i + 1];
            if (x.is_delta) {
                chance *= x.pdf_w;
                ++delta;
            } else {
                const float choice = next.choice[static_cast<std::size_t>(next.count - 1)];
                if (const auto* plastic = std::get_if<Plastic>(&x.vertex.bsdf.kind)) {
                    const float base =
                        1 - x.vertex.bsdf.evaluate_delta(x.vertex.to_previous, Scatter::reflect).probability;
                    EXPECT_EQ(plastic->facets.alpha, 0);
                    EXPECT_NEAR(choice / base, 1, 2e-3f);
                    ++coated;
                } else {
                    alone.push_back(double(1 - choice));
                }
                chance *= choice;
            }
            EXPECT_NEAR(next.chance / chance, 1, 1e-4f);
        }
    });
    ASSERT_GT(alone.size(), 500u);
    EXPECT_LT(quantile(alone, 0.95), 1e-3) << "except at kinks of the mapping to disks";
    EXPECT_GT(coated, 20);
    EXPECT_GT(delta, 20);
}

/// The gradient of a light sample is the derivative of its log contribution with respect to its two random
/// numbers.
TEST(PathDifferentials, LightSamplesHaveGradients) {
    Room r;
    r.quad({-1, -0.99f, 1}, {2, 0, 0}, {0, 0, -2}, r.conductor(0.3f));
    std::vector<double> errors;
    for_paths(*r.build(), [&](const Differentiated& d) {
        for (int i = 0; i < d.path.size(); ++i) {
            const LightSample& drawn = d.path.light(i);
            if (is_black(drawn.brings))
                continue;
            const PathDerivatives& vertex = d.vertices[static_cast<std::size_t>(i)];
            const PathDerivatives light = differentiate_light(d.tracer, d.path, i, vertex);
            EXPECT_EQ(light.numbers, vertex.numbers + 2);
            EXPECT_LT(footprint(light, {16}).area(), footprint(light, {}).area() * 1.001f);
            const Vertex& x = d.path[i].vertex;
            const auto brought = [&](glm::vec3 at) {
                const glm::vec3 way = at - x.position, direction = glm::normalize(way);
                return std::log(double(luminance(x.evaluate(x.to_local(direction)).f_cos)) *
                                double(-glm::dot(direction, drawn.light.normal)) / double(glm::dot(way, way)));
            };
            for (int j = 0; j < 2; ++j) {
                const glm::vec3 step = 5e-3f * light.position[j];
                const double truth =
                    (brought(drawn.light.position + step) - brought(drawn.light.position - step)) / 1e-2;
                if (std::abs(truth) > 0.1)
                    errors.push_back(std::abs(double(light.gradient[static_cast<std::size_t>(j)]) / truth - 1));
            }
        }
    });
    ASSERT_GT(errors.size(), 300u);
    EXPECT_LT(quantile(errors, 0.5), 1e-3);
    EXPECT_LT(quantile(errors, 0.95), 0.02);
}

} // namespace

} // namespace tessera::test
