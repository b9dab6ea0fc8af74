#include "render/estimator/guiding_learner.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Uneven, with empty bins and one that has nearly all.
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
            const float r = std::sqrt(1 - z * z);
            sum += static_cast<double>(map.pdf_w({r * std::cos(phi), r * std::sin(phi), z}));
        }
    EXPECT_NEAR(sum * 4 * static_cast<double>(pi) / (rings * steps), 1, 2e-3);
}

TEST(DirectionMap, SamplesComeAsOftenAsTheirSharesSayAndKnowTheirPdf) {
    const DirectionMap::Shares shares = uneven_shares();
    const DirectionMap map(shares);
    constexpr int samples = 400000;
    std::vector<int> counts(DirectionMap::bins);
    int moved = 0;
    for (int i = 0; i < samples; ++i) {
        const DirectionMap::Sample s =
            map.sample(numbers(i).draw(0, Draw::lobe), numbers(i).draw_2d(0, Draw::direction));
        EXPECT_NEAR(glm::length(s.direction), 1, 1e-5);
        EXPECT_GT(s.pdf_w, 0);
        const int bin = DirectionMap::bin_of(s.direction);
        ++counts[static_cast<std::size_t>(bin)];
        moved += std::abs(map.pdf_w(s.direction) - s.pdf_w) > 1e-3f * s.pdf_w;
    }
    EXPECT_LE(moved, samples / 10000); // at a bin's edge, rounding may move one to the next bin
    for (std::size_t b = 0; b < counts.size(); ++b) {
        const double expected = samples * static_cast<double>(shares[b]);
        EXPECT_NEAR(counts[b], expected, 5 * std::sqrt(expected) + 30) << b;
    }
}

TEST(GuidingLearner, DrawsFromWhereLightWasFoundAndOnlyThere) {
    GuidingLearner learner;
    EXPECT_EQ(learner.guiding(), nullptr);
    const glm::vec3 up(0, 1, 0), here(0), there(9, 0, 3), from = glm::normalize(glm::vec3(0.3f, 0.8f, -0.5f)),
                                                          other = glm::normalize(glm::vec3(-0.3f, 0.8f, -0.5f));
    std::vector<std::vector<FoundLight>> found(2);
    for (int i = 0; i < 500; ++i) {
        found[0].push_back({here, up, from, 2});
        found[1].push_back({there, up, other, 2});
    }
    learner.learn(found);
    const std::shared_ptr<const PathGuiding> guiding = learner.guiding();
    ASSERT_TRUE(guiding);
    const DirectionMap *at_here = guiding->at(here, up), *at_there = guiding->at(there, up);
    ASSERT_TRUE(at_here && at_there);
    EXPECT_GT(at_here->pdf_w(from), 10 * at_here->pdf_w(other));
    EXPECT_GT(at_there->pdf_w(other), 10 * at_there->pdf_w(from));
    EXPECT_EQ(guiding->at(here, -up), nullptr);
}

} // namespace tessera::test
