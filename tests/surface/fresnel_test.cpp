#include "render/surface/scattering.h"
#include "tests/surface/bsdf_cases.h"

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

TEST(Fresnel, DielectricKnownValues) {
    EXPECT_NEAR(fresnel_dielectric(1, 1.5f).reflectance, 0.04f, 1e-6f);
    EXPECT_NEAR(fresnel_dielectric(-1, 1.5f).reflectance, 0.04f, 1e-6f);
    EXPECT_EQ(fresnel_dielectric(-0.3f, 1.5f).reflectance, 1); // beyond the critical angle of 41.8 degrees
    EXPECT_NEAR(fresnel_dielectric(std::cos(std::atan(1.5f)), 1.5f).reflectance, 0.5f * 0.147929f,
                1e-5f); // Brewster
}

TEST(Fresnel, ConductorKnownValues) {
    // At normal incidence ((n-1)^2 + k^2) / ((n+1)^2 + k^2).
    const Rgb f = fresnel_conductor(1, copper_eta, copper_k);
    for (int c = 0; c < 3; ++c) {
        const float n = copper_eta[c], k = copper_k[c];
        EXPECT_NEAR(f[c], ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k), 1e-5f);
    }
    EXPECT_NEAR(fresnel_conductor(0.001f, copper_eta, copper_k).r, 1, 1e-2f);
    EXPECT_NEAR(fresnel_conductor(0.5f, Rgb(0), Rgb(1)).r, 1, 1e-5f);     // "none"
    EXPECT_NEAR(fresnel_conductor(1, Rgb(1.5f), Rgb(0)).r, 0.04f, 1e-5f); // no absorption: a dielectric
}

} // namespace

} // namespace tessera::test
