// Colours, spectra, and mesh attributes in scene files.

#include "render/load/mitsuba_xml.h"
#include "render/load/properties.h"
#include "render/mesh/meshes.h"

#include <tuple>

#include <gtest/gtest.h>

namespace tessera {

namespace {

LoadedScene parse(const std::string& body, const std::string& version = "3.0.0") {
    return parse_mitsuba_xml("<scene version='" + version + "'><sensor type='perspective'/>" + body + "</scene>",
                             "c.xml");
}

Texture reflectance(const std::string& element) {
    const LoadedScene loaded = parse("<bsdf type='diffuse'>" + element + "</bsdf>");
    return std::get<DiffuseMaterial>(loaded.description.materials.at(0).kind).reflectance;
}

Rgb color(const std::string& element) {
    return reflectance(element).evaluate({});
}

Rgb radiance(const std::string& element) {
    const LoadedScene loaded =
        parse("<shape type='rectangle'><emitter type='area'>" + element + "</emitter></shape>");
    return loaded.description.area_lights.at(0).radiance.mean();
}

void expect_near(Rgb a, Rgb b, float tolerance) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

std::string notes_of(const std::string& element) {
    std::string result;
    for (const LoadNote& note : parse("<bsdf type='diffuse'>" + element + "</bsdf>").notes)
        result += note.text + "\n";
    return result;
}

std::string ply(const std::string& properties, const std::string& values) {
    return "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n" +
           properties + "end_header\n0 0 0 " + values + "\n";
}

} // namespace

TEST(Colors, SpectraBecomeColors) {
    expect_near(color("<spectrum name='reflectance' value='360:0.4, 830:0.4'/>"), Rgb(0.4f), 1e-4f);
    EXPECT_EQ(color("<spectrum name='reflectance' value='500:0.4'/>"), Rgb(0.4f));
    const Rgb red = color("<spectrum name='reflectance' value='400:0, 580:0, 620:0.8, 720:0.8'/>");
    EXPECT_GT(red.r, 0.5f);
    EXPECT_LT(red.g + red.b, 0.15f);
    const Rgb blue = color("<spectrum name='reflectance' value='400:0.8, 470:0.8, 500:0, 700:0'/>");
    EXPECT_GT(blue.b, 0.5f);
    EXPECT_LT(blue.r + blue.g, 0.15f);
    EXPECT_EQ(notes_of("<spectrum name='reflectance' value='400:0.1, 700:0.9'/>"),
              "the spectrum is replaced by its linear sRGB colour\n");
}

/// The expected values are Mitsuba 3.9's in RGB mode. The tolerance covers its tabulated colour matching
/// functions.
TEST(Colors, ConvertsSpectraAsMitsubaDoes) {
    const std::string list = "400:0.1, 500:0.5, 600:0.9, 700:0.3";
    expect_near(color("<spectrum name='reflectance' value='" + list + "'/>"), {0.8548f, 0.6875f, 0.2650f}, 0.01f);
    expect_near(radiance("<spectrum name='radiance' value='" + list + "'/>"), {0.9992f, 0.6597f, 0.2294f}, 0.01f);
    expect_near(radiance("<spectrum name='radiance' value='0.5'/>"), {0.6024f, 0.4741f, 0.4545f}, 0.005f);
    EXPECT_EQ(color("<spectrum name='reflectance' value='0.5'/>"), Rgb(0.5f));
}

TEST(Colors, SpectrumPlugins) {
    EXPECT_EQ(color("<spectrum name='reflectance' type='uniform'><float name='value' value='0.25'/></spectrum>"),
              Rgb(0.25f));
    expect_near(
        color("<spectrum name='reflectance' type='irregular'><string name='wavelengths' value='360, 600, 830'/>"
              "<string name='values' value='0.3, 0.3, 0.3'/></spectrum>"),
        Rgb(0.3f), 1e-4f);
    expect_near(color("<spectrum name='reflectance' type='regular'><string name='values' value='0.3, 0.3'/>"
                      "<float name='wavelength_min' value='360'/><float name='wavelength_max' value='830'/>"
                      "</spectrum>"),
                Rgb(0.3f), 1e-4f);
    EXPECT_EQ(radiance("<spectrum name='radiance' type='d65'><float name='scale' value='3'/></spectrum>"), Rgb(3));
    EXPECT_EQ(color("<spectrum name='reflectance' type='odd'/>"), Rgb(0.5f));
    EXPECT_EQ(notes_of("<spectrum name='reflectance' type='odd'/>"),
              "the spectrum 'odd' is not known; a default is used instead\n");
}

TEST(Colors, BlackBodies) {
    // Planck's law gives 1.27e4 W / (m^2 sr nm) at 555 nm and 5000 K. Luminance averages around 555 nm.
    const Rgb body = rgb_of_black_body(5000);
    EXPECT_NEAR(0.2126f * body.r + 0.7152f * body.g + 0.0722f * body.b, 1.25e4f, 0.05e4f);
    EXPECT_GT(body.r, body.b);
    const Rgb daylight = rgb_of_black_body(6504);
    EXPECT_NEAR(daylight.b / daylight.r, 1, 0.1); // nearly white
    EXPECT_EQ(rgb_of_black_body(1e-3), Rgb(0));
    EXPECT_EQ(radiance("<blackbody name='radiance' temperature='5000K' scale='0.5'/>"), 0.5f * body);
    EXPECT_EQ(
        radiance("<spectrum name='radiance' type='blackbody'><float name='temperature' value='5000'/></spectrum>"),
        body);
}

TEST(Colors, RawConstantsAreNumbersOrVectors) {
    EXPECT_EQ(color("<texture name='reflectance' type='rawconstant'><float name='value' value='0.4'/></texture>"),
              Rgb(0.4f));
    EXPECT_EQ(color("<texture name='reflectance' type='rawconstant'><vector name='value' value='0.3, 0.2, 1'/>"
                    "</texture>"),
              Rgb(0.3f, 0.2f, 1));
}

TEST(Colors, TexturesOfTheOldSyntax) {
    EXPECT_EQ(color("<texture name='reflectance' type='scale'><float name='scale' value='0.5'/>"
                    "<texture type='checkerboard'><float name='color0' value='0.8'/></texture></texture>"),
              Rgb(0.4f));
    EXPECT_EQ(color("<texture name='reflectance' type='scale'><rgb name='scale' value='0.5'/>"
                    "<rgb name='value' value='0.2, 0.4, 0.6'/></texture>"),
              0.5f * Rgb(0.2f, 0.4f, 0.6f));
}

TEST(Colors, MeshAttributes) {
    Mesh mesh;
    mesh.positions.resize(4);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.attributes = {{"vertex_color", {Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1), Rgb(0)}},
                       {"face_color", {Rgb(0.1f, 0.2f, 0.3f), Rgb(0.5f)}}};
    const SurfacePoint at = surface_point(mesh, 1, {0.25f, 0.5f});
    EXPECT_EQ(reflectance("<texture name='reflectance' type='vertexcolors'/>").evaluate(at), Rgb(0.25f, 0, 0.25f));
    const auto attribute = [](const std::string& name) {
        return reflectance("<texture name='reflectance' type='mesh_attribute'><string name='name' value='" + name +
                           "'/><float name='scale' value='2'/></texture>");
    };
    EXPECT_EQ(attribute("vertex_color").evaluate(at), 2.0f * Rgb(0.25f, 0, 0.25f));
    EXPECT_EQ(attribute("face_color").evaluate(at), Rgb(1));
    EXPECT_EQ(attribute("face_color").evaluate(surface_point(mesh, 0, {0.25f, 0.5f})), Rgb(0.2f, 0.4f, 0.6f));
    EXPECT_EQ(attribute("face_else").evaluate(at), Rgb(2)); // white
    const LoadedScene loaded = parse("<shape type='cube'><bsdf type='diffuse'><texture name='reflectance' "
                                     "type='mesh_attribute'><string name='name' value='face_x'/></texture></bsdf>"
                                     "</shape>");
    ASSERT_FALSE(loaded.notes.empty());
    EXPECT_EQ(loaded.notes.back().text, "the shape has no attribute 'face_x'; white is used instead");
}

TEST(Colors, VertexColorsOfPlyFiles) {
    const std::string bytes = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    expect_near(parse_ply(ply(bytes, "255 128 0")).mesh.attribute(vertex_color)->values.at(0),
                Rgb(1, 0.215861f, 0), 1e-5f);
    expect_near(parse_ply(ply(bytes, "255 128 0"), {false, false}).mesh.attribute(vertex_color)->values.at(0),
                Rgb(1, 128 / 255.0f, 0), 1e-6f);
    const std::string floats = "property float r\nproperty float g\nproperty float b\n";
    EXPECT_EQ(parse_ply(ply(floats, "0.5 1.5 0")).mesh.attribute(vertex_color)->values.at(0), Rgb(0.5f, 1.5f, 0));
    EXPECT_NEAR(parse_ply(ply(floats, "0.5 1 0"), {true, true}).mesh.attribute(vertex_color)->values.at(0).r,
                0.214041f, 1e-5f);
    EXPECT_NEAR(parse_ply(ply("property ushort red\nproperty ushort green\nproperty ushort blue\n", "65535 0 0"))
                    .mesh.attribute(vertex_color)
                    ->values.at(0)
                    .r,
                1, 1e-6);
    EXPECT_FALSE(parse_ply(ply("property float red\n", "1")).mesh.attribute(vertex_color));
}

TEST(Colors, MetalsByName) {
    EXPECT_FLOAT_EQ(metal_index("Cr")->eta.r, 4.369683f);
    EXPECT_FLOAT_EQ(metal_index("W")->k.b, 2.273193f);
    EXPECT_EQ(metal_index("Ni_palik")->eta, metal_index("Ni")->eta);
    EXPECT_FALSE(metal_index("AlSb"));
    EXPECT_FALSE(metal_index("_palik"));
    for (const char* name :
         {"a-C",  "Ag", "Al", "AlAs", "Au",   "Be",  "Cr",  "CsI",  "Cu",     "Cu2O", "CuO", "d-C",  "Hg",
          "HgTe", "Ir", "K",  "Li",   "MgO",  "Mo",  "Na",  "Nb",   "Ni",     "Rh",   "Se",  "Se-e", "SiC",
          "SnTe", "Ta", "Te", "Te-e", "ThF4", "TiC", "TiN", "TiO2", "TiO2-e", "V",    "VC",  "VN",   "W"}) {
        const auto index = metal_index(name);
        ASSERT_TRUE(index) << name;
        for (int i = 0; i < 3; ++i)
            EXPECT_TRUE(index->eta[i] > 0 && index->k[i] >= 0) << name;
    }
}

} // namespace tessera
