// Histograms of the pictures on show.

#include "tests/ui/drawing/charts_fixture.h"
#include "ui/state/companions.h"

#include <cmath>
#include <cstdint>

namespace tessera::test {
namespace {

TEST(Histogram, CountsEveryPixelOnce) {
    RgbImage image(4, 2, Rgb(1));
    image(0, 0) = Rgb(0);
    image(1, 0) = Rgb(-1);
    image(2, 0) = Rgb(NAN);
    image(3, 0) = Rgb(1e30f);
    image(0, 1) = Rgb(1e-20f);
    const Histogram h = histogram_of(image);
    EXPECT_EQ(h.black, 1u);
    EXPECT_EQ(h.negative, 1u);
    EXPECT_EQ(h.not_finite, 1u);
    EXPECT_EQ(h.bins.front(), 1u);
    EXPECT_EQ(h.bins.back(), 1u);
    std::size_t ones = 0;
    for (int bin = 0; bin + 1 < Histogram::bin_count; ++bin)
        if (Histogram::low_end(bin) <= 1.0001f && Histogram::low_end(bin + 1) > 0.9999f)
            ones += h.bins[bin];
    EXPECT_EQ(ones, 3u);
}

TEST_F(Charts, AHistogramNeedsNoReference) {
    type(Key::h);
    wait_until([&] { return state().charts[1].histogram != nullptr; });
    frames(2);
    const Histogram& h = *state().charts[1].histogram;
    std::size_t sum = h.black + h.negative + h.not_finite;
    for (std::size_t count : h.bins)
        sum += count;
    EXPECT_EQ(sum, 48u * 36u);
}

TEST_F(Charts, AHistogramIsOfThePictureOnShow) {
    type(Key::h);
    wait_until([&] { return state().charts[1].histogram != nullptr; });
    state().display.tone.exposure = 1; // the same picture
    frames(3);
    EXPECT_NE(state().charts[1].histogram, nullptr);
    const std::uint64_t before = pane(1).generation;
    state().panes[1].settings.render.max_depth = 2;
    wait_until([&] { return pane(1).generation != before; });
    frame();
    EXPECT_TRUE(!state().charts[1].histogram || state().charts[1].histogram_generation == pane(1).generation);
    wait_until([&] { return state().charts[1].histogram != nullptr; });
    type(Key::h); // passes continue while the panel is closed
    EXPECT_EQ(state().charts[1].histogram, nullptr);
    type(Key::h);
    EXPECT_TRUE(wait_until([&] { return state().charts[1].histogram != nullptr; }));
}

} // namespace
} // namespace tessera::test
