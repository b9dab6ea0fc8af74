#include "render/session/previews.h"

#include <gtest/gtest.h>

namespace tessera {
namespace {

constexpr double budget = 0.06;
constexpr glm::ivec2 size{1280, 720};

TEST(Previews, FinerOnesFollowForTheSameRequest) {
    Previews previews;
    EXPECT_EQ(previews.divisor(1, size), 4);
    previews.count(1, 4, 2 * budget, budget);
    EXPECT_FALSE(previews.is_first(1));
    EXPECT_EQ(previews.divisor(1, size), 0); // the whole picture follows the finest preview
    EXPECT_EQ(previews.divisor(2, size), 8); // the first preview exceeded its budget
    previews.count(2, 8, budget / 2, budget);
    EXPECT_EQ(previews.divisor(2, size), 4);
    previews.count(2, 4, 2 * budget, budget);
    EXPECT_EQ(previews.divisor(2, size), 0);
    EXPECT_EQ(previews.divisor(3, size), 8);
    previews.count(3, 8, 40 * budget, budget);
    EXPECT_EQ(previews.divisor(4, size), 16);
}

TEST(Previews, BecomeFinerWhenAFollowingOneIsFast) {
    Previews previews;
    previews.count(1, 4, 1.1 * budget, budget); // over budget on a busy machine
    previews.count(2, 8, 0.3 * budget,
                   budget); // fixed costs make one coarse preview inconclusive about finer ones
    EXPECT_EQ(previews.divisor(3, size), 8);
    previews.count(2, 4, 0.5 * budget, budget);
    EXPECT_EQ(previews.divisor(3, size), 4);
}

TEST(Previews, KeepAMinimumSize) {
    Previews previews;
    previews.count(1, 4, 100, budget);
    EXPECT_EQ(previews.divisor(2, size), 16);
    EXPECT_EQ(previews.divisor(2, {480, 270}), 4);
    EXPECT_EQ(previews.divisor(2, {360, 640}), 8);
    EXPECT_EQ(previews.divisor(2, {1, 1}), 4);
}

TEST(Previews, AreAsFineAsTheBudgetAllowsWithoutOscillation) {
    for (const double finest : {0.01, 0.5, 0.9, 1.1, 3.0, 5.0, 100.0}) { // time of the finest preview, in budgets
        const auto seconds = [&](int divisor) { return finest * budget * 16 / (divisor * divisor); };
        Previews previews;
        int last = 0, changes = 0;
        for (std::uint64_t request = 1; request < 20; ++request) {
            const int divisor = previews.divisor(request, size);
            changes += divisor != last;
            last = divisor;
            previews.count(request, divisor, seconds(divisor), budget);
        }
        EXPECT_LE(changes, 2) << finest;
        EXPECT_TRUE(seconds(last) <= budget || last == 16) << finest;
        EXPECT_TRUE(last == 4 || seconds(last / 2) * 1.5 >= budget) << finest;
    }
}

} // namespace
} // namespace tessera
