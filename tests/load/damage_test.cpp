// Damage to one mesh, texture or transform is replaced and reported, and the rest of the scene loads. A strict
// load ends.

#include "render/io/plain_images.h"
#include "render/load/mitsuba_xml.h"
#include "tests/load/temporary_folder.h"

#include <string>
#include <variant>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera {

namespace {

using testing::HasSubstr;

class Damage : public testing::Test {
protected:
    LoadedScene load(const std::string& body, bool strict = false) const {
        return load_mitsuba_xml(folder.write("s.xml", "<scene version='0.6.0'>" + body +
                                                          "<shape type='cube'/><sensor type='perspective'/>"
                                                          "</scene>"),
                                {}, serial_for, nullptr, strict);
    }

    /// Loads a scene that has one error, and checks its text, also as the error of a strict load.
    LoadedScene load_damaged(const std::string& body, const std::string& text) const {
        LoadedScene scene = load(body);
        std::vector<std::string> errors;
        for (const LoadNote& note : scene.notes)
            if (note.is_error)
                errors.push_back(note.text);
        EXPECT_THAT(errors, testing::ElementsAre(HasSubstr(text))) << body;
        EXPECT_EQ(scene.description.shapes.back().name, "cube");
        EXPECT_EQ(scene.description.shapes.back().mesh.triangles.size(), 12u);
        try {
            load(body, true);
            ADD_FAILURE() << "a strict load succeeds: " << body;
        } catch (const LoadError& error) {
            EXPECT_THAT(error.what(), HasSubstr(text));
            EXPECT_THAT(error.what(), HasSubstr("^")); // the place in the line
        }
        return scene;
    }

    static std::string shape(const std::string& type, const std::string& inside) {
        return "<shape type='" + type + "'>" + inside + "</shape>";
    }
    static std::string file(const std::string& name) { return "<string name='filename' value='" + name + "'/>"; }
    static std::string textured(const std::string& inside) {
        return shape("rectangle", "<bsdf type='diffuse'><texture name='reflectance' type='bitmap'>" + inside +
                                      "</texture></bsdf>");
    }
    /// Returns a rectangle whose `toWorld` has these steps.
    static std::string placed(const std::string& steps, const std::string& tag = "transform") {
        return shape("rectangle", "<" + tag + " name='toWorld'>" + steps + "</" + tag + ">");
    }

    TemporaryFolder folder;
};

} // namespace

TEST_F(Damage, AMeshThatCannotBeReadIsLeftOut) {
    folder.write("foreign.ply", "not a mesh\n");
    folder.write("index.obj", "v 0 0 0\nf 1 1 2\n");
    folder.write("points.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                               "property float z\nend_header\n0 0 0\n");
    EXPECT_TRUE(load_damaged(shape("ply", file("foreign.ply")), "does not begin with 'ply'; the shape is left out")
                    .description.shapes.at(0)
                    .mesh.triangles.empty());
    load_damaged(shape("obj", file("index.obj")), "refers to position 2");
    load_damaged(shape("ply", file("points.ply")), "'points.ply': there are no triangles in it");
    load_damaged(shape("obj", file("none.obj")), "there is no file 'none.obj'; the shape is left out");
    load_damaged(shape("obj", file(".")), "'.' is not a file; the shape is left out");
    load_damaged(shape("obj", ""), "'obj' needs a 'filename'; the shape is left out");
    load_damaged(shape("torus", ""), "the shape 'torus' is not known; the shape is left out");
    load_damaged(shape("cylinder", "<point name='p0' z='1'/>"), "are the same point; the shape is left out");
}

TEST_F(Damage, ATextureThatCannotBeReadIsGrey) {
    folder.write("a.tif", std::string("II*\0\x8\0\0\0", 8));
    folder.write("a.jpg", "\xff\xd8\xff");
    for (const std::string name : {"a.tif", "a.jpg"}) {
        const LoadedScene scene = load_damaged(textured(file(name)), "grey is used instead");
        const auto& diffuse = std::get<DiffuseMaterial>(scene.description.materials.at(0).kind);
        EXPECT_EQ(diffuse.reflectance.evaluate(glm::vec2(0.3f, 0.6f)), Rgb(0.5f)) << name;
    }
    load_damaged(textured(""), "'bitmap' needs a 'filename'; grey is used instead");
    load_damaged(textured(file("a.tif") + "<string name='channel' value='q'/>"), "'q' is not a channel");
}

TEST_F(Damage, NormalsThatAreNotFiniteAreReplaced) {
    folder.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                          "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                          "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                          "0 0 0 nan nan nan\n1 0 0 -nan(ind) 0 0\n0 1 0 0 0 1\n3 0 1 2\n");
    const LoadedScene scene = load_damaged(shape("ply", file("a.ply")),
                                           "'a.ply': 2 normals without a direction replaced by computed ones");
    for (const glm::vec3 normal : scene.description.shapes.at(0).mesh.normals)
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST_F(Damage, AStepOfATransformIsLeftOut) {
    const auto corner = [](const LoadedScene& scene) {
        return scene.description.shapes.at(0).mesh.positions.at(0);
    };
    const std::string move = "<translate x='5'/>";
    for (const std::string broken : {"<matrix value='1 0 0'/>", "<rotate angle='1'/>", "<twist x='1'/>",
                                     "<lookat origin='1,2,3' target='1,2,3'/>", "<scale value='wide'/>"})
        EXPECT_EQ(corner(load_damaged(placed(broken + move), "this step of the transform is left out")),
                  glm::vec3(4, -1, 0))
            << broken;
    EXPECT_EQ(corner(load_damaged(placed("<scale value='1e30'/><scale value='1e30'/>"),
                                  "the transform's numbers are too large; it is left out")),
              glm::vec3(-1, -1, 0));
    load_damaged(shape("rectangle", "<float name='toWorld' value='1'/>"), "must be of type <transform>");
    load_damaged("<shape type='shapegroup' id='g'><shape type='cube'/></shape><shape type='instance'><ref id='g'/>"
                 "<transform name='toWorld'><scale z='0'/></transform></shape>",
                 "the 'to_world' of an instance must have an inverse; the instance is left out");
}

TEST_F(Damage, AnAnimationIsStillAtItsFirstKey) {
    const LoadedScene scene =
        load_damaged(placed("<transform time='1'><translate x='7'/></transform>"
                            "<transform time='0'><scale value='2'/><translate x='5'/></transform>",
                            "animation"),
                     "animations are not rendered; its first key is used at all times");
    EXPECT_EQ(scene.description.shapes.at(0).mesh.positions.at(0), glm::vec3(3, -2, 0));
    load_damaged(placed("", "animation"), "it has no keys and is left out");
}

TEST_F(Damage, TheListOfMeshesTellsWhatWasRead) {
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\nl 1 2\n");
    folder.write("b.ply", "ply\n");
    const LoadedScene scene = load(shape("obj", file("a.obj")) + shape("ply", file("b.ply")));
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].file, "a.obj");
    EXPECT_THAT(scene.meshes[0].report.contents,
                testing::ElementsAre("3 positions", "1 face", "1 texture coordinate"));
    EXPECT_THAT(scene.meshes[0].report.ignored, testing::ElementsAre("1 line of 'l'"));
    EXPECT_THAT(scene.meshes[1].report.errors, testing::ElementsAre("line 2: the header has no end"));
}

} // namespace tessera
