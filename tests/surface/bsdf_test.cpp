// Tests of every BSDF: samples follow the pdf (chi-square) and agree with evaluate(), energy and reciprocity.
#include "render/sampling/sampling.h"
#include "tests/surface/bsdf_cases.h"

#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

std::vector<Case> cases() {
    using enum MicrofacetDistribution;
    const Rgb orange(0.8f, 0.5f, 0.2f);
    const auto diffuse = shared(DiffuseMaterial{{orange}}), metal = shared(copper(0.3f));
    const auto mirror = shared(copper(0)), black = shared(DiffuseMaterial{{Rgb(0)}});
    return {{"plastic", [=] { return Bsdf{plastic(ggx, 0, Rgb(0.8f, 0.4f, 0.1f), false)}; }},
            {"rough_plastic_010", [=] { return Bsdf{plastic(ggx, 0.1f, Rgb(0.8f, 0.4f, 0.1f), true)}; }},
            {"rough_plastic_040", [=] { return Bsdf{plastic(beckmann, 0.4f, Rgb(0.9f), false)}; }},
            {"diffuse", [=] { return Bsdf{Diffuse{orange}}; }},
            {"rough_diffuse_020", [=] { return Bsdf{RoughDiffuse{orange, 0.2f, false}}; }},
            {"rough_diffuse_090", [=] { return Bsdf{RoughDiffuse{Rgb(1), 0.9f, false}}; }},
            {"rough_diffuse_fast", [=] { return Bsdf{RoughDiffuse{orange, 0.5f, true}}; }},
            {"ggx_010", [=] { return Bsdf{rough(ggx, 0.1f)}; }},
            {"ggx_050", [=] { return Bsdf{rough(ggx, 0.5f)}; }},
            {"ggx_100", [=] { return Bsdf{rough(ggx, 1)}; }},
            {"beckmann_010", [=] { return Bsdf{rough(beckmann, 0.1f)}; }},
            {"beckmann_050", [=] { return Bsdf{rough(beckmann, 0.5f)}; }},
            {"beckmann_100", [=] { return Bsdf{rough(beckmann, 1)}; }},
            {"brushed_ggx", [=] { return Bsdf{RoughConductor{brushed(ggx), copper_eta, copper_k, Rgb(1)}}; }},
            {"brushed_beckmann",
             [=] { return Bsdf{RoughConductor{brushed(beckmann), copper_eta, copper_k, Rgb(1)}}; }},
            {"brushed_glass", [=] { return Bsdf{RoughDielectric{brushed(ggx), 1.5f}}; }, 1.5f},
            {"glass_ggx_020", [=] { return Bsdf{RoughDielectric{{ggx, 0.2f}, 1.5f}}; }, 1.5f},
            {"glass_ggx_060", [=] { return Bsdf{RoughDielectric{{ggx, 0.6f}, 1.5f, Rgb(1), orange}}; }, 1.5f},
            {"glass_beckmann_030", [=] { return Bsdf{RoughDielectric{{beckmann, 0.3f}, 1.33f}}; }, 1.33f},
            {"bubble", [=] { return Bsdf{RoughDielectric{{ggx, 0.4f}, 1 / 1.5f}}; }, 1 / 1.5f},
            {"phong_5", [=] { return Bsdf{Phong(5, Rgb(0.5f, 0.4f, 0.3f), Rgb(0.2f, 0.4f, 0.7f))}; }},
            {"phong_80", [=] { return Bsdf{Phong(80, Rgb(0), Rgb(1))}; }},
            {"principled", [=] { return resolved(PrincipledMaterial{}); }},
            {"principled_all", [=] { return resolved(principled(0.3f, 0)); }},
            {"principled_metal", [=] { return resolved(principled(1, 0)); }},
            {"principled_glass", [=] { return resolved(principled(0.2f, 0.7f)); }, 1.5f},
            {"thin_principled", [=] { return resolved(thin_principled(0.4f, 0.8f)); }, 1, true, false},
            {"thin_principled_glass", [=] { return resolved(thin_principled(1, 0)); }, 1, true, false},
            {"ward", [=] { return Bsdf{UncommonBsdf{Ward(WardVariant::ward, {0.1f, 0.4f}, orange, Rgb(0.2f))}}; }},
            {"ward_duer",
             [=] { return Bsdf{UncommonBsdf{Ward(WardVariant::duer, {0.3f, 0.2f}, orange, Rgb(0.1f))}}; }},
            {"ward_balanced",
             [=] { return Bsdf{UncommonBsdf{Ward(WardVariant::balanced, {0.15f, 0.5f}, Rgb(0), Rgb(0.9f))}}; }},
            {"difftrans", [=] { return Bsdf{UncommonBsdf{DiffuseTransmitter{orange}}}; }, 1, true},
            {"layer", [=] { return Bsdf{UncommonBsdf{MediumLayer{orange, Rgb(0.5f, 1, 2), 0, true}}}; }, 1, true},
            {"layer_forward", [=] { return Bsdf{UncommonBsdf{MediumLayer{orange, Rgb(0.2f), 0.7f, false}}}; }, 1,
             true},
            {"blend", [=] { return resolved(blend(diffuse, metal, 0.3f)); }},
            {"blend_mirror", [=] { return resolved(blend(metal, mirror, 0.6f)); }},
            {"blend_black", [=] { return resolved(blend(metal, black, 0.6f)); }},
            {"blend_glass", [=] { return resolved(blend(diffuse, shared(glass(0.4f)), 0.7f)); }, 1.5f},
            {"mixture", [=] { return resolved(MixtureMaterial{{diffuse, metal, mirror}, {0.2f, 0.3f, 0.4f}}); }},
            {"coated_diffuse", [=] { return resolved(coated(diffuse, Rgb(0.5f, 1, 2))); }},
            {"coated_metal", [=] { return resolved(coated(metal, Rgb(0), Rgb(0))); }},
            {"coated_mixture", [=] { return resolved(coated(shared(blend(metal, mirror, 0.5f)), Rgb(0.1f))); }}};
}

class EveryBsdf : public testing::TestWithParam<Case> {
protected:
    const Bsdf& bsdf() const { return bsdf_; }
    bool is_opaque() const { return GetParam().eta == 1 && !GetParam().is_sheet; }

    std::vector<glm::vec3> views() const {
        std::vector<glm::vec3> result;
        for (float theta : {0.0f, 0.3f, 0.8f, 1.2f, 1.5f})
            result.push_back(direction(theta, 0.7f));
        for (float theta : {1.7f, 2.2f, 2.7f})
            if (!is_opaque())
                result.push_back(direction(theta, 0.7f));
        return result;
    }

private:
    const Bsdf bsdf_ = GetParam().bsdf();
};

// Cells in (theta, phi) over the whole sphere.
constexpr int rings = 32, sectors = 24;

std::size_t cell_of(glm::vec3 d) {
    const int ring = std::min(int(std::acos(std::clamp(d.z, -1.0f, 1.0f)) / pi * rings), rings - 1);
    const int sector = std::min(int((std::atan2(d.y, d.x) / (2 * pi) + 0.5f) * sectors), sectors - 1);
    return static_cast<std::size_t>(ring * sectors + sector);
}

/// Returns the integral of pdf_w over a cell, by the midpoint rule.
double integrate(const Bsdf& bsdf, glm::vec3 to_previous, int ring, int sector) {
    constexpr int steps = 24;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double theta = pi * (ring + (i + 0.5) / steps) / rings;
            const double phi = 2 * pi * (sector + (j + 0.5) / steps) / sectors - pi;
            const glm::vec3 d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
            sum += bsdf.evaluate(to_previous, d).pdf_w * std::sin(theta);
        }
    return sum * (pi / rings) * (2 * pi / sectors) / (steps * steps);
}

/// Numbers of samples, without delta scatters.
struct Histogram {
    std::array<double, rings * sectors> cells{};
    double total = 0;
};

Histogram histogram(const Bsdf& bsdf, glm::vec3 to_previous, int samples) {
    Uniform uniform(7);
    Histogram h;
    for (int i = 0; i < samples; ++i)
        if (const auto s = draw(bsdf, to_previous, uniform); s && !s->is_delta) {
            ++h.cells[cell_of(s->to_next)];
            ++h.total;
        }
    return h;
}

TEST_P(EveryBsdf, SamplesFollowThePdf) {
    constexpr int samples = 200000;
    for (const glm::vec3 to_previous : views()) {
        const Histogram h = histogram(bsdf(), to_previous, samples);
        double chi2 = 0, count = 0, expected = 0, total = 0;
        int cells = 0;
        for (int ring = 0; ring < rings; ++ring)
            for (int sector = 0; sector < sectors; ++sector) {
                const double in_cell = samples * integrate(bsdf(), to_previous, ring, sector);
                count += h.cells[static_cast<std::size_t>(ring * sectors + sector)];
                expected += in_cell;
                total += in_cell;
                if (expected < 20)
                    continue; // pools cells of few samples with the next ones
                // The integral has an error of up to 1 % in cells with a peak.
                chi2 += (count - expected) * (count - expected) / (expected + 0.01 * expected * 0.01 * expected);
                ++cells;
                count = expected = 0;
            }
        // The limit is at 5 standard deviations of the chi-square distribution.
        EXPECT_LT(chi2, cells + 5 * std::sqrt(2.0 * cells)) << "z " << to_previous.z << ", " << cells << " cells";
        // The midpoint rule is inaccurate for the peaks at grazing views.
        EXPECT_NEAR(total / samples, h.total / samples, 0.02) << "z " << to_previous.z;
    }
}

TEST_P(EveryBsdf, SamplesAgreeWithEvaluate) {
    Uniform uniform(13);
    for (const glm::vec3 to_previous : views())
        for (int i = 0; i < 2000; ++i) {
            const auto s = draw(bsdf(), to_previous, uniform);
            if (!s)
                continue;
            EXPECT_GT(s->pdf_w, 0);
            EXPECT_NEAR(glm::length(s->to_next), 1, 1e-5f);
            EXPECT_EQ(s->scatter == Scatter::transmit, s->to_next.z * to_previous.z < 0);
            if (s->is_delta) {
                const DeltaValue v = bsdf().evaluate_delta(to_previous, s->scatter);
                EXPECT_EQ(v.to_next, s->to_next);
                EXPECT_EQ(v.value, s->f_cos);
                EXPECT_EQ(v.probability, s->pdf_w);
            } else {
                const BsdfValue v = bsdf().evaluate(to_previous, s->to_next);
                EXPECT_EQ(v.f_cos, s->f_cos);
                EXPECT_EQ(v.pdf_w, s->pdf_w);
            }
        }
}

/// Returns the solid angle that the derivatives of a sampled direction by both random numbers span: 1 over the
/// density of its lobe. 0: numbers nearby sample another lobe.
double area_of_numbers(const Bsdf& bsdf, glm::vec3 to_previous, float lobe, glm::vec2 u) {
    constexpr float step = 1e-3f;
    glm::dvec3 derivatives[2];
    for (int axis = 0; axis < 2; ++axis) {
        glm::dvec3 at[4]; // -2, -1, 1 and 2 steps away
        for (int k = 0; k < 4; ++k) {
            glm::vec2 moved = u;
            moved[axis] += static_cast<float>(k < 2 ? k - 2 : k - 1) * step;
            const auto s = bsdf.sample(to_previous, lobe, moved);
            if (!s || s->is_delta)
                return 0;
            at[k] = s->to_next;
        }
        derivatives[axis] = (8.0 * (at[2] - at[1]) - (at[3] - at[0])) / (12.0 * double(step));
    }
    return glm::length(glm::cross(derivatives[0], derivatives[1]));
}

/// The density of the only lobe is the pdf, up to 1e-3. With several lobes, the pdf is at least the probability of
/// the sampled lobe times its density.
TEST_P(EveryBsdf, JacobiansOfSamplingEqualThePdf) {
    Uniform uniform(19);
    std::vector<double> errors;
    for (const glm::vec3 to_previous : views())
        for (int i = 0; i < 200; ++i) {
            const float lobe = uniform();
            const glm::vec2 u = 0.01f + 0.98f * uniform.two();
            const auto s = bsdf().sample(to_previous, lobe, u);
            const double area = s && !s->is_delta ? area_of_numbers(bsdf(), to_previous, lobe, u) : 0;
            if (!(area > 0))
                continue;
            constexpr int lobes = 100;
            double lobe_probability = 0;
            for (int k = 0; k < lobes; ++k)
                if (const auto other = bsdf().sample(to_previous, (static_cast<float>(k) + 0.5f) / lobes, u))
                    lobe_probability += other->to_next == s->to_next && !other->is_delta ? 1.0 / lobes : 0;
            if (lobe_probability > 1 - 0.5 / lobes)
                errors.push_back(std::abs(area * double(s->pdf_w) - 1));
            else
                EXPECT_GT(area * double(s->pdf_w), 0.98 * lobe_probability - 1.5 / lobes);
        }
    std::sort(errors.begin(), errors.end());
    if (errors.size() < 100)
        return; // the BSDF has several lobes
    EXPECT_LT(errors[errors.size() / 2], 1e-3);
    EXPECT_LT(errors[errors.size() * 9 / 10], 1e-3) << "the map from the square to the disk has kinks";
}

TEST_P(EveryBsdf, DeltaScattersHaveTheirProbability) {
    constexpr int samples = 40000;
    for (const glm::vec3 to_previous : views()) {
        Uniform uniform(17);
        int deltas = 0;
        for (int i = 0; i < samples; ++i)
            if (const auto s = draw(bsdf(), to_previous, uniform))
                deltas += s->is_delta;
        const float expected = bsdf().evaluate_delta(to_previous, Scatter::reflect).probability +
                               bsdf().evaluate_delta(to_previous, Scatter::transmit).probability;
        EXPECT_NEAR(deltas / double(samples), expected, 0.0125) << "z " << to_previous.z; // 5 standard deviations
    }
}

/// f / n^2 is symmetric, with n as the index on the side to which light leaves [Walter 2007, 5.2].
TEST_P(EveryBsdf, IsReciprocal) {
    Uniform uniform(3);
    for (int i = 0; i < 2000; ++i) {
        glm::vec3 a = sample_cosine_hemisphere(uniform.two()), b = sample_cosine_hemisphere(uniform.two());
        if (a.z < 1e-3f || b.z < 1e-3f)
            continue;
        if (!is_opaque() && i % 2)
            a = -a;
        if (!is_opaque() && i % 4 > 1)
            b = -b;
        if (!GetParam().has_reciprocal_transmission && a.z * b.z < 0)
            continue; // as in Mitsuba 3, masking differs between both directions
        const float na = GetParam().index(a), nb = GetParam().index(b);
        const Rgb there = bsdf().evaluate(a, b).f_cos / (std::abs(b.z) * na * na);
        const Rgb back = bsdf().evaluate(b, a).f_cos / (std::abs(a.z) * nb * nb);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(there[c], back[c], 1e-3f * (there[c] + back[c]) + 1e-6f);
    }
}

TEST_P(EveryBsdf, GainsNoEnergy) {
    Uniform uniform(5);
    for (const glm::vec3 to_previous : views()) {
        double sum = 0;
        constexpr int samples = 50000;
        for (int i = 0; i < samples; ++i)
            if (const auto s = draw(bsdf(), to_previous, uniform)) {
                const float relative = GetParam().index(s->to_next) / GetParam().index(to_previous);
                sum += luminance(s->f_cos / s->pdf_w) * relative * relative; // from radiance to power
            }
        EXPECT_LT(sum / samples, 1.0) << "z " << to_previous.z;
        EXPECT_GT(sum / samples, 0.02) << "z " << to_previous.z;
    }
}

/// The tolerance is wide: rough metals lose energy between their facets, and lobes at grazing views.
TEST_P(EveryBsdf, AlbedoIsAboutTheReflectedEnergy) {
    Uniform uniform(29);
    for (const glm::vec3 to_previous : views()) {
        const Rgb albedo = bsdf().albedo(to_previous);
        EXPECT_GT(std::min({albedo.r, albedo.g, albedo.b}), 0);
        if (!is_opaque() || to_previous.z < 0.3f)
            continue;
        double sum = 0;
        constexpr int samples = 20000;
        for (int i = 0; i < samples; ++i)
            if (const auto s = draw(bsdf(), to_previous, uniform))
                sum += luminance(s->f_cos / s->pdf_w);
        const double ratio = sum / samples / luminance(albedo);
        EXPECT_GT(ratio, 0.3) << "z " << to_previous.z;
        EXPECT_LT(ratio, 1.35) << "z " << to_previous.z;
    }
}

TEST_P(EveryBsdf, IsBlackBelowOpaqueSurfaces) {
    if (!is_opaque())
        return;
    EXPECT_EQ(bsdf().evaluate(direction(0.5f, 0), direction(2, 1)).pdf_w, 0);
    EXPECT_EQ(bsdf().evaluate(direction(2, 0), direction(0.5f, 1)).pdf_w, 0);
    EXPECT_EQ(bsdf().evaluate_delta(direction(2, 0), Scatter::reflect).probability, 0);
    for (const float lobe : {0.0f, 0.5f, 0.99f})
        EXPECT_FALSE(bsdf().sample(direction(2, 0), lobe, {0.5f, 0.5f}));
}

TEST_P(EveryBsdf, RelativeIndexIsEtaOnBothSides) {
    const float eta = GetParam().eta;
    EXPECT_FLOAT_EQ(bsdf().relative_index(direction(0.5f, 0)), eta);
    EXPECT_FLOAT_EQ(bsdf().relative_index(direction(2, 0)), 1 / eta);
}

INSTANTIATE_TEST_SUITE_P(all, EveryBsdf, testing::ValuesIn(cases()),
                         [](const auto& p) { return std::string(p.param.name); });

} // namespace

} // namespace tessera::test
