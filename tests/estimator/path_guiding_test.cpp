// Guided directions: their distribution, their pdf, and theory (22) and (23).
#include "render/paths/base_path.h"
#include "render/paths/offsets.h"
#include "render/paths/path_guiding.h"
#include "render/run/render.h"
#include "render/run/thread_pool.h"
#include "tests/support/rooms.h"
#include "tests/surface/bsdf_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Returns uneven shares with empty bins and one bin that has most of the probability.
DirectionMap::Shares uneven_shares() {
    DirectionMap::Shares shares{};
    float sum = 0;
    for (std::size_t b = 0; b < shares.size(); ++b) {
        shares[b] = b % 3 == 0 ? 0 : static_cast<float>(b % 7);
        shares[b] += b == 100 ? 3000 : 0;
        sum += shares[b];
    }
    for (float& share : shares)
        share /= sum;
    return shares;
}

glm::vec3 on_sphere(float z, float phi) {
    const float r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

Random numbers(int i) {
    return Random(1, static_cast<std::uint32_t>(i), 0);
}

} // namespace

TEST(DirectionMap, PdfIntegratesToOneOverTheSphere) {
    const DirectionMap map(uneven_shares());
    constexpr int rings = 1000, steps = 2000;
    double sum = 0;
    for (int ring = 0; ring < rings; ++ring)
        for (int step = 0; step < steps; ++step) {
            const float z = 2 * (static_cast<float>(ring) + 0.5f) / rings - 1;
            const float phi = 2 * pi * (static_cast<float>(step) + 0.5f) / steps;
            sum += static_cast<double>(map.pdf_w(on_sphere(z, phi)));
        }
    EXPECT_NEAR(sum * 4 * static_cast<double>(pi) / (rings * steps), 1, 2e-3);
}

TEST(DirectionMap, SamplesFollowTheSharesAndReturnTheirPdf) {
    const DirectionMap::Shares shares = uneven_shares();
    const DirectionMap map(shares);
    constexpr int samples = 400000;
    std::vector<int> counts(DirectionMap::bins);
    int mismatches = 0;
    for (int i = 0; i < samples; ++i) {
        const DirectionMap::Sample s =
            map.sample(numbers(i).draw(0, Draw::lobe), numbers(i).draw_2d(0, Draw::direction));
        EXPECT_NEAR(glm::length(s.direction), 1, 1e-5);
        EXPECT_GT(s.pdf_w, 0);
        const int bin = DirectionMap::bin_of(s.direction);
        ++counts[static_cast<std::size_t>(bin)];
        mismatches += std::abs(map.pdf_w(s.direction) - s.pdf_w) > 1e-3f * s.pdf_w;
    }
    EXPECT_LE(mismatches, samples / 10000); // rounding can change the bin at an edge
    for (std::size_t b = 0; b < counts.size(); ++b) {
        const double expected = samples * static_cast<double>(shares[b]);
        EXPECT_NEAR(counts[b], expected, 5 * std::sqrt(expected) + 30) << b;
    }
}

/// The estimate of the BSDF's integral is the same for every share, and all functions that return a pdf return
/// the pdf of the sampling.
TEST(GuidedVertex, SamplesFollowTheirPdfWithAnyShare) {
    const auto diffuse = shared(DiffuseMaterial{Texture(Rgb(0.7f))}), mirror = shared(copper(0));
    const Bsdf bsdfs[] = {resolved(DiffuseMaterial{Texture(Rgb(0.7f))}), resolved(copper(0.3f)),
                          resolved(blend(diffuse, mirror, 0.4f))};
    constexpr int samples = 400000;
    const DirectionMap map(uneven_shares());
    for (const Bsdf& bsdf : bsdfs) {
        double unguided = 0;
        for (const float share : share_candidates) {
            const DirectionGuide guide{map, share};
            Vertex x;
            x.frame = Frame(glm::normalize(glm::vec3(0.3f, 0.5f, 0.8f)));
            x.bsdf = bsdf;
            x.to_previous = glm::normalize(glm::vec3(0.4f, -0.2f, 0.9f));
            x.guide = share > 0 ? &guide : nullptr;
            double sum = 0;
            int mismatches = 0;
            for (int i = 0; i < samples; ++i) {
                const auto s = x.sample(numbers(i).draw(0, Draw::lobe), numbers(i).draw_2d(0, Draw::direction));
                if (!s)
                    continue;
                sum += static_cast<double>(s->f_cos.g / s->pdf_w) / samples;
                const float evaluated =
                    s->is_delta ? x.evaluate_delta(s->scatter).probability : x.evaluate(s->to_next).pdf_w;
                mismatches += std::abs(evaluated - s->pdf_w) > 2e-3f * s->pdf_w;
            }
            EXPECT_LE(mismatches, samples / 1000) << share; // rounding can change the bin at an edge
            unguided = share > 0 ? unguided : sum;
            EXPECT_NEAR(sum / unguided, 1, 0.01) << share;

            OffsetVertices y;
            y.reset(1);
            y.set(0, x);
            const glm::vec3 to_next = glm::normalize(glm::vec3(-0.2f, 0.4f, 0.7f));
            Vec3Lanes direction, from;
            direction.set(0, x.to_world(to_next));
            from.set(0, x.to_previous);
            LaneMask active;
            active[0] = -1;
            BsdfLanes as_offset, from_elsewhere;
            y.evaluate(direction, active, as_offset);
            evaluate(x, from, to_next, active, 1, from_elsewhere);
            const float pdf_w = x.evaluate(to_next).pdf_w;
            EXPECT_NEAR(as_offset.pdf_w[0] / pdf_w, 1, 1e-4) << share;
            EXPECT_NEAR(from_elsewhere.pdf_w[0] / pdf_w, 1, 1e-4) << share;
        }
    }
}

/// A guide makes delta scatters less likely. Their survival of the roulette rises by the inverse factor, up to the
/// largest probability.
TEST(GuidedVertex, DeltaScattersContinueAsOftenAsUnguided) {
    SceneBuilder b;
    const int wall = b.diffuse(white), half = b.blend(wall, b.mirror(), 0.5f);
    b.room({half, half, half, half, half});
    b.camera({0, 0, 2.6f}, {0, 0, 0}, 50);
    const auto scene = b.build();
    constexpr float share = 0.5f;
    const PathGuiding everywhere({glm::ivec3(1), glm::vec3(0), 1}, std::vector<int>(GuidingGrid::sides, 0),
                                 {{DirectionMap(uneven_shares()), share}}, 1);
    const Projection projection(scene->camera(), {64, 64});
    const auto survivals = [&](const PathGuiding* guiding) { // of delta scatters at x_2
        Counters counters;
        PathSettings settings;
        settings.roulette_depth = 1;
        const Tracer tracer{
            *scene, counters, settings, {TextureFilter::off, false, scene->camera(), {64, 64}}, guiding};
        std::vector<float> found;
        BasePath path;
        for (int i = 0; i < 2000; ++i) {
            trace_base_path(tracer, projection.ray({i % 64, i / 64}), projection.pixel_width(), numbers(i), path);
            if (path.size() > 2 && path[1].is_delta)
                found.push_back(path[1].survival);
        }
        return found;
    };
    const std::vector<float> without = survivals(nullptr), with = survivals(&everywhere);
    ASSERT_GT(without.size(), 100u);
    ASSERT_GT(with.size(), 50u);
    for (const float survival : with)
        EXPECT_NEAR(survival, std::min(without.front() / (1 - share), 0.95f), 1e-5);
}

TEST(ShareCandidates, CountDeltaScattersByTheirProbability) {
    const float chance = 0.4f, used = 0.5f;
    const ShareCandidates squares = second_moments(3, (1 - used) * chance, 0, used);
    // With another share t the value is 3 (1 - used) / (1 - t), and the probability changes by the inverse factor.
    for (std::size_t s = 0; s < share_candidates.size(); ++s)
        EXPECT_NEAR(squares[s], 9 * (1 - used) / (1 - share_candidates[s]), 1e-4) << share_candidates[s];
}

TEST(ShareCandidates, EstimateSecondMomentsOfOtherShares) {
    const DirectionMap map(uneven_shares());
    const auto pdf_with = [&](float share, glm::vec3 d) { return (1 - share) / (4 * pi) + share * map.pdf_w(d); };
    const auto integrand = [](glm::vec3 d) { return 0.2f + std::max(d.z, 0.0f) * std::max(d.x, 0.0f); };
    const auto drawn_with = [&](float share, int i) {
        const Random random = numbers(i);
        const float lobe = random.draw(0, Draw::lobe);
        const glm::vec2 u = random.draw_2d(0, Draw::direction);
        return lobe < share ? map.sample(lobe / share, u).direction : on_sphere(2 * u.x - 1, 2 * pi * u.y);
    };
    constexpr int samples = 200000;
    for (const float used : {0.0f, 0.5f, 0.75f}) {
        std::array<double, share_candidates.size()> estimates{};
        for (int i = 0; i < samples; ++i) {
            const glm::vec3 d = drawn_with(used, i);
            const float pdf_w = pdf_with(used, d);
            const ShareCandidates squares = second_moments(integrand(d) / pdf_w, pdf_w, map.pdf_w(d), used);
            for (std::size_t s = 0; s < squares.size(); ++s)
                estimates[s] += static_cast<double>(squares[s]) / samples;
        }
        for (std::size_t s = 0; s < share_candidates.size(); ++s) {
            double moment = 0;
            for (int i = 0; i < samples; ++i) {
                const glm::vec3 d = drawn_with(share_candidates[s], samples + i);
                moment +=
                    std::pow(static_cast<double>(integrand(d) / pdf_with(share_candidates[s], d)), 2) / samples;
            }
            EXPECT_NEAR(estimates[s] / moment, 1, 0.05)
                << "share " << share_candidates[s] << " from samples with share " << used;
        }
    }
}

/// Guided directions take samples from the delta lobe of a blend. This must not raise the variance by much.
TEST(PathGuiding, HardlyRaisesTheVarianceOfMirrorBlends) {
    SceneBuilder b;
    const int wall = b.diffuse(white), half = b.blend(wall, b.mirror(), 0.5f), lamp = b.light(Rgb(5, 4, 3));
    b.room({half, wall, half, wall, wall});
    b.quad({-0.3f, 0.98f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}, wall, lamp);
    b.camera({0, 0, 2.6f}, {0, 0, 0}, 50);
    const auto scene = b.build();
    ThreadPool pool(1);
    double variance[2] = {};
    for (const bool is_guided : {false, true}) {
        RenderSettings settings;
        settings.method = Method::pt;
        settings.max_depth = 6;
        settings.edge_rays = false;
        settings.path_guiding = is_guided ? Guiding::on : Guiding::off;
        Render render(scene, scene->camera(), {96, 72}, settings);
        for (int i = 0; i < 32; ++i)
            render.pass(pool);
        for (const float v : render.images().primal_variance)
            variance[is_guided] += static_cast<double>(v);
    }
    EXPECT_LT(variance[1], 1.2 * variance[0]);
}

} // namespace tessera::test
