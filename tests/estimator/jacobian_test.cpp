// Jacobians of single steps of a shift against finite differences: half-vector copies between all pairs of glossy
// surfaces, reconnections to vertices and to lights, and random replay.
#include "render/paths/shift.h"
#include "tests/support/one_shift.h"
#include "tests/support/rooms.h"
#include "tests/surface/bsdf_cases.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

using Move = std::function<std::optional<glm::dvec3>(glm::vec3)>;

/// Returns the ratio of solid angles of moved(d) and d, by finite differences; empty if a direction next to d
/// cannot be moved.
std::optional<double> measured_jacobian(glm::vec3 d, const Move& moved) {
    const Frame around(d);
    const float step = 5e-4f;
    glm::dvec3 slopes[2];
    for (int axis = 0; axis < 2; ++axis) {
        const glm::vec3 side = step * (axis == 0 ? around.tangent : around.bitangent);
        const auto plus = moved(glm::normalize(d + side)), minus = moved(glm::normalize(d - side));
        if (!plus || !minus)
            return {};
        slopes[axis] = (*plus - *minus) / (2.0 * step);
    }
    return glm::length(glm::cross(slopes[0], slopes[1]));
}

struct NamedBsdf {
    std::string name;
    Bsdf bsdf;
    bool transmits = false;
};

const Coating& coating() {
    static const Coating table(1.5f, MicrofacetDistribution::beckmann, 0.2f);
    return table;
}

/// Returns BSDFs of all kinds that half vectors are copied from and to.
std::vector<NamedBsdf> glossy_bsdfs() {
    using enum MicrofacetDistribution;
    std::vector<NamedBsdf> list;
    for (const auto distribution : {ggx, beckmann})
        for (const float alpha : {0.1f, 0.3f, 0.7f}) {
            const std::string name =
                (distribution == ggx ? "ggx " : "beckmann ") + std::to_string(alpha).substr(0, 3);
            list.push_back({"conductor " + name, {RoughConductor{{distribution, alpha}}}});
            list.push_back({"glass " + name, {RoughDielectric{{distribution, alpha}, 1.5f}}, true});
        }
    const Microfacets brushed = Microfacets::anisotropic(ggx, 0.1f, 0.4f);
    list.push_back({"brushed conductor", {RoughConductor{brushed}}});
    list.push_back({"brushed glass", {RoughDielectric{brushed, 1.5f}}, true});
    list.push_back({"principled metal", resolved(principled(1, 0))});
    list.push_back({"principled glass", resolved(principled(0, 0.8f)), true});
    list.push_back({"ward", {UncommonBsdf{Ward(WardVariant::balanced, {0.1f, 0.3f}, Rgb(0), Rgb(0.7f))}}});
    list.push_back({"water", {RoughDielectric{{ggx, 0.3f}, 1.33f}}, true});
    list.push_back({"plastic", {Plastic(coating(), {beckmann, 0.2f}, Rgb(1), Rgb(0.4f), false)}});
    list.push_back({"phong", {Phong(20, Rgb(0.2f), Rgb(0.5f))}});
    list.push_back({"diffuse", {Diffuse{Rgb(0.5f)}}}); // the offset of a glossy base can be diffuse
    return list;
}

struct PairTally {
    int reflected = 0, transmitted = 0;
    double worst = 0; ///< |measured / Jacobian - 1|
};

/// Copies scatters of one surface to another one with a slightly different normal and view.
PairTally copy_many(const Bsdf& from, const Bsdf& to, float side) {
    std::mt19937 engine(11);
    std::uniform_real_distribution<float> uniform(0, 0x1.fffffep-1f);
    const auto next = [&] { return uniform(engine); };
    PairTally tally;
    for (int i = 0; i < 3000 && tally.reflected + tally.transmitted < 40; ++i) {
        Vertex base{}, offset{};
        base.bsdf = from;
        offset.bsdf = to;
        const glm::vec3 normal = glm::normalize(glm::vec3(next() - 0.5f, next() - 0.5f, next() - 0.5f));
        base.frame = Frame(normal);
        offset.frame =
            Frame(glm::normalize(normal + 0.2f * glm::vec3(next() - 0.5f, next() - 0.5f, next() - 0.5f)));
        const glm::vec3 view(next() - 0.5f, next() - 0.5f, side * (0.3f + next()));
        base.to_previous = glm::normalize(view);
        const glm::vec3 aside = 0.2f * glm::vec3(next() - 0.5f, next() - 0.5f, next() - 0.5f);
        offset.to_previous = offset.to_local(glm::normalize(base.to_world(view) + aside));
        const float lobe = next(), u = next();
        const auto s = from.sample(base.to_previous, lobe, {u, next()});
        if (!s || s->is_delta)
            continue;
        const auto copy = copy_half_vector(base, s->to_next, offset);
        if (!copy)
            continue;
        // Near total reflection and the horizon the derivative is unbounded, and differences are inaccurate.
        if (copy->jacobian > 4 || copy->jacobian < 0.25f || std::abs(copy->to_next.z) < 0.15f ||
            std::abs(s->to_next.z) < 0.15f)
            continue;
        const auto measured = measured_jacobian(s->to_next, [&](glm::vec3 d) -> std::optional<glm::dvec3> {
            const auto moved = copy_half_vector(base, d, offset);
            return moved ? std::optional(glm::dvec3(moved->to_next)) : std::nullopt;
        });
        if (!measured)
            continue;
        ++(s->scatter == Scatter::transmit ? tally.transmitted : tally.reflected);
        tally.worst = std::max(tally.worst, std::abs(*measured / double(copy->jacobian) - 1));
    }
    return tally;
}

TEST(Jacobian, OfHalfVectorCopiesEqualsFiniteDifferences) {
    const std::vector<NamedBsdf> all = glossy_bsdfs();
    for (const NamedBsdf& from : all)
        for (const NamedBsdf& to : all)
            for (const float side : {1.0f, -1.0f}) {
                if (side < 0 && !(from.transmits && to.transmits))
                    continue; // black from below
                const PairTally t = copy_many(from.bsdf, to.bsdf, side);
                const std::string name = from.name + " to " + to.name + (side > 0 ? "" : " from below");
                EXPECT_LT(t.worst, 1.5e-3) << name; // rounding
                EXPECT_GT(t.reflected + t.transmitted, 10) << name;
                if (from.transmits && to.transmits) {
                    EXPECT_GT(t.transmitted, 10) << name;
                } else {
                    EXPECT_EQ(t.transmitted, 0) << name;
                }
            }
}

/// Calls `visit(base, other)` for base paths of pixels and of the pixels at a distance `apart` (pixels), with the
/// same random numbers. Both paths hit a surface.
template <class Visit>
void for_pairs(const Tracer& tracer, std::uint64_t seed, glm::vec2 apart, Visit&& visit) {
    const Projection projection(tracer.scene.camera(), {64, 48});
    for (std::uint32_t i = 0; i < 300; ++i) {
        const Random random(seed, i, 0);
        const glm::vec2 pixel = random.draw_2d(0, Draw::direction) * glm::vec2(60, 44);
        BasePath base, other;
        trace_base_path(tracer, projection.ray(pixel), projection.pixel_width(), random, base);
        trace_base_path(tracer, projection.ray(pixel + apart), projection.pixel_width(), random, other);
        if (!base.empty() && !other.empty())
            visit(base, other);
    }
}

/// In a diffuse room the ratio of theory (6) is pdf_w(y_1) / pdf_w(x_1) times the Jacobian of theory (14).
TEST(Jacobian, OfReconnectionEqualsFiniteDifferences) {
    const auto scene = Room().build();
    Counters counters;
    const Tracer tracer{*scene, counters, {4, 0}};
    int count = 0;
    for_pairs(tracer, 3, {3, 2}, [&](const BasePath& base, const BasePath& other) {
        for (const ShiftKind kind :
             {ShiftKind::half_vector, ShiftKind::reconnection, ShiftKind::replay_reconnection}) {
            const ShiftSettings settings{kind};
            LightPaths light;
            light.reset(base, settings);
            if (light.join() != 1 || !light.is_alive(light.tail_slot()))
                continue;
            OffsetPaths paths;
            const Vertex &x = base[0].vertex, &join = base[1].vertex, &y = other[0].vertex;
            shift_to_one(tracer, settings, base, light, other, paths);
            const float ratio = paths.ratio(light.tail_slot(), 0);
            const glm::vec3 to_join = glm::normalize(join.position - y.position);
            const float pdf_w = y.bsdf.evaluate(y.to_previous, y.to_local(to_join)).pdf_w;
            if (!(ratio > 0) || glm::distance(x.position, join.position) < 0.3f ||
                glm::distance(y.position, join.position) < 0.3f)
                continue;
            // A moved direction meets the plane of x_2 at another point, which y_1 sees in another direction.
            const glm::dvec3 from(x.position), at(join.position), normal(join.geometric_normal), to(y.position);
            const glm::vec3 direction = glm::normalize(join.position - x.position);
            if (std::abs(glm::dot(direction, join.geometric_normal)) < 0.15f)
                continue;
            const auto measured = measured_jacobian(direction, [&](glm::vec3 d) {
                const glm::dvec3 ray(d);
                const glm::dvec3 point = from + ray * (glm::dot(at - from, normal) / glm::dot(ray, normal));
                return std::optional(glm::normalize(point - to));
            });
            EXPECT_NEAR(ratio * base[0].pdf_w / pdf_w / *measured, 1, 1e-3);
            ++count;
        }
    });
    EXPECT_GT(count, 200);
}

/// For a point on a light, the densities P of theory (6) are sums over emitter sampling and BSDF sampling.
TEST(Jacobian, OfLightSamplesEqualsFiniteDifferences) {
    const auto scene = Room().build();
    Counters counters;
    const Tracer tracer{*scene, counters, {2, 0}};
    const ShiftSettings settings;
    int count = 0;
    for_pairs(tracer, 4, {3, 2}, [&](const BasePath& base, const BasePath& other) {
        LightPaths light;
        light.reset(base, settings);
        const int slot = light.emitter_slot(0);
        if (!light.is_alive(slot))
            return;
        OffsetPaths paths;
        const Vertex &x = base[0].vertex, &y = other[0].vertex;
        shift_to_one(tracer, settings, base, light, other, paths);
        const LightSample& l = base.light(0);
        const glm::vec3 direction = glm::normalize(l.light.position - x.position);
        const auto seen = l.light.seen_from(y.position);
        if (!(paths.ratio(slot, 0) > 0) || !seen || glm::dot(direction, l.light.normal) > -0.15f)
            return;
        const glm::dvec3 from(x.position), at(l.light.position), normal(l.light.normal), to(y.position);
        const auto measured = measured_jacobian(direction, [&](glm::vec3 d) {
            const glm::dvec3 ray(d);
            return std::optional(
                glm::normalize(from + ray * (glm::dot(at - from, normal) / glm::dot(ray, normal)) - to));
        });
        const float pdf_w = y.bsdf.evaluate(y.to_previous, y.to_local(seen->direction)).pdf_w;
        EXPECT_NEAR(paths.ratio(slot, 0) * l.pdf_sum / (pdf_w + seen->pdf_w) / *measured, 1, 1e-3);
        ++count;
    });
    EXPECT_GT(count, 100);
}

/// In the space of random numbers replay is the identity. With shift threshold 1 no vertex is connectable, so the
/// ratio of every light path is 1, and its value equals the value of the offset's own replay.
TEST(Jacobian, OfReplayCancelsTheRatioOfDensities) {
    Room r;
    r.quad({-0.95f, -0.97f, 0.95f}, {1.9f, 0, 0}, {0, 0, -1.9f}, r.conductor(0.3f));
    r.sphere({0.35f, -0.55f, 0}, 0.35f, r.rough_glass(0.3f));
    const auto scene = r.build();
    Counters counters;
    const Tracer tracer{*scene, counters, {5, 0}};
    const ShiftSettings settings{ShiftKind::replay_reconnection, 1};
    int count = 0;
    for_pairs(tracer, 5, {1, 1}, [&](const BasePath& base, const BasePath& other) {
        LightPaths light, own;
        light.reset(base, settings);
        own.reset(other, settings); // `other` uses the base's random numbers
        OffsetPaths paths;
        shift_to_one(tracer, settings, base, light, other, paths);
        for (int slot = 0; slot < std::min(light.slot_count(), own.slot_count()); ++slot) {
            if (!(paths.ratio(slot, 0) > 0) || !own.is_alive(slot)) // the offset's shadow rays are not traced here
                continue;
            EXPECT_NEAR(paths.ratio(slot, 0), 1, 1e-4);
            EXPECT_NEAR(luminance(paths.value(slot, 0)) / luminance(own.carried(slot)), 1, 1e-3);
            ++count;
        }
    });
    EXPECT_GT(count, 300);
}

} // namespace

} // namespace tessera::test
