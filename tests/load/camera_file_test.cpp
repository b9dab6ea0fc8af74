#include "render/io/text.h"
#include "render/load/mitsuba_xml.h"
#include "render/scene/camera.h"
#include "tests/load/temporary_folder.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include <glm/ext/matrix_transform.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

struct Broken {
    const char* name;
    const char* json;
    const char* message; // expected after "c.json"
};

constexpr const char* matrix = "1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1";

// M is replaced by the identity matrix.
constexpr Broken broken_cameras[] = {
    {"empty", "", ":1:1: the file is empty"},
    {"not closed", "{\n  \"fov\": 40,\n", ":3:1: the JSON is broken: unexpected end of input"},
    {"no comma", "{\n  \"fov\": 40\n  \"to_world\": [M]}", ":3:12: the JSON is broken: unexpected string literal"},
    {"NaN", "{\"fov\": NaN}", ":1:9: the JSON is broken: invalid literal"},
    {"text after the object", "{\"fov\": 40, \"to_world\": [M]} x", "the JSON is broken: invalid literal"},
    {"a list", "[1, 2]", ":1:1: a camera file holds one object {...}, not array"},
    {"empty object", "{}", ":1:1: the camera has no 'to_world'"},
    {"no fov", "{\"to_world\": [M]}", ":1:1: the camera has no 'fov'"},
    {"no matrix", "{\"fov\": 40}", ":1:1: the camera has no 'to_world'"},
    {"unknown field", "{\"fov\": 40,\n \"tow_orld\": [M]}", ":2:14: unknown camera field 'tow_orld'"},
    {"a number for a matrix", "{\"to_world\": 1, \"fov\": 40}",
     ":1:14: 'to_world' must be a list of 16 numbers, not number"},
    {"short matrix", "{\"to_world\": [1, 0, 0], \"fov\": 40}", ":1:14: 'to_world' must have 16 numbers, not 3"},
    {"nested matrix", "{\"to_world\": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], \"fov\": 40}",
     ":1:14: 'to_world' must have 16 numbers, not 4"},
    {"words in a matrix", "{\"to_world\": [\"1\",0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], \"fov\": 40}",
     ":1:14: 'to_world' must be numeric, not string"},
    {"null in a matrix", "{\"to_world\": [null,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], \"fov\": 40}",
     ":1:14: 'to_world' must be numeric, not null"},
    {"beyond floats", "{\"to_world\": [1e39,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], \"fov\": 40}",
     ":1:14: 'to_world' has a number that is too large"},
    {"beyond doubles", "{\"to_world\": [M],\n \"fov\": 1e999}", ":2:9: the number 1e999 is too large"},
    {"matrix by columns", "{\"to_world\": [1,0,0,0, 0,1,0,0, 0,0,1,0, 3,4,5,1], \"fov\": 40}",
     ":1:14: the last four numbers of 'to_world' must be 0, 0, 0, 1 (the matrix is row by row)"},
    {"singular", "{\"to_world\": [1,2,3,0, 2,4,6,0, 0,0,1,0, 0,0,0,1], \"fov\": 40}",
     ":1:14: the camera's transform is flat"},
    {"nearly singular", "{\"to_world\": [0.1,0.2,0.3,0, 0.3,0.6,0.9,0, 0,0,1,0, 0,0,0,1], \"fov\": 40}",
     ":1:14: the camera's transform is flat"},
    {"all zero", "{\"to_world\": [0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,1], \"fov\": 40}",
     ":1:14: the camera's transform is flat"},
    {"no angle", "{\"to_world\": [M],\n \"fov\": 0}", ":2:9: the field of view must be between 0 and 180 degrees"},
    {"too wide", "{\"to_world\": [M],\n \"fov\": 180}",
     ":2:9: the field of view must be between 0 and 180 degrees"},
    {"fov in words", "{\"to_world\": [M], \"fov\": \"40\"}", "'fov' must be numeric, not string"},
    {"unknown axis", "{\"to_world\": [M], \"fov\": 40,\n\"fov_axis\": \"z\"}",
     ":2:13: 'fov_axis' must be \"x\", \"y\""},
    {"field name as a value before the field", "{\"up\": \"fov\", \"to_world\": [M],\n \"fov\": 0}",
     ":2:9: the field of view must be between 0 and 180 degrees"},
    {"orthographic in words", "{\"to_world\": [M],\n\"orthographic\": \"yes\"}",
     ":2:17: 'orthographic' must be true or false"},
    {"half an offset", "{\"to_world\": [M], \"fov\": 40,\n\"principal_point_offset\": [1]}",
     ":2:27: 'principal_point_offset' must be 2 numbers"},
    {"offset in words", "{\"to_world\": [M], \"fov\": 40,\n\"principal_point_offset\": [1, \"2\"]}",
     ":2:27: 'principal_point_offset' must be numeric, not string"},
    {"negative aperture", "{\"to_world\": [M], \"fov\": 40,\n\"aperture_radius\": -1, \"focus_distance\": 1}",
     ":2:20: 'aperture_radius' must not be negative"},
    {"lens without focus", "{\"to_world\": [M], \"fov\": 40, \"aperture_radius\": 1}",
     ":1:1: the camera has no 'focus_distance'"},
    {"focus on the lens", "{\"to_world\": [M], \"fov\": 40, \"aperture_radius\": 1,\n\"focus_distance\": 0}",
     ":2:19: 'focus_distance' must be above 0"},
    {"axis that is a number", "{\"to_world\": [M], \"fov\": 40,\n\"fov_axis\": 1}", ":2:13: 'fov_axis' must be"},
};

TEST(CameraFile, ErrorsNameTheirLineAndColumn) {
    for (const Broken& b : broken_cameras) {
        std::string json = b.json;
        if (const std::size_t m = json.find('M'); m != std::string::npos)
            json.replace(m, 1, matrix);
        try {
            parse_camera(json, "c.json");
            ADD_FAILURE() << b.name << ": was read";
        } catch (const LoadError& e) {
            EXPECT_NE(std::string(e.what()).find(b.message), std::string::npos) << b.name << ": " << e.what();
            EXPECT_EQ(std::string(e.what()).rfind("c.json:", 0), 0u) << b.name << ": " << e.what();
        }
    }
}

TEST(CameraFile, MessagesShowTheLineWithACaret) {
    try {
        parse_camera("{\n  \"fov\": 40,,\n}", "c.json");
        FAIL();
    } catch (const LoadError& e) {
        EXPECT_NE(std::string(e.what()).find("\n      \"fov\": 40,,\n                ^"), std::string::npos)
            << e.what();
    }
}

TEST(CameraFile, RejectsMissingFilesAndFolders) {
    const TemporaryFolder folder;
    EXPECT_THROW(read_camera(folder.path()), LoadError);
    EXPECT_THROW(read_camera(folder.path() / "none.json"), LoadError);
}

Camera random_camera(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(-1, 1);
    const auto vector = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
    Camera camera;
    camera.to_world = glm::translate(glm::mat4(1), 100.0f * vector());
    camera.to_world = glm::rotate(camera.to_world, 3 * unit(random), vector());
    camera.to_world = glm::scale(camera.to_world, {-1, 1, 1}); // mirrored, as many exporters write cameras
    camera.fov = 90 + 80 * unit(random);
    camera.fov_axis = static_cast<FovAxis>(random() % 5);
    if (random() % 2)
        camera.principal_offset = {unit(random), unit(random)};
    return camera;
}

/// Returns a camera that has a lens with probability 1/3, and is orthographic with probability 1/3. An
/// orthographic camera has the default field of view, because files do not store it.
Camera random_camera_of_any_kind(std::mt19937& random) {
    std::uniform_real_distribution<float> above(0.01f, 10);
    Camera camera = random_camera(random);
    if (random() % 3 == 0) {
        camera.aperture_radius = above(random);
        camera.focus_distance = above(random);
    }
    if (random() % 3 == 0) {
        camera.is_orthographic = true;
        camera.fov = Camera().fov;
        camera.fov_axis = Camera().fov_axis;
    }
    return camera;
}

bool same_bits(const Camera& a, const Camera& b) {
    for (int i = 0; i < 16; ++i)
        if (std::bit_cast<std::uint32_t>(a.to_world[i / 4][i % 4]) !=
            std::bit_cast<std::uint32_t>(b.to_world[i / 4][i % 4]))
            return false;
    return std::bit_cast<std::uint32_t>(a.fov) == std::bit_cast<std::uint32_t>(b.fov) && a == b;
}

TEST(CameraFile, RoundTripIsBitExact) {
    const TemporaryFolder folder;
    std::mt19937 random(7);
    for (int i = 0; i < 1000; ++i) {
        Camera camera = random_camera_of_any_kind(random);
        camera.to_world[3].x = i == 0 ? -0.0f : camera.to_world[3].x;
        camera.to_world[3].y = i == 1 ? 1e-42f : camera.to_world[3].y;
        camera.to_world[3].z = i == 2 ? 16777216.0f : camera.to_world[3].z;
        EXPECT_TRUE(same_bits(parse_camera(camera_json(camera), "c.json"), camera)) << camera_json(camera);
    }
    const Camera camera = random_camera(random);
    write_camera(folder.path() / "c.json", camera);
    EXPECT_TRUE(same_bits(read_camera(folder.path() / "c.json"), camera));
    int files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path()))
        ++files;
    EXPECT_EQ(files, 1) << "a temporary file is left";
    EXPECT_THROW(write_camera(folder.path() / "no/such/folder/c.json", camera), std::exception);
}

TEST(CameraFile, FovAxisDefaultsToX) {
    std::string json = R"({"fov": 40, "to_world": [M]})";
    json.replace(json.find('M'), 1, matrix);
    EXPECT_EQ(parse_camera(json, "c.json").fov_axis, FovAxis::x);
}

/// Returns the sensor type that the comment in the text names, or perspective.
std::string sensor_type(const std::string& xml) {
    const std::string words = "<!-- for a sensor of type ";
    if (xml.rfind(words, 0) != 0)
        return "perspective";
    return xml.substr(words.size(), xml.find(" -->") - words.size());
}

TEST(CameraFile, XmlRoundTripGivesTheSameCamera) {
    std::mt19937 random(11);
    for (int i = 0; i < 100; ++i) {
        Camera camera = random_camera_of_any_kind(random);
        if (camera.is_orthographic || camera.aperture_radius > 0)
            camera.principal_offset = glm::vec2(0); // no Mitsuba sensor has both
        const std::string inside = camera_xml(camera);
        const std::string xml =
            "<scene version='3.0.0'><sensor type='" + sensor_type(inside) + "'>" + inside + "</sensor></scene>";
        const LoadedScene loaded = parse_mitsuba_xml(xml, "s.xml");
        EXPECT_TRUE(loaded.notes.empty());
        const Camera& read = loaded.description.camera;
        EXPECT_EQ(read.fov_axis, camera.fov_axis);
        EXPECT_NEAR(read.fov, camera.fov, 1e-6f * camera.fov);
        EXPECT_EQ(read.is_orthographic, camera.is_orthographic);
        EXPECT_EQ(read.principal_offset, camera.principal_offset);
        EXPECT_EQ(read.aperture_radius, camera.aperture_radius);
        EXPECT_EQ(read.focus_distance, camera.focus_distance);
        for (int j = 0; j < 16; ++j) {
            const float expected = camera.to_world[j / 4][j % 4];
            EXPECT_NEAR(read.to_world[j / 4][j % 4], expected, 1e-6f * (1 + std::abs(expected)));
        }
    }
}

TEST(CameraFile, KeepsCropWindowAndFilter) {
    Camera camera;
    camera.crop = {{96, 64}, {30, 10}, {40, 36}};
    camera.filter = gaussian_filter(0.7f);
    EXPECT_TRUE(parse_camera(camera_json(camera), "c.json") == camera);
    EXPECT_EQ(camera_json(Camera{}).find("crop"), std::string::npos);
    const std::string start = "{\"fov\": 40, \"to_world\": [" + std::string(matrix) + "],\n";
    for (const char* bad : {"\"crop\": [96, 64, 60, 10, 40, 36]}", "\"crop\": [96, 64, 0, 0, 40.5, 36]}",
                            "\"crop\": [1e30, 64, 0, 0, 40, 36]}", "\"crop\": [96, 64]}", "\"crop\": 1}",
                            "\"filter\": [\"gaussian\", 2, -1, 0]}", "\"filter\": [\"scene\", 1, 0, 0]}"})
        EXPECT_THROW(parse_camera(start + bad, "c.json"), LoadError) << bad;
}

} // namespace

} // namespace tessera
