// Flaws of real scene files that the loader tolerates.

#include "render/load/mitsuba_xml.h"
#include "render/scene/scene.h"
#include "tests/load/temporary_folder.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

LoadedScene parse(const std::string& body) {
    return parse_mitsuba_xml("<scene version=\"3.0.0\">" + body + "</scene>", "test.xml");
}

std::string all(const LoadedScene& loaded) {
    std::string result;
    for (const LoadNote& note : loaded.notes)
        result += note.where.to_string() + ": " + note.text + "\n";
    return result;
}

constexpr const char* with_files =
    "<scene version='3.0.0'><shape type='obj'><string name='filename' value='Models/none.obj'/></shape>"
    "<shape type='cube'><bsdf type='diffuse'><texture name='reflectance' type='bitmap'>"
    "<string name='filename' value='none.png'/></texture></bsdf></shape></scene>";

TEST(RealFiles, ReportsMissingFilesAndLoadsTheRest) {
    const TemporaryFolder folder;
    const auto file = folder.write("s.xml", with_files);
    const LoadedScene loaded = load_mitsuba_xml(file);
    ASSERT_EQ(loaded.description.shapes.size(), 2u);
    EXPECT_TRUE(loaded.description.shapes[0].mesh.triangles.empty());
    const auto& diffuse = std::get<DiffuseMaterial>(loaded.description.materials.at(1).kind);
    EXPECT_EQ(diffuse.reflectance.evaluate({}), Rgb(0.5f));
    std::string errors;
    for (const LoadNote& note : loaded.notes)
        errors += note.is_error ? note.text + "\n" : "";
    EXPECT_EQ(errors, "there is no file 'Models/none.obj'; the shape is left out\n"
                      "there is no file 'none.png'; grey is used instead\n");
    EXPECT_NO_THROW(Scene{loaded.description});
    EXPECT_THROW(load_mitsuba_xml(file, {}, serial_for, nullptr, true), LoadError);
}

TEST(RealFiles, FileNamesIgnoreCase) {
    const TemporaryFolder folder;
    const auto file = folder.write("s.xml", with_files);
    folder.write("models/None.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("None.Png", "not a picture");
    folder.write("none.PNG", tga_row("abc"));
    const auto error = [&] {
        try {
            load_mitsuba_xml(file, {}, serial_for, nullptr, true);
        } catch (const LoadError& e) {
            return std::string(e.what());
        }
        return std::string();
    }();
    EXPECT_NE(error.find("cannot load 'none.png'"), std::string::npos)
        << "the file is found, but broken: " << error;
    std::filesystem::remove(folder.path() / "None.Png");
    std::filesystem::remove(folder.path() / "none.PNG");
    EXPECT_EQ(load_mitsuba_xml(file).description.shapes.at(0).mesh.triangles.size(), 1u);
}

TEST(RealFiles, CameraMayLookAlongItsUpVector) {
    for (const char* up : {"0 1 0", "0 -3 1e-7", "0 0 0"}) {
        const LoadedScene loaded = parse(std::string("<sensor type='perspective'><transform name='to_world'>"
                                                     "<lookat origin='0 5 0' target='0 0 0' up='") +
                                         up + "'/></transform></sensor>");
        const glm::mat3 m(loaded.description.camera.to_world);
        EXPECT_NEAR(std::abs(glm::determinant(m)), 1, 1e-5) << up;
        EXPECT_NEAR(m[2].y, -1, 1e-5) << up;
    }
}

TEST(RealFiles, AcceptsAnAreaEmitterThatAShapeRefersTo) {
    const std::string emitter = "<emitter type='area' id='lamp'/>";
    const LoadedScene used = parse(emitter + "<shape type='cube'><ref id='lamp'/></shape>");
    EXPECT_EQ(all(used).find("outside of a shape"), std::string::npos) << all(used);
    EXPECT_EQ(used.description.area_lights.size(), 1u);
    EXPECT_NE(all(parse(emitter)).find("outside of a shape"), std::string::npos);
}

TEST(RealFiles, NullBsdfIsInvisible) {
    const LoadedScene loaded = parse("<shape type='cube'><bsdf type='null'/></shape>");
    EXPECT_EQ(all(loaded).find("null"), std::string::npos) << all(loaded);
    const Scene scene(loaded.description);
    Hit hit;
    for (int i = 0; i < 100; ++i)
        EXPECT_FALSE(
            scene.intersector().closest({{0.01f * static_cast<float>(i) - 0.5f, 0.2f, 5}, {0, 0, -1}}, hit));
    EXPECT_FALSE(scene.intersector().occluded({{0.1f, 0.2f, 5}, {0.1f, 0.2f, -5}}));
}

TEST(RealFiles, ReportsClipPlanesThatCut) {
    const auto camera = [](const std::string& clip) {
        return parse("<sensor type='perspective'>" + clip + "</sensor>");
    };
    EXPECT_EQ(
        all(camera("<float name='near_clip' value='0.01'/><float name='far_clip' value='10000'/>")).find("clip"),
        std::string::npos);
    EXPECT_NE(all(camera("<float name='near_clip' value='4'/>")).find("'near_clip' and 'far_clip' are not used"),
              std::string::npos);
}

} // namespace

} // namespace tessera
