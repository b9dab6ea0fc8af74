#include "app/report/reports.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Crops, CoverTheLargestErrors) {
    const RgbImage reference(64, 48, Rgb(1));
    RgbImage a = reference, b = reference;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            a(40 + x, 20 + y) = Rgb(1.5f);
            b(4 + x, 36 + y) = Rgb(1.4f);
        }
    b(60, 2) = Rgb(1e9f); // the error of one pixel is clamped
    a(61, 2) = Rgb(std::numeric_limits<float>::quiet_NaN());
    const auto crops = choose_crops(reference, {&a, &b}, 12, 2);
    ASSERT_EQ(crops.size(), 2u);
    EXPECT_EQ(crops[0].width(), 12);
    EXPECT_LE(crops[0].x0, 40);
    EXPECT_GE(crops[0].x1, 48);
    EXPECT_LE(crops[0].y0, 20);
    EXPECT_GE(crops[0].y1, 28);
    EXPECT_LE(crops[1].x0, 4);
    EXPECT_GE(crops[1].y1, 44);
    EXPECT_EQ(crop(a, {40, 20, 41, 21})(0, 0), Rgb(1.5f));
}

TEST(Crops, FitATinyImage) {
    const RgbImage reference(3, 2, Rgb(1));
    const auto crops = choose_crops(reference, {&reference}, 12, 2);
    ASSERT_GE(crops.size(), 1u);
    EXPECT_EQ(crops[0].width(), 2);
}

TEST(UsualExposure, MapsNineTenthsBelowWhite) {
    RgbImage image(10, 10, Rgb(3.2f));
    image(0, 0) = Rgb(1e6f);
    EXPECT_NEAR(auto_exposure(image), -2, 1e-5);
    EXPECT_EQ(auto_exposure(RgbImage(4, 4, Rgb(0))), 0);
}

TEST(InlineImage, EmbedsAPng) {
    const std::string html = inline_image(RgbImage(2, 1, Rgb(1)), 0, "alt=\"white\"");
    EXPECT_THAT(html,
                StartsWith("<img width=\"2\" height=\"1\" alt=\"white\" src=\"data:image/png;base64,iVBORw0KGgo"));
    EXPECT_THAT(html, HasSubstr("\">"));
    EXPECT_EQ(escaped("a<b>&\"c\"\n"), "a&lt;b&gt;&amp;&quot;c&quot; ");
}

} // namespace

} // namespace tessera::test
