// Maps of the outcomes of shifts, from the counts of pixels.
#include "render/film/film.h"

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

/// Returns maps of a pixel that was the target of 20 shifts in two passes, and of one that was the target of none.
ReuseMaps two_pixels() {
    Film film(2, 1, {.reuse = true});
    Counters counters;
    PixelSample sample;
    sample.reuse = {{5, 2, 1, 0, 1, 0}, 1, 0};
    film.add(0, 0, 0, sample, counters);
    sample.reuse = {{8, 1, 0, 1, 0, 1}, 2, 1};
    film.add(0, 0, 1, sample, counters);
    return film.reuse_maps(2);
}

TEST(ReuseMaps, AreMeansOfCounts) {
    const ReuseMaps maps = two_pixels();
    EXPECT_FLOAT_EQ(maps.reused()(0, 0), 6.5f); // in each pass
    EXPECT_FLOAT_EQ(maps.failed()(0, 0), 0.35f);
    EXPECT_FLOAT_EQ(maps.survival()(0, 0), 0.75f);
    const float fractions[] = {0.65f, 0.15f, 0.05f, 0.05f, 0.05f, 0.05f};
    for (int i = 0; i < shift_outcome_count; ++i)
        EXPECT_FLOAT_EQ(maps.share(static_cast<ShiftOutcome>(i))(0, 0), fractions[i]);
}

TEST(ReuseMaps, FractionsSumToOneAndFailuresToFailed) {
    const ReuseMaps maps = two_pixels();
    float failed = 0;
    for (int i = 1; i < shift_outcome_count; ++i)
        failed += maps.share(static_cast<ShiftOutcome>(i))(0, 0);
    EXPECT_FLOAT_EQ(failed, maps.failed()(0, 0));
    EXPECT_FLOAT_EQ(failed + maps.share(ShiftOutcome::ok)(0, 0), 1);
}

TEST(ReuseMaps, AreZeroWithoutShifts) {
    const ReuseMaps maps = two_pixels();
    for (int i = 0; i < shift_outcome_count; ++i)
        EXPECT_EQ(maps.share(static_cast<ShiftOutcome>(i))(1, 0), 0);
    for (const Image<float>& map : {maps.reused(), maps.failed(), maps.survival()})
        EXPECT_EQ(map(1, 0), 0);
    EXPECT_TRUE(Film(2, 1, {}).reuse_maps(2).empty());
}

} // namespace

} // namespace tessera::test
