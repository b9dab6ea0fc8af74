// Tails of Student's t and of the normal distribution, compared with tables [Abramowitz and Stegun 1964, 26.10
// and 26.2].
#include "app/experiment/speed_up.h"

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

TEST(Significance, StudentsTMatchesTables) {
    EXPECT_NEAR(student_t(0.05, 1), 12.706, 1e-3);
    EXPECT_NEAR(student_t(0.05, 10), 2.228, 1e-3);
    EXPECT_NEAR(student_t(0.001, 4), 8.610, 1e-3);
    EXPECT_NEAR(student_t(0.01, 1e6), 2.5758, 1e-3) << "the limit is the normal distribution";
    EXPECT_DOUBLE_EQ(student_tail(0, 7), 1);
    EXPECT_NEAR(student_tail(1, 1), 0.5, 1e-12) << "Cauchy";
}

TEST(Significance, SigmasAreThoseOfTheNormalDistribution) {
    EXPECT_NEAR(sigmas(0.3173), 1, 1e-3);
    EXPECT_NEAR(sigmas(0.0027), 3, 1e-3);
    EXPECT_NEAR(sigmas(5.733e-7), 5, 1e-3);
    EXPECT_NEAR(sigmas(1), 0, 1e-9);
    EXPECT_NEAR(sigmas(0), 37, 1e-9);
    EXPECT_LT(sigmas(student_tail(6, 4)), 6) << "fewer degrees of freedom are less significant";
}

} // namespace

} // namespace tessera::test
