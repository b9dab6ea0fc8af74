// Adapters and mixtures of <bsdf>: the materials read, the notes, and the errors of bad values.

#include "tests/load/bsdf_reading.h"
#include "tests/load/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

TEST(BsdfPlugins, Mask) {
    const auto opacity = [](const Material& m) { return m.opacity.value().evaluate({}).r; };
    EXPECT_EQ(opacity(read(around("mask", diffuse)).material), 0.5f);
    EXPECT_FALSE(read(around("mask", diffuse + "<float name='opacity' value='1'/>")).material.opacity);
    const Read coloured = read(around("mask", two_sided + "<rgb name='opacity' value='1, 0, 0'/>"));
    EXPECT_FLOAT_EQ(opacity(coloured.material), luminance(Rgb(1, 0, 0)));
    EXPECT_EQ(coloured.notes, "the coloured 'opacity' is replaced by its luminance\n");
    EXPECT_TRUE(coloured.material.two_sided);
    // The opacities of nested masks multiply.
    EXPECT_EQ(opacity(read(around("mask", around("mask", diffuse))).material), 0.25f);
    const std::string texture = "<texture type='checkerboard' name='opacity'/>";
    const Read half = read(around("mask", around("mask", diffuse + texture)));
    EXPECT_FLOAT_EQ(opacity(half.material), 0.2f);
    EXPECT_EQ(half.notes, "");
    EXPECT_TRUE(half.material.is_textured());
    EXPECT_EQ(read(around("mask", texture + around("mask", diffuse + texture))).notes,
              "the mask inside this one is left out\n");
}

TEST(BsdfPlugins, BumpAndNormalMaps) {
    const Read bump = read(around("bumpmap", diffuse + check + "<float name='scale' value='3'/>"));
    EXPECT_EQ(bump.notes, "");
    ASSERT_TRUE(bump.material.relief);
    EXPECT_EQ(bump.material.relief->kind, Relief::Kind::bump);
    EXPECT_EQ(bump.material.relief->scale, 3);
    EXPECT_TRUE(bump.material.is_textured());
    const Read normals =
        read(around("normalmap", "<texture type='checkerboard' name='normalmap'/>" + two_sided), "0.6.0");
    ASSERT_TRUE(normals.material.relief);
    EXPECT_EQ(normals.material.relief->kind, Relief::Kind::normal_map);
    EXPECT_TRUE(normals.material.two_sided);
    const Read both = read(around("normalmap", check + around("bumpmap", check + diffuse)));
    EXPECT_EQ(both.notes, "the bump or normal map inside this one is left out\n");
    EXPECT_EQ(both.material.relief->kind, Relief::Kind::normal_map);
    // Adapters can be nested together, in any order.
    const Read all = read(around("twosided", around("mask", around("bumpmap", check + diffuse))));
    EXPECT_TRUE(all.material.opacity && all.material.relief && all.material.two_sided);
    EXPECT_EQ(all.notes, "");
    // Their order decides how the relief looks from behind.
    EXPECT_TRUE(all.material.relief->is_mirrored_behind);
    EXPECT_FALSE(normals.material.relief->is_mirrored_behind);
}

TEST(BsdfPlugins, AHeightMapOfGamma1IsLinear) {
    const TemporaryFolder folder;
    folder.write("h.tga", tga_row("333"));
    const auto file =
        folder.write("s.xml", "<scene version='0.6.0'><bsdf type='bumpmap'><texture name='map' type='bitmap'>"
                              "<string name='filename' value='h.tga'/><float name='gamma' value='1.0'/></texture>"
                              "<bsdf type='twosided' id='inner'><bsdf type='diffuse'/></bsdf></bsdf>"
                              "<shape type='cube'><ref id='inner'/></shape></scene>");
    const LoadedScene loaded = load_mitsuba_xml(file);
    ASSERT_EQ(loaded.description.materials.size(), 2u);
    EXPECT_NEAR(loaded.description.materials[0].relief.value().map.evaluate({}).r, 0.2f, 1e-6f);
    // A shape that refers to the nested material gets it without bumps, as in Mitsuba.
    EXPECT_FALSE(loaded.description.materials[1].relief);
    EXPECT_EQ(loaded.description.shapes.at(0).material, 1);
}

TEST(BsdfPlugins, Blend) {
    const Read r = read(around("blendbsdf", "<float name='weight' value='0.2'/>" + diffuse + glass));
    const auto& mixture = std::get<MixtureMaterial>(r.material.kind);
    EXPECT_FLOAT_EQ(mixture.weight(0, {}), 0.8f);
    EXPECT_FLOAT_EQ(mixture.weight(1, {}), 0.2f);
    EXPECT_TRUE(r.material.is_transparent());
    EXPECT_FALSE(r.material.is_textured());
    EXPECT_EQ(r.notes, "");
    // The weight can be textured, and so can a blended material.
    const Read textured =
        read(around("blendbsdf", "<texture type='checkerboard' name='weight'/>" + two_sided + two_sided));
    EXPECT_FLOAT_EQ(std::get<MixtureMaterial>(textured.material.kind).weight(1, {}), 0.4f);
    EXPECT_TRUE(textured.material.is_textured() && textured.material.two_sided);
    const std::string inner = "<bsdf type='diffuse'><texture type='checkerboard' name='reflectance'/></bsdf>";
    EXPECT_TRUE(read(around("blendbsdf", inner + diffuse)).material.is_textured());
    EXPECT_TRUE(read(around("coating", around("blendbsdf", diffuse + inner))).material.is_textured());
}

/// Returns a scene in which each BSDF "bN" blends "bN-1" with itself, so that leaves double per level.
std::string nested_blends(int levels) {
    std::string text = "<bsdf type='diffuse' id='b0'><float name='unheard_of' value='1'/></bsdf>";
    for (int i = 1; i <= levels; ++i) {
        const std::string ref = "<ref id='b" + std::to_string(i - 1) + "'/>";
        text += "<bsdf type='blendbsdf' id='b" + std::to_string(i) + "'>" + ref + ref + "</bsdf>";
    }
    return "<scene version='3.0.0'>" + text + "<shape type='cube'><ref id='b" + std::to_string(levels) +
           "'/></shape></scene>";
}

TEST(BsdfPlugins, ReadsAReferencedBsdfOnce) {
    const LoadedScene scene = parse_mitsuba_xml(nested_blends(6), "s.xml");
    EXPECT_EQ(std::ranges::count(scene.notes, "'unheard_of' of bsdf 'diffuse' is not used", &LoadNote::text), 1);
}

TEST(BsdfPlugins, RejectsBlendsOfMoreThan256Bsdfs) {
    for (const int levels : {9, 60})
        try {
            parse_mitsuba_xml(nested_blends(levels), "s.xml");
            FAIL() << levels;
        } catch (const LoadError& error) {
            EXPECT_NE(std::string(error.what()).find("'blendbsdf' is made of more than 256 BSDFs"),
                      std::string::npos)
                << error.what();
        }
}

TEST(BsdfPlugins, ReadsHundredsOfThousandsOfParameters) {
    std::string bsdf = "<bsdf type='diffuse'>";
    for (int i = 0; i < 300000; ++i) // a linear search for each would take minutes
        bsdf += "<float name='p" + std::to_string(i) + "' value='1'/>";
    const Read r =
        read(bsdf + "<rgb name='reflectance' value='0.25'/><rgb name='reflectance' value='0.75'/></bsdf>");
    EXPECT_EQ(std::get<Rgb>(std::get<DiffuseMaterial>(r.material.kind).reflectance.kind), Rgb(0.75f));
}

TEST(BsdfPlugins, ReportsAdaptersThatABlendLeavesOut) {
    const Read r = read(
        around("blendbsdf", around("mask", diffuse) + around("twosided", around("bumpmap", check + diffuse))));
    EXPECT_EQ(r.notes, "'twosided' around some of the materials in 'blendbsdf' is left out\n"
                       "the bump or normal map inside 'blendbsdf' is left out\n"
                       "the mask inside 'blendbsdf' is left out\n");
    EXPECT_FALSE(r.material.two_sided);
    EXPECT_EQ(read(around("twosided", around("blendbsdf", diffuse + glass))).notes,
              "'twosided' has no effect on a transparent material\n");
    // Adapters around the whole blend are applied.
    EXPECT_TRUE(read(around("mask", around("blendbsdf", two_sided + two_sided))).material.opacity);

    const std::string water = "<bsdf type='dielectric'><string name='int_ior' value='water'/></bsdf>";
    const Read clear = read(around("blendbsdf", glass + around("blendbsdf", diffuse + water)));
    EXPECT_EQ(clear.notes, "this refracts like the first transparent <bsdf> in 'blendbsdf'\n");
    const Material& nested = *std::get<MixtureMaterial>(clear.material.kind).parts.at(1);
    EXPECT_EQ(part<DielectricMaterial>(nested, 1).eta, part<DielectricMaterial>(clear.material, 0).eta);
}

TEST(BsdfPlugins, Mixture) {
    const Read r = read(
        around("mixturebsdf", "<string name='weights' value='0.3, 0.2'/>" + diffuse + "<bsdf type='conductor'/>"),
        "0.6.0");
    const auto& mixture = std::get<MixtureMaterial>(r.material.kind);
    EXPECT_EQ(mixture.weights, (std::vector<float>{0.3f, 0.2f}));
    EXPECT_EQ(r.notes, "");
    const Read heavy = read(around("mixturebsdf", "<string name='weights' value='3 1'/>" + diffuse + diffuse));
    EXPECT_EQ(heavy.notes, "'weights' add up to more than 1 and are scaled down to 1\n");
    EXPECT_FLOAT_EQ(std::get<MixtureMaterial>(heavy.material.kind).weights[0], 0.75f);
}

TEST(BsdfPlugins, Coating) {
    const Read r =
        read(around("coating", "<float name='thickness' value='2'/><rgb name='sigmaA' value='0.1, 2, 3'/>"
                               "<float name='intIOR' value='1.7'/><float name='extIOR' value='1'/>" +
                                   two_sided),
             "0.6.0");
    const auto& coated = std::get<CoatedMaterial>(r.material.kind);
    EXPECT_FLOAT_EQ(coated.eta, 1.7f);
    EXPECT_EQ(coated.thickness, 2);
    EXPECT_EQ(coated.sigma_a.evaluate({}), Rgb(0.1f, 2, 3));
    EXPECT_TRUE(r.material.two_sided);
    EXPECT_EQ(r.notes, "");
    EXPECT_EQ(read(around("roughcoating",
                          "<float name='alpha' value='0.2'/><bsdf type='twosided'>" + diffuse + "</bsdf>"))
                  .notes,
              "'roughcoating' is replaced by 'coating', which is smooth\n");
    const Read clear = read(around("coating", glass));
    EXPECT_EQ(clear.notes, "the coating around a transparent material is left out\n");
    EXPECT_TRUE(std::holds_alternative<DielectricMaterial>(clear.material.kind));
}

TEST(BsdfPlugins, RejectsBadValues) {
    const auto error = [](const std::string& bsdf) -> std::string {
        try {
            parse(bsdf);
        } catch (const LoadError& e) {
            const std::string what = e.what();
            return what.substr(0, what.find('\n'));
        }
        return "no error";
    };
    const std::pair<std::string, std::string> table[] = {
        {"<bsdf type='mask'/>", "2:1: 'mask' needs a nested <bsdf>"},
        {"<bsdf type='mask'><float name='opacity' value='-1'/>" + diffuse + "</bsdf>",
         "2:48: 'opacity' must not be negative"},
        {"<bsdf type='bumpmap'><bsdf type='diffuse'/></bsdf>", "2:1: 'bumpmap' needs a nested <texture>"},
        {"<bsdf type='normalmap'><texture type='checkerboard'/></bsdf>", "2:1: 'normalmap' needs a nested <bsdf>"},
        {"<bsdf type='roughdiffuse'><float name='alpha' value='-1'/></bsdf>",
         "2:54: 'alpha' must not be negative"},
        {"<bsdf type='roughdielectric'><float name='alpha' value='-1'/></bsdf>",
         "2:57: 'alpha' must not be negative"},
        {"<bsdf type='roughconductor'><float name='alpha_u' value='-1'/></bsdf>",
         "2:58: 'alpha_u' must not be negative"},
        {"<bsdf type='roughconductor'><texture type='checkerboard' name='alpha_u'/><float name='alpha_v' "
         "value='-1'/></bsdf>",
         "2:103: 'alpha_v' must not be negative"},
        {"<bsdf type='principled'><float name='roughness' value='-1'/></bsdf>",
         "2:56: 'roughness' must not be negative"},
        {"<bsdf type='principled'><float name='eta' value='0'/></bsdf>",
         "2:50: an index of refraction must be above 0"},
        {"<bsdf type='principled'><float name='specular' value='13'/></bsdf>",
         "2:55: 'specular' must be at least 0 and below 12.5"},
        {"<bsdf type='principled'><float name='eta' value='2'/><float name='specular' value='0.2'/></bsdf>",
         "2:54: 'principled' takes 'eta' or 'specular', not both"},
        {"<bsdf type='principledthin'><float name='eta' value='-1'/></bsdf>",
         "2:54: an index of refraction must be above 0"},
        {"<bsdf type='principledthin'><float name='diff_trans' value='3'/></bsdf>",
         "2:61: 'diff_trans' must be from 0 to 2"},
        {"<bsdf type='ward'><string name='variant' value='x'/></bsdf>",
         "2:49: 'variant' must be 'ward', 'ward-duer' or 'balanced'"},
        {"<bsdf type='ward'><float name='alpha_v' value='-1'/></bsdf>", "2:48: 'alpha_v' must not be negative"},
        {"<bsdf type='difftrans'><float name='transmittance' value='-1'/></bsdf>",
         "2:59: 'transmittance' must not be negative"},
        {"<bsdf type='hk'><float name='thickness' value='-1'/></bsdf>", "2:48: 'thickness' must not be negative"},
        {"<bsdf type='hk'><rgb name='sigma_s' value='1, -1, 1'/></bsdf>", "2:44: 'sigma_s' must not be negative"},
        {"<bsdf type='hk'><float name='sigma_t' value='1'/></bsdf>",
         "2:1: 'hk' needs both 'sigma_t' and 'albedo', or neither"},
        {"<bsdf type='hk'><phase type='hg'><float name='g' value='1'/></phase></bsdf>",
         "2:57: 'g' must be above -1 and below 1"},
        {"<bsdf type='phong'><float name='exponent' value='-1'/></bsdf>", "2:50: 'exponent' must not be negative"},
        {"<bsdf type='blendbsdf'>" + diffuse + "</bsdf>", "2:1: 'blendbsdf' needs two nested <bsdf>"},
        {"<bsdf type='blendbsdf'><rgb name='weight' value='-1'/>" + diffuse + glass + "</bsdf>",
         "2:50: 'weight' must not be negative"},
        {"<bsdf type='mixturebsdf'><string name='weights' value='1'/></bsdf>",
         "2:1: 'mixturebsdf' needs a nested <bsdf>"},
        {"<bsdf type='mixturebsdf'>" + diffuse + "</bsdf>", "2:1: 'mixturebsdf' needs 'weights'"},
        {"<bsdf type='mixturebsdf'><string name='weights' value='1, x'/>" + diffuse + "</bsdf>",
         "2:56: '1, x' is not a list of numbers"},
        {"<bsdf type='mixturebsdf'><string name='weights' value='0.5, 0.5'/>" + diffuse + "</bsdf>",
         "2:56: 2 weights for 1 materials"},
        {"<bsdf type='mixturebsdf'><string name='weights' value='-0.5'/>" + diffuse + "</bsdf>",
         "2:56: 'weights' must not be negative"},
        {"<bsdf type='mixturebsdf'><string name='weights' value='0'/>" + diffuse + "</bsdf>",
         "2:56: one of the 'weights' must be above 0"},
        {"<bsdf type='coating'><float name='thickness' value='-1'/>" + diffuse + "</bsdf>",
         "2:53: 'thickness' must not be negative"},
        {"<bsdf type='coating'><rgb name='sigma_a' value='-1'/>" + diffuse + "</bsdf>",
         "2:49: 'sigma_a' must not be negative"},
    };
    for (const auto& [bsdf, message] : table)
        EXPECT_EQ(error(bsdf), "test.xml:" + message);
}

TEST(BsdfPlugins, ReplacesAnUnknownBsdfByMagenta) {
    const Read r = read("<bsdf type='irawan'/>");
    EXPECT_EQ(r.notes, "the bsdf 'irawan' is not known; diffuse magenta is used instead\n");
}

} // namespace tessera::test
