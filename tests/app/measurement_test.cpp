// Measurements in the journal keep their values as text.
#include "app/experiment/measured_run.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera::test {

namespace {

Measurement through_text(const Measurement& m) {
    return measurement_from_json(nlohmann::json::parse(to_json(m).dump()));
}

TEST(Measurement, RoundTripsThroughText) {
    Measurement m;
    m.seed = 7;
    m.spp = 16;
    m.artefacts = Artefacts{{0.5, 0.1}, 1.25, {3, 2}, {5, 6}, 4, {1, 2, 3}};
    const Measurement back = through_text(m);
    EXPECT_EQ(back.seed, 7u);
    ASSERT_TRUE(back.artefacts);
    EXPECT_EQ(back.artefacts->error.relative_mse, 0.5);
    EXPECT_EQ(back.artefacts->worst, m.artefacts->worst);
    EXPECT_EQ(back.artefacts->worst_pixel, m.artefacts->worst_pixel);
    EXPECT_EQ(back.artefacts->pieces, m.artefacts->pieces);
    EXPECT_FALSE(through_text({}).artefacts);
}

TEST(Measurement, NonFiniteValuesBecomeNaN) {
    Measurement m;
    const double infinite = std::numeric_limits<double>::infinity();
    m.artefacts = Artefacts{{infinite, 0}, 1, {infinite, 2}, {0, 0}, 0, {1, -infinite}};
    const Measurement back = through_text(m);
    ASSERT_TRUE(back.artefacts);
    EXPECT_TRUE(std::isnan(back.artefacts->error.relative_mse));
    EXPECT_TRUE(std::isnan(back.artefacts->worst.at(0)));
    EXPECT_EQ(back.artefacts->worst.at(1), 2);
    EXPECT_EQ(back.artefacts->pieces.at(0), 1);
    EXPECT_TRUE(std::isnan(back.artefacts->pieces.at(1)));
}

} // namespace

} // namespace tessera::test
