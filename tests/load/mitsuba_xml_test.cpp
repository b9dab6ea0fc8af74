// Well-formed scenes: spellings, defaults, transforms and references.

#include "render/load/mitsuba_xml.h"
#include "tests/load/temporary_folder.h"

#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

LoadedScene parse(const std::string& body, const std::string& version = "3.0.0",
                  const SceneVariables& variables = {}) {
    return parse_mitsuba_xml("<scene version=\"" + version + "\">" + body + "</scene>", "test.xml", variables);
}

std::string all(const LoadedScene& loaded) {
    std::string result;
    for (const LoadNote& note : loaded.notes)
        result += note.where.to_string() + ": " + note.text + "\n";
    return result;
}

/// Returns the corner (-1, -1, 0) of a rectangle after a transform with these steps.
glm::vec3 transformed_corner(const std::string& steps) {
    const auto loaded =
        parse("<shape type='rectangle'><transform name='to_world'>" + steps + "</transform></shape>");
    return loaded.description.shapes.at(0).mesh.positions.at(0);
}

glm::vec3 front_of(const std::string& parameters) {
    const auto loaded = parse("<shape type='rectangle'>" + parameters + "</shape>");
    const Mesh& mesh = loaded.description.shapes.at(0).mesh;
    return front_normal(mesh, mesh.triangles[0]);
}

template <class Kind>
Kind material(const std::string& bsdf, const std::string& version = "3.0.0") {
    return std::get<Kind>(parse(bsdf, version).description.materials.at(0).kind);
}

void expect_near(glm::vec3 a, glm::vec3 b) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(a[i], b[i], 1e-5f) << i;
}

} // namespace

TEST(MitsubaXml, AcceptsBothSpellings) {
    const char* old_spelling = "<integrator type='path'><integer name='maxDepth' value='7'/></integrator>"
                               "<sensor type='perspective'><float name='fov' value='40'/>"
                               "<string name='fovAxis' value='y'/>"
                               "<transform name='toWorld'><translate x='2'/></transform></sensor>"
                               "<bsdf type='dielectric'><float name='intIOR' value='3'/>"
                               "<float name='extIOR' value='2'/></bsdf>";
    const char* new_spelling = "<integrator type='path'><integer name='max_depth' value='7'/></integrator>"
                               "<sensor type='perspective'><float name='fov' value='40'/>"
                               "<string name='fov_axis' value='y'/>"
                               "<transform name='to_world'><translate x='2'/></transform></sensor>"
                               "<bsdf type='dielectric'><float name='int_ior' value='3'/>"
                               "<float name='ext_ior' value='2'/></bsdf>";
    for (const auto& [body, version] : {std::pair(old_spelling, "0.6.0"), std::pair(new_spelling, "3.0.0")}) {
        const LoadedScene loaded = parse(body, version);
        EXPECT_EQ(loaded.description.max_depth, 7);
        EXPECT_EQ(loaded.description.camera.fov_axis, FovAxis::y);
        EXPECT_EQ(loaded.description.camera.to_world[3], glm::vec4(2, 0, 0, 1));
        EXPECT_FLOAT_EQ(std::get<DielectricMaterial>(loaded.description.materials[0].kind).eta, 1.5f);
        EXPECT_EQ(all(loaded), "");
    }
}

TEST(MitsubaXml, StepsOfATransformApplyInOrder) {
    expect_near(transformed_corner("<translate x='1' y='1'/><scale x='2' y='3' z='4'/>"), {0, 0, 0});
    expect_near(transformed_corner("<scale x='2' y='3'/><translate x='1' y='1' z='5'/>"), {-1, -2, 5});
    expect_near(transformed_corner("<scale value='2'/>"), {-2, -2, 0});
    expect_near(transformed_corner("<scale value='2 3 4'/><translate value='1, 1, 1'/>"), {-1, -2, 1});
    expect_near(transformed_corner("<rotate z='1' angle='90'/><translate x='1'/>"), {2, -1, 0});
    expect_near(transformed_corner("<rotate value='0 0 2' angle='90'/>"), {2, -2, 0}); // as in Mitsuba 3
    expect_near(transformed_corner("<matrix value='1 0 0 5  0 1 0 6  0 0 1 7  0 0 0 1'/>"), {4, 5, 7});
    expect_near(transformed_corner("<matrix value='1 0 0 0 1 0 0 0 1'/><scale x='3'/>"), {-3, -1, 0});
    // lookat maps +z of the shape towards the target, and +x to the left.
    expect_near(transformed_corner("<lookat origin='0,0,5' target='0,0,0' up='0,1,0'/>"), {1, -1, 5});
    expect_near(transformed_corner("<look_at origin='5,0,0' target='9,0,0' up='0,0,1'/>"), {5, -1, -1});
    expect_near(transformed_corner(""), {-1, -1, 0});
}

TEST(MitsubaXml, FrontOfARectangle) {
    expect_near(front_of(""), {0, 0, 1});
    expect_near(front_of("<boolean name='flip_normals' value='true'/>"), {0, 0, -1});
    expect_near(front_of("<boolean name='flipNormals' value='true'/>"), {0, 0, -1});
    // Normals transform by the inverse transpose, so mirroring along x keeps +z.
    expect_near(front_of("<transform name='to_world'><scale x='-1'/></transform>"), {0, 0, 1});
    expect_near(front_of("<transform name='to_world'><scale z='-1'/></transform>"), {0, 0, -1});
    expect_near(front_of("<transform name='to_world'><scale z='0'/></transform>"), {0, 0, 1});
}

TEST(MitsubaXml, CubeFacesPointOutward) {
    for (const char* transform : {"", "<transform name='to_world'><scale x='-2' y='3'/></transform>"}) {
        const auto loaded = parse(std::string("<shape type='cube'>") + transform + "</shape>");
        const Mesh& mesh = loaded.description.shapes.at(0).mesh;
        ASSERT_EQ(mesh.triangles.size(), 12u);
        EXPECT_EQ(mesh.positions.size(), 24u);
        EXPECT_EQ(mesh.uvs.size(), 24u);
        float area = 0;
        for (glm::uvec3 t : mesh.triangles) {
            EXPECT_GT(glm::dot(front_normal(mesh, t), mesh.positions[t.x]), 0);
            const glm::vec2 a = mesh.uvs[t.y] - mesh.uvs[t.x];
            const glm::vec2 b = mesh.uvs[t.z] - mesh.uvs[t.x];
            area += std::abs(a.x * b.y - a.y * b.x) / 2;
        }
        EXPECT_FLOAT_EQ(area, 6); // the UVs of each face cover the unit square
    }
}

TEST(MitsubaXml, ExpandsVariablesInTypesAndPartsOfValues) {
    const std::string body = "<default name='kind' value='sppm'/><default name='depth' value='3'/>"
                             "<default name='w' value='8'/>"
                             "<integrator type='$kind'><integer name='max_depth' value='$depth'/></integrator>"
                             "<sensor type='perspective'><film type='hdrfilm'><integer name='width' value='1${'/>"
                             "</film></sensor>";
    std::string good = body;
    good.replace(good.find("1${"), 3, "1$w");
    EXPECT_EQ(parse(good).description.size.x, 18);
    EXPECT_NE(all(parse(good)).find("the integrator 'sppm'"), std::string::npos);
    const LoadedScene path = parse(good, "3.0.0", {{"kind", "path"}, {"depth", "5"}});
    EXPECT_EQ(path.description.max_depth, 5);
    EXPECT_EQ(all(path), "");
    EXPECT_THROW(parse(body), LoadError);
}

TEST(MitsubaXml, LimitsMaxDepthTo64) {
    EXPECT_EQ(parse("<integrator type='path'/>").description.max_depth, 65);
    EXPECT_EQ(all(parse("<integrator type='path'><integer name='max_depth' value='64'/></integrator>"))
                  .find("max_depth"),
              std::string::npos);
    EXPECT_NE(all(parse("<integrator type='path'><integer name='max_depth' value='65'/></integrator>"))
                  .find("max_depth 65 is reduced to 64"),
              std::string::npos)
        << "65 exceeds the limit of 64";
    EXPECT_EQ(
        parse("<integrator type='path'><integer name='max_depth' value='-1'/></integrator>").description.max_depth,
        65);
    // The depth of a nested integrator counts.
    EXPECT_EQ(parse("<integrator type='aov'><integrator type='path'><integer name='max_depth' value='4'/>"
                    "</integrator></integrator>")
                  .description.max_depth,
              4);
}

TEST(MitsubaXml, Camera) {
    const auto camera = [](const std::string& body) {
        return parse("<sensor type='perspective'>" + body + "</sensor>").description.camera;
    };
    EXPECT_EQ(camera("<float name='fov' value='30'/>").fov_axis, FovAxis::x);
    EXPECT_EQ(camera("<float name='fov' value='30'/><string name='fov_axis' value='larger'/>").fov_axis,
              FovAxis::larger);
    EXPECT_EQ(camera("").fov_axis, FovAxis::diagonal); // the default focal length of 50 mm is diagonal
    EXPECT_NEAR(camera("").fov, 46.79f, 0.01f);
    EXPECT_NEAR(camera("<string name='focal_length' value='25mm'/>").fov, 81.74f, 0.01f);
}

TEST(MitsubaXml, OtherSensors) {
    const auto load = [](const std::string& type, const std::string& body) {
        return parse("<sensor type='" + type + "'>" + body + "</sensor>", "2.0.0");
    };
    const auto lens = load("thinlens", "<float name='fov' value='30'/><float name='apertureRadius' value='0.5'/>"
                                       "<float name='focusDistance' value='7'/>");
    EXPECT_EQ(all(lens), "");
    EXPECT_EQ(lens.description.camera.fov, 30);
    EXPECT_EQ(lens.description.camera.aperture_radius, 0.5f);
    EXPECT_EQ(lens.description.camera.focus_distance, 7);
    const auto far =
        load("thinlens", "<float name='aperture_radius' value='1'/><float name='far_clip' value='2e3'/>");
    EXPECT_EQ(far.description.camera.focus_distance, 2e3f);

    const auto parallel = load("orthographic", "<float name='focus_distance' value='7'/>");
    EXPECT_EQ(all(parallel), "");
    EXPECT_TRUE(parallel.description.camera.is_orthographic);
    EXPECT_EQ(parallel.description.camera.aperture_radius, 0);
    const auto telecentric = load("telecentric", "<float name='apertureRadius' value='0.5'/>");
    EXPECT_TRUE(telecentric.description.camera.is_orthographic);
    EXPECT_EQ(telecentric.description.camera.aperture_radius, 0.5f);

    const auto offset = load("perspective", "<float name='principalPointOffsetX' value='0.1'/>"
                                            "<float name='principal_point_offset_y' value='-0.2'/>");
    EXPECT_EQ(all(offset), "");
    EXPECT_EQ(offset.description.camera.principal_offset, glm::vec2(0.1f, -0.2f));
    EXPECT_NE(all(load("radiancemeter", "")).find("the sensor 'radiancemeter' is replaced by 'perspective'"),
              std::string::npos);
}

TEST(MitsubaXml, Conductors) {
    const auto mirror =
        material<ConductorMaterial>("<bsdf type='conductor'><string name='material' value='none'/></bsdf>");
    EXPECT_EQ(mirror.eta, Rgb(0));
    EXPECT_EQ(mirror.k, Rgb(1));
    EXPECT_EQ(mirror.alpha.evaluate({}), Rgb(0));

    const auto relative = material<ConductorMaterial>(
        "<bsdf type='conductor'><rgb name='eta' value='2, 3, 4'/><rgb name='k' value='6'/>"
        "<float name='extEta' value='2'/><rgb name='specularReflectance' value='0.5'/></bsdf>");
    EXPECT_EQ(relative.eta, Rgb(1, 1.5f, 2));
    EXPECT_EQ(relative.k, Rgb(3));
    EXPECT_EQ(relative.specular_reflectance.evaluate({}), Rgb(0.5f));

    // The default is copper in air in version 0.6, and a perfect mirror in version 3.
    EXPECT_NEAR(material<ConductorMaterial>("<bsdf type='conductor'/>", "0.6.0").k.r, 3.912948f / 1.000277f,
                1e-4f);
    EXPECT_EQ(material<ConductorMaterial>("<bsdf type='conductor'/>").k, Rgb(1));

    const auto rough = material<ConductorMaterial>("<bsdf type='roughconductor'><float name='alpha' value='0.3'/>"
                                                   "<string name='distribution' value='ggx'/></bsdf>");
    EXPECT_EQ(rough.distribution, MicrofacetDistribution::ggx);
    EXPECT_FLOAT_EQ(rough.alpha.evaluate({}).r, 0.3f);
    EXPECT_EQ(material<ConductorMaterial>("<bsdf type='roughconductor'/>").distribution,
              MicrofacetDistribution::beckmann);
    const auto textured = material<ConductorMaterial>(
        "<bsdf type='roughconductor'><texture name='alpha' type='checkerboard'>"
        "<float name='color0' value='0.1'/><float name='color1' value='0.6'/></texture></bsdf>");
    EXPECT_FLOAT_EQ(textured.alpha.evaluate({{0.75f, 0.25f}}).r, 0.6f);
}

TEST(MitsubaXml, NamedIndicesOfRefraction) {
    const auto eta = [](const std::string& body) {
        return material<DielectricMaterial>("<bsdf type='dielectric'>" + body + "</bsdf>").eta;
    };
    EXPECT_FLOAT_EQ(eta(""), 1.5046f / 1.000277f);
    EXPECT_FLOAT_EQ(eta("<string name='int_ior' value='water'/>"), 1.333f / 1.000277f);
    EXPECT_FLOAT_EQ(eta("<string name='intIOR' value='BK7'/><string name='extIOR' value='vacuum'/>"), 1.5046f);
    EXPECT_FLOAT_EQ(eta("<string name='int_ior' value='air'/><string name='ext_ior' value='glass'/>"),
                    1.000277f / 1.5046f);
}

TEST(MitsubaXml, MaterialsAreSharedAndNested) {
    const auto loaded =
        parse("<bsdf type='bumpmap'><bsdf type='diffuse' id='inner'/><texture type='checkerboard'/></bsdf>"
              "<shape type='cube'><ref id='late'/></shape><shape type='cube'><ref id='late'/></shape>"
              "<shape type='cube'><ref id='inner'/></shape><shape type='cube'/>"
              "<shape type='cube'><bsdf type='twosided'><ref id='late'/></bsdf></shape>"
              "<bsdf type='diffuse' id='late'><rgb name='reflectance' value='0.25'/></bsdf>"
              "<alias id='late' as='other'/><shape type='cube'><ref id='other'/></shape>");
    const auto& shapes = loaded.description.shapes;
    const auto& materials = loaded.description.materials;
    ASSERT_EQ(shapes.size(), 6u);
    EXPECT_EQ(shapes[0].material, shapes[1].material);
    EXPECT_EQ(shapes[0].material, shapes[5].material);
    EXPECT_EQ(materials[static_cast<std::size_t>(shapes[0].material)].name, "late");
    EXPECT_EQ(materials[static_cast<std::size_t>(shapes[2].material)].name, "inner");
    EXPECT_FALSE(materials[static_cast<std::size_t>(shapes[3].material)].two_sided);
    const Material& wrapped = materials[static_cast<std::size_t>(shapes[4].material)];
    EXPECT_TRUE(wrapped.two_sided);
    EXPECT_EQ(std::get<DiffuseMaterial>(wrapped.kind).reflectance.evaluate({}), Rgb(0.25f));
}

TEST(MitsubaXml, Colors) {
    const auto color = [](const std::string& element) {
        return material<DiffuseMaterial>("<bsdf type='diffuse'>" + element + "</bsdf>").reflectance.evaluate({});
    };
    EXPECT_EQ(color("<rgb name='reflectance' value='0.1 0.2 0.3'/>"), Rgb(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(color("<rgb name='reflectance' value='0.1, 2e-1,  +.3'/>"), Rgb(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(color("<spectrum name='reflectance' value='0.4'/>"), Rgb(0.4f));
    EXPECT_EQ(color("<float name='reflectance' value='0.4'/>"), Rgb(0.4f));
    EXPECT_EQ(color("<rgb name='reflectance' value='#ff0033'/>"), Rgb(1, 0, 0.2f));
    EXPECT_NEAR(color("<srgb name='reflectance' value='0.5, 0, 1'/>").r, 0.21404f, 1e-5f);
    EXPECT_EQ(color("<rgb name='reflectance' value='1.5, 0.5, 0'/>"), Rgb(1, 0.5f, 0));
    EXPECT_EQ(color(""), Rgb(0.5f));
}

TEST(MitsubaXml, TexturesByReference) {
    const auto diffuse = material<DiffuseMaterial>(
        "<texture type='checkerboard' id='t'><rgb name='color0' value='0.9'/><rgb name='color1' value='0.1'/>"
        "<transform name='to_uv'><scale x='2' y='2'/><translate x='0.5'/></transform></texture>"
        "<bsdf type='diffuse'><ref name='reflectance' id='t'/></bsdf>");
    EXPECT_EQ(diffuse.reflectance.evaluate({{0.1f, 0.1f}}), Rgb(0.1f)); // at (0.7, 0.2) of the pattern
    EXPECT_EQ(diffuse.reflectance.evaluate({{0.3f, 0.1f}}), Rgb(0.9f)); // at (0.1, 0.2)
    const auto planar = material<DiffuseMaterial>(
        "<bsdf type='diffuse'><texture name='reflectance' type='checkerboard'>"
        "<transform name='to_uv'><matrix value='2 0 0.5  0 2 0  0 0 1'/></transform></texture></bsdf>");
    EXPECT_EQ(planar.reflectance.evaluate({{0.1f, 0.1f}}), Rgb(0.2f));
}

TEST(MitsubaXml, ReportsEverythingThatIsNotUsed) {
    const LoadedScene loaded = parse_mitsuba_xml("<scene version='3.0.0'>\n"
                                                 "  <bsdf type='velvet'/>\n"
                                                 "  <bsdf type='diffuse'><float name='shine' value='1'/></bsdf>\n"
                                                 "  <emitter type='lantern'/>\n"
                                                 "  <shape type='torus'/>\n"
                                                 "  <medium type='homogeneous'/>\n"
                                                 "  <shape type='cube'><emitter type='laser'/></shape>\n"
                                                 "  <integrator type='path'>\n"
                                                 "    <boolean name='block_size_y' value='true'/></integrator>\n"
                                                 "</scene>",
                                                 "n.xml");
    EXPECT_EQ(all(loaded), "n.xml:1:1: the scene has no sensor: a camera at the origin looks along +z\n"
                           "n.xml:2:3: the bsdf 'velvet' is not known; diffuse magenta is used instead\n"
                           "n.xml:3:24: 'shine' of bsdf 'diffuse' is not used\n"
                           "n.xml:4:3: the emitter 'lantern' is not known; it gives no light\n"
                           "n.xml:5:3: the shape 'torus' is not known; the shape is left out\n"
                           "n.xml:6:3: <medium> is not known and not used\n"
                           "n.xml:7:22: the emitter 'laser' is not known; it gives no light\n"
                           "n.xml:9:5: 'block_size_y' of integrator 'path' is not used\n");
    const auto& magenta = std::get<DiffuseMaterial>(loaded.description.materials[0].kind);
    EXPECT_EQ(magenta.reflectance.evaluate({}), Rgb(1, 0, 1));
}

TEST(MitsubaXml, TheDirectIntegratorMeansTwoEdges) {
    const LoadedScene loaded =
        parse_mitsuba_xml("<scene version='3.0.0'><integrator type='direct'>"
                          "<integer name='emitter_samples' value='4'/></integrator></scene>",
                          "s.xml");
    EXPECT_EQ(loaded.description.max_depth, 2);
    for (const LoadNote& note : loaded.notes)
        EXPECT_EQ(note.text.find("integrator"), std::string::npos) << note.text;
}

TEST(MitsubaXml, UsesOnlyTheFirstOfDuplicateElements) {
    const auto loaded =
        parse("<integrator type='path'><integer name='max_depth' value='3'/></integrator>\n"
              "<integrator type='path'><integer name='max_depth' value='5'/></integrator>\n"
              "<sensor type='perspective'><film type='hdrfilm'><integer name='width' value='10'/></film>\n"
              "<film type='hdrfilm'><integer name='width' value='20'/></film></sensor>\n"
              "<sensor type='orthographic'/>\n"
              "<shape type='rectangle'><bsdf type='diffuse'><texture type='scale' name='reflectance'>"
              "<float name='scale' value='0.5'/><texture type='checkerboard'/>\n<texture "
              "type='bitmap'/></texture></bsdf>\n"
              "<bsdf type='conductor'/></shape>",
              "0.6.0");
    EXPECT_EQ(loaded.description.max_depth, 3);
    EXPECT_EQ(loaded.description.size.x, 10);
    EXPECT_FALSE(loaded.description.camera.is_orthographic);
    const auto& diffuse = std::get<DiffuseMaterial>(loaded.description.materials.at(0).kind);
    EXPECT_TRUE(std::holds_alternative<CheckerboardTexture>(diffuse.reflectance.kind));
    EXPECT_EQ(all(loaded), "test.xml:2:1: only the first integrator is used\n"
                           "test.xml:4:1: only the first <film> in 'perspective' is used\n"
                           "test.xml:7:1: only the first <texture> in 'scale' is used\n"
                           "test.xml:8:1: only the first <bsdf> in 'rectangle' is used\n");
}

/// The expected values are Mitsuba 3.9's.
TEST(MitsubaXml, RotationAboutAnUnnormalisedAxisStretchesInVersion3) {
    const std::string steps = "<translate x='3' y='4' z='5'/><rotate y='2' angle='30'/>"; // applied to (-1, -1, 0)
    const glm::vec3 stretched = transformed_corner(steps);
    EXPECT_NEAR(stretched.x, 0.866025f * 2 + 5, 1e-4f);
    EXPECT_NEAR(stretched.y, 1.40192f * 3, 1e-4f);
    EXPECT_NEAR(stretched.z, -2 + 0.866025f * 5, 1e-4f);
    const auto old =
        parse("<shape type='rectangle'><transform name='toWorld'>" + steps + "</transform></shape>", "0.6.0");
    EXPECT_NEAR(old.description.shapes.at(0).mesh.positions.at(0).y, 3, 1e-4f);
}

TEST(MitsubaXml, FilesAreFoundBesideTheScene) {
    const TemporaryFolder folder;
    folder.write("a/models/one two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    // An image of 2 x 1 pixels: red, blue.
    folder.write("a/t.tga", tga_row(std::string("\0\0\xff\xff\0\0", 6)));
    const auto scene = folder.write(
        "a/scene.xml",
        "<scene version='3.0.0'><shape type='obj'><string name='filename' value='models/one two.obj'/>"
        "<bsdf type='diffuse'><texture name='reflectance' type='bitmap'><string name='filename' "
        "value='t.tga'/></texture></bsdf></shape>"
        "<bsdf type='diffuse'><texture name='reflectance' type='bitmap'><string name='filename' "
        "value='./t.tga'/><string name='filter_type' value='nearest'/></texture></bsdf>"
        "<bsdf type='diffuse'><texture name='reflectance' type='bitmap'><string name='filename' "
        "value='t.tga'/><boolean name='raw' value='true'/></texture></bsdf></scene>");
    const LoadedScene loaded = load_mitsuba_xml(scene);
    const Mesh& mesh = loaded.description.shapes.at(0).mesh;
    EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 0}})); // v grows downwards in Tessera
    EXPECT_EQ(mesh.normals.size(), 3u);                                    // computed
    const auto texture = [&](std::size_t i) {
        const auto& diffuse = std::get<DiffuseMaterial>(loaded.description.materials.at(i).kind);
        return std::get<BitmapTexture>(diffuse.reflectance.kind);
    };
    EXPECT_EQ(texture(0).bitmap, texture(1).bitmap); // the file is read once
    EXPECT_EQ(texture(1).filter, Filter::nearest);
    EXPECT_FALSE(texture(2).bitmap->srgb);
    EXPECT_EQ(texture(0).bitmap->texel(0, 0), Rgb(1, 0, 0));
    EXPECT_EQ(texture(0).bitmap->texel(1, 0), Rgb(0, 0, 1));
}

} // namespace tessera
