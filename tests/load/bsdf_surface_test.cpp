// Plugins of <bsdf> that define a scattering model: the materials read, and the notes.
#include "tests/load/bsdf_reading.h"

#include <cmath>
#include <variant>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

TEST(BsdfPlugins, RoughDiffuse) {
    const Read r = read("<bsdf type='roughdiffuse'><float name='alpha' value='0.4'/>"
                        "<boolean name='useFastApprox' value='true'/></bsdf>",
                        "0.6.0");
    EXPECT_EQ(r.notes, "");
    const Bsdf bsdf = r.material.resolve({});
    const auto& kind = std::get<RoughDiffuse>(bsdf.kind);
    EXPECT_FLOAT_EQ(kind.sigma, 0.4f / std::sqrt(2.0f));
    EXPECT_TRUE(kind.fast);
    EXPECT_EQ(kind.reflectance, Rgb(0.5f));
    EXPECT_TRUE(std::holds_alternative<RoughDiffuse>(
        read("<bsdf type='roughdiffuse'/>").material.resolve({}).kind)); // default alpha of 0.2
}

TEST(BsdfPlugins, RoughDielectric) {
    const Read r =
        read("<bsdf type='roughdielectric'><float name='alpha' value='0.3'/>"
             "<string name='distribution' value='ggx'/><float name='intIOR' value='1.6'/>"
             "<string name='extIOR' value='vacuum'/><rgb name='specularTransmittance' value='0.5'/></bsdf>",
             "0.6.0");
    EXPECT_EQ(r.notes, "");
    const Bsdf bsdf = r.material.resolve({});
    const auto& kind = std::get<RoughDielectric>(bsdf.kind);
    EXPECT_EQ(kind.facets.distribution, MicrofacetDistribution::ggx);
    EXPECT_FLOAT_EQ(kind.facets.alpha, 0.3f);
    EXPECT_FLOAT_EQ(kind.eta, 1.6f);
    EXPECT_EQ(kind.specular_transmittance, Rgb(0.5f));
    EXPECT_TRUE(r.material.is_transparent());
    // Without a step in the index of refraction, the microfacets have no effect.
    const Read none = read("<bsdf type='roughdielectric'><float name='int_ior' value='1'/>"
                           "<float name='ext_ior' value='1'/></bsdf>");
    EXPECT_TRUE(std::holds_alternative<SmoothDielectric>(none.material.resolve({}).kind));
    EXPECT_EQ(read(around("twosided", "<bsdf type='roughdielectric'/>")).notes,
              "'twosided' has no effect on a transparent material\n");
}

TEST(BsdfPlugins, AnisotropicRoughness) {
    const std::string both = "<float name='alphaU' value='0.4'/><float name='alphaV' value='0.1'/>";
    const Read metal = read(around("roughconductor", both), "0.6.0");
    EXPECT_EQ(metal.notes, "");
    EXPECT_TRUE(metal.material.is_anisotropic());
    const Bsdf bsdf = metal.material.resolve({});
    EXPECT_FLOAT_EQ(std::get<RoughConductor>(bsdf.kind).facets.alpha, 0.2f);
    EXPECT_FLOAT_EQ(std::get<RoughConductor>(bsdf.kind).facets.stretch, 2);
    const std::string texture = "<texture type='checkerboard' name='alpha_v'/>";
    const Read textured = read(around("roughdielectric", texture)); // default alpha_u of 0.1
    EXPECT_TRUE(textured.material.is_textured() && textured.material.is_anisotropic());
    EXPECT_FLOAT_EQ(std::get<RoughDielectric>(textured.material.resolve({}).kind).facets.alpha, 0.2f);
    // Nested materials are anisotropic too. Equal roughnesses are isotropic.
    const std::string brushed = around("roughconductor", both);
    EXPECT_TRUE(
        read(around("coating", around("blendbsdf", diffuse + brushed)), "0.6.0").material.is_anisotropic());
    const std::string equal = "<float name='alpha_u' value='0.3'/><float name='alpha_v' value='0.3'/>";
    EXPECT_FALSE(read(around("roughconductor", equal)).material.is_anisotropic());
    EXPECT_EQ(read(around("roughplastic", both), "0.6.0").notes,
              "the anisotropic roughness is replaced by its geometric mean\n");
}

TEST(BsdfPlugins, Principled) {
    const Read plain = read("<bsdf type='principled'/>");
    EXPECT_EQ(plain.notes, "");
    const auto& m = std::get<PrincipledMaterial>(plain.material.kind);
    EXPECT_NEAR(m.eta, 1.5f, 1e-6f); // default specular of 0.5
    EXPECT_EQ(m.base_color.evaluate({}), Rgb(0.5f));
    EXPECT_FALSE(plain.material.is_transparent() || plain.material.is_textured() ||
                 plain.material.is_anisotropic());
    EXPECT_EQ(plain.material.resolve({}).roughness(), 1);
    const Read clear = read("<bsdf type='principled'><rgb name='base_color' value='0.2, 0.4, 0.6'/>"
                            "<texture type='checkerboard' name='roughness'/><float name='spec_trans' value='1'/>"
                            "<float name='eta' value='1'/><float name='anisotropic' value='0.5'/>"
                            "<float name='clearcoat_sampling_rate' value='2'/></bsdf>");
    EXPECT_EQ(clear.notes, "");
    EXPECT_TRUE(clear.material.is_transparent() && clear.material.is_textured());
    EXPECT_TRUE(clear.material.is_anisotropic());
    EXPECT_FLOAT_EQ(std::get<PrincipledMaterial>(clear.material.kind).eta, 1.001f);
    EXPECT_LT(clear.material.resolve({}).roughness(), 0.3f); // roughness of the microfacets
    EXPECT_EQ(kind_name(clear.material.resolve({})), "principled");
    EXPECT_EQ(read(around("twosided", "<bsdf type='principledthin'/>")).notes,
              "'twosided' has no effect on a transparent material\n");
    const Read bright = read("<bsdf type='principled'><float name='sheen' value='2'/></bsdf>");
    EXPECT_EQ(std::get<PrincipledMaterial>(bright.material.kind).sheen.scalar({}), 1);
    EXPECT_NE(bright.notes, "");
    const Read thin = read("<bsdf type='principledthin'><texture type='checkerboard' name='eta'/>"
                           "<float name='diff_trans' value='1.5'/></bsdf>");
    EXPECT_EQ(thin.notes, "");
    EXPECT_TRUE(thin.material.is_transparent() && thin.material.is_textured());
    EXPECT_EQ(std::get<ThinPrincipledMaterial>(thin.material.kind).diff_trans.scalar({}), 1.5f);
}

TEST(BsdfPlugins, Phong) {
    const Bsdf bsdf = read("<bsdf type='phong'/>", "0.6.0").material.resolve({});
    EXPECT_EQ(std::get<Phong>(bsdf.kind).exponent, 30);
    EXPECT_EQ(std::get<Phong>(bsdf.kind).specular_reflectance, Rgb(0.2f));
    EXPECT_EQ(bsdf.roughness(), 1);
    const Read bright = read("<bsdf type='phong'><rgb name='diffuseReflectance' value='0.9'/>"
                             "<rgb name='specularReflectance' value='0.6'/></bsdf>");
    EXPECT_EQ(bright.notes, "the two reflectances add up to more than 1 and are scaled down to 1\n");
    const Bsdf scaled = bright.material.resolve({});
    EXPECT_FLOAT_EQ(std::get<Phong>(scaled.kind).diffuse_reflectance.r, 0.6f);
}

TEST(BsdfPlugins, Ward) {
    const Read r =
        read("<bsdf type='ward'><string name='variant' value='ward-duer'/><float name='alphaU' value='0.2'/>"
             "<float name='alphaV' value='0.05'/><rgb name='diffuseReflectance' value='0'/></bsdf>",
             "0.6.0");
    EXPECT_EQ(r.notes, "");
    EXPECT_TRUE(r.material.is_anisotropic());
    const Bsdf bsdf = r.material.resolve({});
    const Ward& ward = std::get<Ward>(std::get<UncommonBsdf>(bsdf.kind).kind);
    EXPECT_EQ(ward.variant, WardVariant::duer);
    EXPECT_EQ(ward.alpha, glm::vec2(0.2f, 0.05f));
    EXPECT_EQ(ward.specular_reflectance, Rgb(0.2f));
    EXPECT_FLOAT_EQ(bsdf.roughness(), 0.1f);
    EXPECT_EQ(kind_name(bsdf), "ward");
    EXPECT_EQ(read("<bsdf type='ward'><float name='specular_reflectance' value='0.9'/></bsdf>").notes,
              "the two reflectances add up to more than 1 and are scaled down to 1\n");
}

TEST(BsdfPlugins, DiffuseTransmitter) {
    const Read r =
        read("<bsdf type='difftrans'><texture type='checkerboard' name='transmittance'/></bsdf>", "0.6.0");
    EXPECT_EQ(r.notes, "");
    EXPECT_TRUE(r.material.is_transparent() && r.material.is_textured());
    const BsdfValue v = r.material.resolve({}).evaluate({0, 0, 1}, {0, 0.6f, -0.8f});
    EXPECT_NEAR(v.f_cos.r, 0.4f * 0.8f / 3.14159265f, 1e-6f);
}

TEST(BsdfPlugins, MediumLayer) {
    const std::string hg = "<phase type='hg'><float name='g' value='0.5'/></phase>";
    const Read r = read("<bsdf type='hk'><rgb name='sigmaS' value='2'/><rgb name='sigmaA' value='0.5'/>"
                        "<float name='thickness' value='0.1'/>" +
                            hg + "</bsdf>",
                        "0.6.0");
    EXPECT_EQ(r.notes, "");
    const auto layer = [](const Material& m) {
        return std::get<MediumLayer>(std::get<UncommonBsdf>(m.resolve({}).kind).kind);
    };
    EXPECT_FLOAT_EQ(layer(r.material).scattered.r, 0.8f);
    EXPECT_FLOAT_EQ(layer(r.material).depth.r, 0.25f);
    EXPECT_EQ(layer(r.material).g, 0.5f);
    const Read by_albedo =
        read("<bsdf type='hk'><rgb name='sigma_t' value='2'/><rgb name='albedo' value='0.9'/></bsdf>");
    EXPECT_EQ(by_albedo.notes, "");
    EXPECT_FLOAT_EQ(layer(by_albedo.material).scattered.r, 0.9f);
    EXPECT_FLOAT_EQ(layer(by_albedo.material).depth.r, 2);
    EXPECT_FLOAT_EQ(layer(read("<bsdf type='hk'/>").material).depth.r, 0.74f + 0.032f); // default medium skin1
    EXPECT_EQ(read("<bsdf type='hk'><string name='material' value='gold'/><phase type='rayleigh'/></bsdf>").notes,
              "the medium 'gold' is not known and replaced by 'skin1'\n"
              "the phase function 'rayleigh' is replaced by an isotropic one\n");
    // A blend has one direction of transmission: that of the refracting BSDF.
    const Read both = read(around("blendbsdf", "<bsdf type='hk'/>" + glass));
    EXPECT_EQ(both.notes, "the unscattered transmission of 'hk' is left out, because another <bsdf> refracts\n");
    EXPECT_FALSE(part<MediumLayerMaterial>(both.material, 0).is_clear);
    EXPECT_EQ(read(around("blendbsdf", "<bsdf type='hk'/>" + diffuse)).notes, "");
}

TEST(BsdfPlugins, PolarizingPlastic) {
    const Read r =
        read("<bsdf type='pplastic'><float name='alpha_u' value='0.4'/><float name='alpha_v' value='0.1'/>"
             "<rgb name='diffuse_reflectance' value='0.3'/></bsdf>");
    EXPECT_EQ(r.notes, "the anisotropic roughness is replaced by its geometric mean\n"
                       "the polarisation of 'pplastic' is left out\n");
    const Bsdf bsdf = r.material.resolve({});
    EXPECT_FLOAT_EQ(std::get<Plastic>(bsdf.kind).facets.alpha, 0.2f);
    EXPECT_NEAR(std::get<Plastic>(bsdf.kind).base.r, 0.3f, 1e-5f);
}

TEST(BsdfPlugins, ReplacesPhongAndAshikhminShirleyByBeckmann) {
    for (const std::string name : {"phong", "as"}) {
        const Read r = read("<bsdf type='roughconductor'><string name='distribution' value='" + name +
                                "'/><float name='alpha' value='0.3'/></bsdf>",
                            "0.6.0");
        EXPECT_EQ(r.notes, "the distribution '" + name + "' is replaced by 'beckmann' of the same 'alpha'\n");
        EXPECT_FLOAT_EQ(std::get<RoughConductor>(r.material.resolve({}).kind).facets.alpha, 0.3f);
    }
}

} // namespace tessera::test
