// Scenes of several files: <include>, <path>, and the search for files.

#include "render/load/mitsuba_xml.h"
#include "tests/load/temporary_folder.h"

#include <gtest/gtest.h>

namespace tessera {

namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::string scene_with(const std::string& body) {
    return "<scene version='3.0.0'>\n" + body + "\n</scene>\n";
}

std::string obj(const std::string& file) {
    return "<shape type='obj'><string name='filename' value='" + file + "'/></shape>";
}

class Include : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder.path() / name).string(); }

    /// Writes a scene with this body to a.xml and loads it.
    LoadedScene load(const std::string& body, const SceneVariables& variables = {}) const {
        return load_mitsuba_xml(folder.write("a.xml", scene_with(body)), variables, serial_for, nullptr, true);
    }

    std::string error_of(const std::string& body) const {
        try {
            load(body);
        } catch (const LoadError& e) {
            return e.what();
        }
        return "no error";
    }

    void expect_error(const std::string& body, const std::string& beginning) const {
        EXPECT_EQ(error_of(body).substr(0, beginning.size()), beginning);
    }

    TemporaryFolder folder;
};

} // namespace

TEST_F(Include, ElementsReplaceTheInclude) {
    folder.write("parts/materials.xml", scene_with("<bsdf type='diffuse' id='wood'/>"));
    folder.write("parts/shape.xml", "<shape type='cube'><include filename='../ref.xml'/></shape>");
    folder.write("ref.xml", "<ref id='wood'/>");
    const LoadedScene loaded = load("<sensor type='perspective'/><include filename='parts/materials.xml'/>"
                                    "<include filename='parts/shape.xml'/><shape type='disk'/>");
    ASSERT_EQ(loaded.description.shapes.size(), 2u);
    EXPECT_EQ(loaded.description.shapes[0].name, "cube");
    EXPECT_EQ(loaded.description.materials[0].name, "wood");
    EXPECT_EQ(loaded.description.shapes[0].material, 0);
}

TEST_F(Include, SharesVariablesInBothDirections) {
    folder.write("settings.xml", scene_with("<default name='depth' value='7'/><default name='w' value='$base'/>"));
    const std::string body = "<default name='base' value='32'/><default name='file' value='settings'/>"
                             "<include filename='$file.xml'/>"
                             "<integrator type='path'><integer name='max_depth' value='$depth'/></integrator>"
                             "<sensor type='perspective'><film type='hdrfilm'>"
                             "<integer name='width' value='$w'/></film></sensor>";
    EXPECT_EQ(load(body).description.max_depth, 7);
    EXPECT_EQ(load(body).description.size.x, 32);
    EXPECT_EQ(load(body, {{"depth", "9"}}).description.max_depth, 9);
}

TEST_F(Include, SearchesTheIncludingFolderThenPathsThenTheSceneFolder) {
    folder.write("near/one.obj", triangle);
    folder.write("one.obj", "nonsense 1\nv x\n"); // broken, and must not be found
    folder.write("far/two.obj", triangle);
    folder.write("three.obj", triangle);
    folder.write("near/b.xml", scene_with("<path value='../far'/>" + obj("one.obj") + obj("two.obj") +
                                          obj("three.obj") + obj("../far/two.obj")));
    EXPECT_EQ(load("<include filename='near/b.xml'/>").description.shapes.size(), 4u);
    expect_error(obj("two.obj"), path("a.xml") + ":2:50: there is no file 'two.obj'");
    expect_error("<path value='nowhere'/>", path("a.xml") + ":2:14: there is no file '" + path("nowhere") + "'");
    expect_error("<path value='three.obj'/>",
                 path("a.xml") + ":2:14: '" + path("three.obj") + "' is not a folder");
}

TEST_F(Include, MessagesNameTheIncludedFile) {
    folder.write("b.xml", "<scene version='3.0.0'>\n\n  <bsdf type='$kind'/></scene>");
    expect_error("<include filename='b.xml'/>",
                 path("b.xml") +
                     ":3:15: the variable '$kind' is not defined (by a <default> before it, or by -D)\n"
                     "      <bsdf type='$kind'/></scene>\n"
                     "                  ^");
    folder.write("b.xml", "<scene version='3.0.0'>\n <bsdf></scene>");
    expect_error("<include filename='b.xml'/>", path("b.xml") + ":2:10: the XML is broken: ");
    folder.write("b.xml", scene_with(obj("none.obj")));
    expect_error("<include filename='b.xml'/>", path("b.xml") + ":2:50: there is no file ");
    folder.write("b.xml", scene_with("<bsdf type='velvet'/>"));
    const LoadedScene loaded = load("<bsdf type='torus'/>\n<include filename='b.xml'/>\n<bsdf type='knot'/>");
    ASSERT_EQ(loaded.notes.size(), 4u); // notes of the including file come first
    EXPECT_EQ(loaded.notes[3].where.to_string(), path("b.xml") + ":2:1");
    EXPECT_EQ(loaded.notes[2].where.line, 4);
}

TEST_F(Include, RejectsCircularIncludes) {
    expect_error("<include filename='a.xml'/>", path("a.xml") + ":2:20: a circle of files: " + path("a.xml") +
                                                    " includes " + path("a.xml") + "\n");
    folder.write("b.xml", scene_with("<include filename='./c.xml'/>"));
    folder.write("c.xml", scene_with("<include filename='b.xml'/>"));
    const std::string message = error_of("<include filename='b.xml'/>");
    EXPECT_NE(message.find("c.xml:2:20: a circle of files: " + path("b.xml") + " includes "), std::string::npos)
        << message;
    EXPECT_NE(message.find("c.xml includes "), std::string::npos) << message;
}

TEST_F(Include, LimitsTheDepthAndNumberOfFiles) {
    for (int i = 0; i < 20; ++i) // each file includes the next one
        folder.write("d" + std::to_string(i) + ".xml",
                     scene_with("<include filename='d" + std::to_string(i + 1) + ".xml'/>"));
    expect_error("<include filename='d0.xml'/>",
                 path("d14.xml") + ":2:20: files include each other more than 15 deep");
    folder.write("e0.xml", scene_with(""));
    for (int i = 1; i < 15; ++i) { // up to 4^14 files are included
        std::string four;
        for (int j = 0; j < 4; ++j)
            four += "<include filename='e" + std::to_string(i - 1) + ".xml'/>";
        folder.write("e" + std::to_string(i) + ".xml", scene_with(four));
    }
    EXPECT_NE(error_of("<include filename='e14.xml'/>").find("more than 10000 included files"), std::string::npos);
}

TEST_F(Include, RejectsBadFileNames) {
    expect_error("<include/>", path("a.xml") + ":2:1: <include> needs the attribute 'filename'");
    expect_error("<include filename=''/>", path("a.xml") + ":2:20: '' is not a file name");
    expect_error("<include filename='none.xml'/>",
                 path("a.xml") + ":2:20: there is no file '" + path("none.xml") + "'");
    expect_error("<include filename='.'/>", path("a.xml") + ":2:20: '" + path(".") + "' is not a file");
    try {
        parse_mitsuba_xml(scene_with("<include filename='b.xml'/>"), "m.xml");
        FAIL();
    } catch (const LoadError& e) {
        EXPECT_NE(
            std::string(e.what()).find("m.xml:2:20: a scene in memory has no files beside it, such as 'b.xml'"),
            std::string::npos);
    }
}

/// The version of the scene decides what an element means, not the version of the included file.
TEST_F(Include, IncludedFilesTakeTheVersionOfTheScene) {
    const std::string shape = "<shape type='rectangle'><transform name='to_world'><rotate y='2' angle='90'/>"
                              "</transform></shape>";
    folder.write("b.xml", scene_with(shape));
    folder.write("c.xml", "<scene>" + shape + "<include filename='b.xml'/></scene>");
    const std::string old =
        "<scene version='0.6.0'><sensor type='perspective'/><include filename='c.xml'/>" + shape + "</scene>";
    const LoadedScene loaded = load_mitsuba_xml(folder.write("old.xml", old), {}, serial_for, nullptr, true);
    ASSERT_EQ(loaded.description.shapes.size(), 3u);
    for (const Shape& s : loaded.description.shapes)
        EXPECT_EQ(s.mesh.positions,
                  loaded.description.shapes.back().mesh.positions); // the rotation does not stretch
}

TEST_F(Include, ReportsAnIncludedFileOfAnotherVersion) {
    folder.write("b.xml", "<scene version='0.6.0'><bsdf type='diffuse'/></scene>");
    const LoadedScene loaded = load("<sensor type='perspective'/><include filename='b.xml'/>");
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_EQ(loaded.notes[0].text, "the version of the including file is used, '3.0.0'");
}

} // namespace tessera
