// Features of Mitsuba that exporters use: materials of OBJ files, spectra in files, one channel of a bitmap, two
// BSDFs in `twosided`, `merge`, and backslashes.

#include "render/io/plain_images.h"
#include "render/load/mitsuba_xml.h"
#include "render/load/properties.h"
#include "tests/load/temporary_folder.h"

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Notes = std::vector<std::string>;

// Two squares, left and right of x = 0, of two objects and materials.
const std::string two_squares = "mtllib a.mtl\nv -1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\nv 1 0 0\nv 1 1 0\n"
                                "o left\nusemtl red\nf 1 2 3 4\no right\nusemtl blue\nf 2 5 6 3\n";

class ExporterScene : public testing::Test {
protected:
    SceneDescription load(const std::string& body, const std::string& version = "0.6.0") {
        LoadedScene scene = load_mitsuba_xml(folder.write("s.xml", "<scene version='" + version + "'>" + body +
                                                                       "<sensor type='perspective'/></scene>"));
        notes.clear();
        for (const LoadNote& note : scene.notes)
            notes.push_back((note.is_error ? "error: " : "") + note.text);
        return scene.description;
    }
    SceneDescription load_obj(const std::string& inside) {
        return load("<shape type='obj'><string name='filename' value='a.obj'/>" + inside + "</shape>");
    }

    static std::string diffuse(const std::string& color, const std::string& attributes = "") {
        return "<bsdf type='diffuse' " + attributes + "><rgb name='reflectance' value='" + color + "'/></bsdf>";
    }

    /// Returns the reflectance of the shape that has triangles at this x; magenta if there is none.
    static Rgb reflectance_at(const SceneDescription& scene, float x) {
        for (const Shape& shape : scene.shapes)
            for (const glm::uvec3 t : shape.mesh.triangles) {
                float middle = 0;
                for (int i = 0; i < 3; ++i)
                    middle += shape.mesh.positions.at(t[i]).x / 3;
                if ((middle > 0) == (x > 0))
                    return reflectance_of(scene.materials.at(static_cast<std::size_t>(shape.material)));
            }
        return {1, 0, 1};
    }
    static Rgb reflectance_of(const Material& material) {
        return std::get<DiffuseMaterial>(material.kind).reflectance.evaluate(glm::vec2(0.3f));
    }
    static std::size_t triangles_of(const SceneDescription& scene) {
        std::size_t count = 0;
        for (const Shape& shape : scene.shapes)
            count += shape.mesh.triangles.size();
        return count;
    }

    TemporaryFolder folder;
    Notes notes;
};

const Rgb red(0.8f, 0.1f, 0.1f), blue(0.1f, 0.1f, 0.8f), default_grey(0.5f);
const std::string red_text = "0.8 0.1 0.1", blue_text = "0.1 0.1 0.8";

} // namespace

TEST_F(ExporterScene, ObjPartsHaveTheBsdfsThatUsemtlNames) {
    folder.write("a.obj", two_squares);
    const SceneDescription both = load_obj(diffuse(red_text, "name='red'") + diffuse(blue_text, "name='blue'"));
    EXPECT_EQ(both.shapes.size(), 2u);
    EXPECT_EQ(triangles_of(both), 4u);
    EXPECT_EQ(reflectance_at(both, -1), red);
    EXPECT_EQ(reflectance_at(both, 1), blue);
    EXPECT_THAT(notes, IsEmpty());

    const SceneDescription one = load_obj(diffuse(red_text, "name='red'") + diffuse("0.3"));
    EXPECT_EQ(reflectance_at(one, -1), red);
    EXPECT_EQ(reflectance_at(one, 1), Rgb(0.3f));

    // A name that does not occur: alone, it is for all parts, as exporters write any name.
    const SceneDescription alone = load_obj(diffuse("0.3", "name='bsdf'"));
    EXPECT_EQ(alone.shapes.size(), 1u);
    EXPECT_EQ(reflectance_at(alone, 1), Rgb(0.3f));
    load_obj(diffuse(red_text, "name='red'") + diffuse(blue_text, "name='blue'") + diffuse("0.3", "name='green'"));
    EXPECT_THAT(notes, ElementsAre("no face of the file has the material 'green'"));
}

TEST_F(ExporterScene, ShapeIndexChoosesAPart) {
    folder.write("a.obj", two_squares);
    const SceneDescription right = load_obj("<integer name='shapeIndex' value='1'/>" + diffuse("0.3"));
    EXPECT_EQ(triangles_of(right), 2u);
    EXPECT_EQ(reflectance_at(right, 1), Rgb(0.3f));
    EXPECT_EQ(reflectance_at(right, -1), Rgb(1, 0, 1));
    EXPECT_EQ(right.shapes.at(0).mesh.positions.size(), 4u);
    load_obj("<integer name='shapeIndex' value='2'/>" + diffuse("0.3"));
    EXPECT_THAT(notes,
                ElementsAre("error: cannot load 'a.obj': there is no part 2, only 2; the shape is left out"));
}

TEST_F(ExporterScene, MtlMaterialsAreUsedWhereTheSceneGivesNone) {
    folder.write("a.obj", two_squares);
    folder.write("a.mtl",
                 "newmtl red\nKd 0.8 0.1 0.1\nillum 1\nnewmtl blue\nKd 0.1 0.1 0.8\nKs 0.2 0.2 0.2\nNs 20\n"
                 "illum 2\nd 0.5\nmap_bump bump.png\n");
    const SceneDescription scene = load_obj("");
    EXPECT_EQ(reflectance_at(scene, -1), red);
    const Material& shiny = scene.materials.at(static_cast<std::size_t>(scene.shapes.at(0).material));
    ASSERT_TRUE(std::holds_alternative<PhongMaterial>(shiny.kind)); // shapes are in the order of names
    EXPECT_EQ(std::get<PhongMaterial>(shiny.kind).exponent.scalar(glm::vec2(0)), 20);
    EXPECT_TRUE(shiny.two_sided);
    ASSERT_TRUE(shiny.opacity);
    EXPECT_EQ(shiny.opacity->evaluate(glm::vec2(0)), Rgb(0.5f));
    EXPECT_THAT(notes, ElementsAre("material 'blue' of the MTL file: not used: map_bump"));

    EXPECT_EQ(reflectance_at(load_obj(diffuse("0.3")), -1), Rgb(0.3f)); // the scene's has precedence
    EXPECT_EQ(reflectance_at(load_obj(diffuse("0.3", "name='blue'")), -1), red);

    std::filesystem::remove(folder.path() / "a.mtl");
    EXPECT_EQ(reflectance_at(load_obj(""), -1), default_grey);
    EXPECT_THAT(notes, ElementsAre("there is no material library 'a.mtl': its materials are grey"));
}

TEST_F(ExporterScene, SpectraAreReadFromFiles) {
    folder.write("a.spd", "# a lamp\n400 0.5\n\n500, 1.5 # peak\r\n700 1\n");
    const Rgb expected = rgb_of_spectrum({{400, 0.5f}, {500, 1.5f}, {700, 1}}, SpectrumKind::emission);
    const auto intensity = [&](const std::string& spectrum) {
        return load("<emitter type='point'>" + spectrum + "</emitter>", "3.0.0").point_lights.at(0).intensity;
    };
    EXPECT_EQ(intensity("<spectrum name='intensity' filename='a.spd'/>"), expected);
    EXPECT_EQ(intensity("<spectrum name='intensity' type='irregular'><string name='filename' value='a.spd'/>"
                        "</spectrum>"),
              expected);
    EXPECT_THAT(notes, ElementsAre("the spectrum is replaced by its linear sRGB colour"));
    folder.write("b.spd", "400 1\n390 2\n");
    EXPECT_EQ(intensity("<spectrum name='intensity' filename='b.spd'/>"), Rgb(1));
    EXPECT_THAT(notes,
                ElementsAre("error: cannot load 'b.spd': line 2: the wavelengths must increase; a default is "
                            "used instead"));
    intensity("<spectrum name='intensity' filename='c.spd'/>");
    EXPECT_THAT(notes, ElementsAre(testing::HasSubstr("error: there is no file")));
}

TEST_F(ExporterScene, OneChannelOfABitmapIsGrey) {
    RgbImage image(2, 1, Rgb(0.2f, 0.4f, 0.8f));
    write_png(folder.path() / "a.png", image);
    const auto color = [&](const std::string& channel) {
        return reflectance_of(load("<bsdf type='diffuse'><texture type='bitmap' name='reflectance'>"
                                   "<string name='filename' value='a.png'/><string name='channel' value='" +
                                   channel + "'/></texture></bsdf>")
                                  .materials.at(0));
    };
    EXPECT_NEAR(color("r").b, 0.2f, 0.01f);
    EXPECT_NEAR(color("g").r, 0.4f, 0.01f);
    EXPECT_NEAR(color("b").r, 0.8f, 0.01f);
    EXPECT_EQ(color("g").r, color("g").g);
    EXPECT_THAT(notes, IsEmpty());
    EXPECT_EQ(color("a"), Rgb(0.5f));
    EXPECT_THAT(notes, ElementsAre(testing::HasSubstr("it has no alpha channel; grey is used instead")));
}

TEST_F(ExporterScene, TwosidedHasAMaterialBehind) {
    const SceneDescription scene =
        load("<bsdf type='twosided'>" + diffuse(red_text) + diffuse(blue_text) + "</bsdf>");
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(reflectance_of(material), red);
    ASSERT_TRUE(material.back);
    EXPECT_EQ(reflectance_of(*material.back), blue);
    EXPECT_EQ(material.textures().size(), 4u); // reflectance and alpha of both
    EXPECT_THAT(notes, IsEmpty());
    const std::string three = diffuse(red_text) + diffuse(blue_text) + diffuse(red_text);
    load("<bsdf type='twosided'>" + three + "</bsdf>");
    EXPECT_THAT(notes, ElementsAre("only the first two <bsdf> in 'twosided' are used"));
}

TEST_F(ExporterScene, MergeAddsItsShapes) {
    const std::string merge = "<shape type='merge'><shape type='cube'>" + diffuse(red_text) +
                              "</shape><shape type='rectangle'>" + diffuse(blue_text) + "</shape></shape>";
    const SceneDescription scene = load(merge);
    ASSERT_EQ(scene.shapes.size(), 2u);
    EXPECT_EQ(triangles_of(scene), 14u);
    EXPECT_EQ(reflectance_of(scene.materials.at(static_cast<std::size_t>(scene.shapes[1].material))), blue);
    EXPECT_THAT(notes, IsEmpty());
    const SceneDescription group =
        load("<shape type='shapegroup' id='g'>" + merge + "</shape><shape type='instance'><ref id='g'/></shape>");
    EXPECT_EQ(group.groups.at(0).shapes.size(), 2u);
}

TEST_F(ExporterScene, BackslashesSeparateFolders) {
    std::filesystem::create_directories(folder.path() / "Meshes" / "old");
    folder.write("Meshes/old/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const std::string name : {"Meshes\\old\\a.obj", ".\\meshes\\OLD\\a.obj", "Meshes/old\\a.obj"}) {
        EXPECT_EQ(triangles_of(load("<shape type='obj'><string name='filename' value='" + name + "'/></shape>")),
                  1u);
        EXPECT_THAT(notes, IsEmpty()) << name;
    }
}

} // namespace tessera
