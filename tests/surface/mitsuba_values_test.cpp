// BSDFs against values of f cos and pdf_w from Mitsuba 3.9.1 (variant scalar_rgb).
#include "tests/surface/bsdf_cases.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tessera::test {

namespace {

struct Known {
    glm::vec2 to_previous, to_next; ///< theta and phi, radians
    Rgb f_cos;
    float pdf_w;
};

void expect_all(const Bsdf& bsdf, const std::vector<Known>& all, float tolerance = 2e-4f) {
    for (const Known& known : all) {
        const BsdfValue v = bsdf.evaluate(direction(known.to_previous.x, known.to_previous.y),
                                          direction(known.to_next.x, known.to_next.y));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(v.f_cos[c], known.f_cos[c], tolerance * known.f_cos[c]) << known.to_next.x;
        EXPECT_NEAR(v.pdf_w, known.pdf_w, tolerance * known.pdf_w) << known.to_next.x;
    }
}

TEST(MitsubaValues, RoughDielectric) {
    const Rgb reflectance(0.9f, 0.8f, 0.7f), transmittance(0.5f, 0.6f, 0.7f);
    expect_all({RoughDielectric{{MicrofacetDistribution::ggx, 0.3f}, 1.5f, reflectance, transmittance}},
               {
                   {{0.3f, 0.2f}, {0.5f, 2.5f}, {0.01768349f, 0.01571866f, 0.01375382f}, 0.01977938f},
                   {{1.2f, 0.1f}, {1, 3.3f}, {0.1523418f, 0.1354149f, 0.1184881f}, 0.1780507f},
                   {{0.4f, 0.5f}, {2.9f, 3.6f}, {5.029752f, 6.035702f, 7.041652f}, 22.66476f},
                   {{1.1f, 0}, {2.4f, 2.9f}, {0.5213623f, 0.6256348f, 0.7299072f}, 2.389618f},
                   {{2.6f, 0.3f}, {0.7f, 3.5f}, {4.755513f, 5.706615f, 6.657718f}, 4.293554f},
                   {{2.8f, 1}, {2.5f, 4.2f}, {0.02775004f, 0.0246667f, 0.02158336f}, 0.03121578f},
                   {{2, 1}, {1.9f, 4}, {0.8417569f, 0.7482284f, 0.6546998f}, 1.089996f},
               });
    expect_all({RoughDielectric{{MicrofacetDistribution::beckmann, 0.5f}, 1.5f, reflectance, transmittance}},
               {
                   {{0.3f, 0.2f}, {0.5f, 2.5f}, {0.01118648f, 0.009943542f, 0.008700599f}, 0.01242943f},
                   {{1.2f, 0.1f}, {1, 3.3f}, {0.07635139f, 0.0678679f, 0.05938442f}, 0.08521301f},
                   {{0.4f, 0.5f}, {2.9f, 3.6f}, {1.957656f, 2.349187f, 2.740718f}, 8.809452f},
                   {{1.1f, 0}, {2.4f, 2.9f}, {0.8161172f, 0.9793407f, 1.142564f}, 3.672528f},
                   {{2.6f, 0.3f}, {0.7f, 3.5f}, {4.106292f, 4.927551f, 5.748809f}, 3.650038f},
                   {{2.8f, 1}, {2.5f, 4.2f}, {0.01459698f, 0.0129751f, 0.01135321f}, 0.01621887f},
                   {{2, 1}, {1.9f, 4}, {0.5668453f, 0.5038625f, 0.4408797f}, 0.6893769f},
               },
               4e-3f); // Mitsuba approximates Beckmann's shadowing up to 0.35 % [Walter 2007, 5.2]
}

TEST(MitsubaValues, Anisotropic) {
    expect_all({RoughConductor{Microfacets::anisotropic(MicrofacetDistribution::ggx, 0.1f, 0.4f), Rgb(0)}},
               {
                   {{0.3f, 0.2f}, {0.5f, 2.5f}, Rgb(1.008854f), 1.013628f},
                   {{1.2f, 0.1f}, {1, 3.3f}, Rgb(1.183388f), 1.193162f},
                   {{0.7f, 1.3f}, {0.8f, 4.6f}, Rgb(1.228122f), 1.277595f},
                   {{1.4f, 5}, {1.45f, 2}, Rgb(0.009961179f), 0.02080575f},
               });
    expect_all({RoughConductor{Microfacets::anisotropic(MicrofacetDistribution::beckmann, 0.6f, 0.15f), Rgb(0)}},
               {
                   {{0.3f, 0.2f}, {0.5f, 2.5f}, Rgb(0.1835065f / 0.9f), 0.2038961f},
                   {{1.2f, 0.1f}, {1, 3.3f}, Rgb(1.781333f / 0.9f), 2.010573f},
                   {{0.7f, 1.3f}, {0.8f, 4.6f}, Rgb(0.8763471f / 0.9f), 0.973719f},
                   {{1.4f, 5}, {1.45f, 2}, Rgb(1.129382f / 0.9f), 1.607203f},
               },
               4e-3f); // Beckmann's shadowing
    expect_all({RoughDielectric{Microfacets::anisotropic(MicrofacetDistribution::ggx, 0.5f, 0.2f), 1.5f}},
               {
                   {{0.3f, 0.2f}, {0.5f, 2.5f}, Rgb(0.009849431f), 0.009976245f},
                   {{1.2f, 0.1f}, {1, 3.3f}, Rgb(0.1345685f), 0.1522252f},
                   {{0.4f, 0.5f}, {2.9f, 3.6f}, Rgb(8.532744f), 19.25935f},
                   {{1.1f, 0}, {2.4f, 2.9f}, Rgb(0.3039376f), 0.716446f},
                   {{2.6f, 0.3f}, {0.7f, 3.5f}, Rgb(15.71646f), 7.252559f},
                   {{2.8f, 1}, {2.5f, 4.2f}, Rgb(0.01973644f), 0.01998249f},
                   {{2, 1}, {1.9f, 4}, Rgb(0.9964229f), 1.222154f},
               });
}

TEST(MitsubaValues, Principled) {
    PrincipledMaterial plain;
    plain.base_color = Texture(Rgb(0.8f, 0.4f, 0.2f));
    expect_all(resolved(plain), {
                                    {{0.3f, 0.2f}, {0.5f, 2.5f}, {0.2456493f, 0.1339109f, 0.07804164f}, 0.415873f},
                                    {{1.2f, 0.1f}, {1, 3.3f}, {0.3614933f, 0.2952306f, 0.2620993f}, 1.205212f},
                                    {{0.7f, 1.3f}, {0.8f, 4.6f}, {0.2396431f, 0.1509245f, 0.1065652f}, 0.7697176f},
                                    {{1.4f, 5}, {1.45f, 2}, {0.1116308f, 0.1022655f, 0.09758279f}, 0.2039983f},
                                });
    PrincipledMaterial all = principled(0.3f, 0);
    all.eta = 2 / (1 - std::sqrt(0.08f * 0.7f)) - 1;
    expect_all(resolved(all), {
                                  {{0.3f, 0.2f}, {0.5f, 2.5f}, {0.2135425f, 0.1139387f, 0.06413681f}, 0.2546623f},
                                  {{1.2f, 0.1f}, {1, 3.3f}, {1.551241f, 0.950446f, 0.6500486f}, 2.528685f},
                                  {{0.7f, 1.3f}, {0.8f, 4.6f}, {0.7577255f, 0.4156975f, 0.2446834f}, 1.332005f},
                                  {{1.4f, 5}, {1.45f, 2}, {0.3114794f, 0.258043f, 0.2313247f}, 0.3625862f},
                              });
    PrincipledMaterial clear = plain;
    clear.metallic = clear.spec_tint = Texture(Rgb(0.2f));
    clear.spec_trans = Texture(Rgb(0.7f));
    clear.sheen = Texture(Rgb(0.3f));
    clear.clearcoat = Texture(Rgb(0.5f));
    clear.clearcoat_gloss = Texture(Rgb(0.1f));
    clear.eta = 1.33f;
    expect_all(resolved(clear),
               {
                   {{0.3f, 0.2f}, {0.5f, 2.5f}, {0.158157f, 0.0858519f, 0.04969936f}, 0.2671383f},
                   {{1.2f, 0.1f}, {1, 3.3f}, {0.5334306f, 0.3475206f, 0.2545656f}, 0.9744048f},
                   {{0.4f, 0.5f}, {2.9f, 3.6f}, {5.892092f, 4.166338f, 2.946046f}, 8.544893f},
                   {{1.1f, 0}, {2.4f, 2.9f}, {0.411711f, 0.2911236f, 0.2058555f}, 0.6042312f},
                   {{2.6f, 0.3f}, {0.7f, 3.5f}, {14.73488f, 10.41914f, 7.367442f}, 16.81305f},
                   {{2.8f, 1}, {2.5f, 4.2f}, {0.009873016f, 0.009873016f, 0.009873016f}, 0.01778279f},
                   {{2, 1}, {1.9f, 4}, {0.6415737f, 0.6415737f, 0.6415737f}, 1.28266f},
                   {{0.7f, 1.3f}, {0.8f, 4.6f}, {0.2935132f, 0.1651051f, 0.100901f}, 0.6057987f},
                   {{1.4f, 5}, {1.45f, 2}, {0.1265096f, 0.1133874f, 0.1068264f}, 0.2254447f},
               });
    PrincipledMaterial bubble = plain;
    bubble.roughness = Texture(Rgb(0.6f));
    bubble.spec_trans = Texture(Rgb(1));
    bubble.spec_tint = Texture(Rgb(0.4f));
    bubble.anisotropic = Texture(Rgb(0.5f));
    bubble.eta = 0.7f;
    expect_all(resolved(bubble),
               {
                   {{0.3f, 0.2f}, {0.5f, 2.5f}, {0.01216449f, 0.00900693f, 0.007428147f}, 0.009864852f},
                   {{1.2f, 0.1f}, {1, 3.3f}, {1.030101f, 1.030101f, 1.030101f}, 1.158682f},
                   {{0.4f, 0.5f}, {2.9f, 3.6f}, {1.318629f, 0.9324115f, 0.6593145f}, 0.7246172f},
                   {{2.6f, 0.3f}, {0.7f, 3.5f}, {0.3909907f, 0.2764722f, 0.1954954f}, 0.9249977f},
                   {{2.8f, 1}, {2.5f, 4.2f}, {0.01307935f, 0.01307935f, 0.01307935f}, 0.01327847f},
                   {{2, 1}, {1.9f, 4}, {0.1062967f, 0.1062967f, 0.1062967f}, 0.1322013f},
                   {{0.7f, 1.3f}, {0.8f, 4.6f}, {0.188334f, 0.1829118f, 0.1802008f}, 0.1834375f},
                   {{1.4f, 5}, {1.45f, 2}, {0.4065568f, 0.4065568f, 0.4065568f}, 0.7698832f},
               });
}

TEST(MitsubaValues, ThinPrincipled) {
    expect_all(resolved(thin_principled(0.4f, 0.8f)),
               {
                   {{0.3f, 0.2f}, {0.5f, 2.5f}, {0.07771119f, 0.03977518f, 0.02080717f}, 0.1669026f},
                   {{1.2f, 0.1f}, {1, 3.3f}, {0.09833261f, 0.06564426f, 0.04930008f}, 0.2981897f},
                   {{0.4f, 0.5f}, {2.9f, 3.6f}, {1.073017f, 0.5365085f, 0.2682543f}, 0.7261026f},
                   {{1.1f, 0}, {2.4f, 2.9f}, {0.2135235f, 0.1067617f, 0.05338087f}, 0.1672977f},
                   {{2.6f, 0.3f}, {0.7f, 3.5f}, {1.077427f, 0.5387133f, 0.2693567f}, 0.7250754f},
                   {{2.8f, 1}, {2.5f, 4.2f}, {0.07374413f, 0.03810836f, 0.02029048f}, 0.178997f},
                   {{2, 1}, {1.9f, 4}, {0.0824297f, 0.06105428f, 0.05036657f}, 0.2320754f},
                   {{0.7f, 1.3f}, {0.8f, 4.6f}, {0.07281058f, 0.03895403f, 0.02202575f}, 0.2207587f},
                   {{1.4f, 5}, {1.45f, 2}, {0.08327181f, 0.07432082f, 0.06984533f}, 0.1508977f},
               });
}

TEST(MitsubaValues, Blend) {
    const auto diffuse = shared(DiffuseMaterial{{Rgb(0.8f, 0.4f, 0.2f)}});
    const auto metal = shared(ConductorMaterial{MicrofacetDistribution::ggx, {Rgb(0.2f)}});
    expect_all(resolved(blend(diffuse, metal, 0.3f)),
               {
                   {{0.3f, 0.2f}, {0.5f, 2.5f}, {0.3318644f, 0.2536483f, 0.2145402f}, 0.3714944f},
                   {{1.2f, 0.1f}, {1, 3.3f}, {0.9706459f, 0.9224905f, 0.8984128f}, 1.01544f},
                   {{0.4f, 0.5f}, {2.9f, 3.6f}, {0, 0, 0}, 0},
               });
    expect_all(resolved(blend(shared(glass(0.3f)), diffuse, 0.25f)),
               {
                   {{0.3f, 0.2f}, {0.5f, 2.5f}, {0.07060488f, 0.04267056f, 0.0287034f}, 0.08467034f},
                   {{1.2f, 0.1f}, {1, 3.3f}, {0.1613482f, 0.1441499f, 0.1355507f}, 0.1765339f},
                   {{0.4f, 0.5f}, {2.9f, 3.6f}, {7.544628f, 7.544628f, 7.544628f}, 16.99857f},
                   {{1.1f, 0}, {2.4f, 2.9f}, {0.7820435f, 0.7820435f, 0.7820435f}, 1.792213f},
                   {{2.6f, 0.3f}, {0.7f, 3.5f}, {7.133269f, 7.133269f, 7.133269f}, 3.220165f},
               });
}

/// Expected values come from Mitsuba 3.9's `roughplastic` without its specular lobe, at cosines 0.9 and 0.8.
TEST(Plastic, RoughCoatingAgreesWithMitsuba) {
    const struct {
        float alpha, eta, internal_reflectance, both_ways;
    } cases[] = {{0.1f, 1.49f, 0.54578f, 0.41261f}, {0.1f, 1.9f, 0.72035f, 0.22390f},
                 {0.3f, 1.49f, 0.40901f, 0.40213f}, {0.3f, 1.9f, 0.58275f, 0.21799f},
                 {0.5f, 1.49f, 0.28493f, 0.38382f}, {0.5f, 1.9f, 0.43969f, 0.20688f}};
    for (const auto& c : cases) {
        const Coating coating(c.eta, MicrofacetDistribution::ggx, c.alpha);
        EXPECT_NEAR(coating.internal_reflectance, c.internal_reflectance, 0.004f) << c.alpha << ", " << c.eta;
        const float both_ways = coating.transmittance(0.9f) * coating.transmittance(0.8f) / (c.eta * c.eta);
        EXPECT_NEAR(both_ways, c.both_ways, 0.003f * c.both_ways) << c.alpha << ", " << c.eta;
    }
}

} // namespace

} // namespace tessera::test
