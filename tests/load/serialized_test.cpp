#include "render/load/mitsuba_xml.h"
#include "render/mesh/meshes.h"
#include "tests/load/serialized_bytes.h"
#include "tests/load/temporary_folder.h"

#include <limits>
#include <sstream>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

MeshFile parse(const std::string& bytes, int index = 0) {
    std::istringstream stream(bytes);
    return parse_serialized(stream, index);
}

std::string error_of(const std::string& bytes, int index = 0) {
    try {
        parse(bytes, index);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "no error";
}

std::string one_mesh(const std::string& body) {
    return SerializedBytes(4).mesh(body).file();
}

/// Returns a mesh body of version 4 that ends after these counts.
std::string counts(std::uint64_t vertices, std::uint64_t triangles) {
    std::string body;
    SerializedBytes::append<std::uint32_t>(body, 0x1000);
    body += '\0';
    SerializedBytes::append(body, vertices);
    SerializedBytes::append(body, triangles);
    return body;
}

} // namespace

TEST(Serialized, ReadsBothVersionsAndPrecisions) {
    for (const std::uint16_t version : {3, 4}) {
        const SerializedBytes bytes(version);
        for (const std::string& body : {bytes.square<float>(0xb, 1), bytes.square<double>(0xb, 1)}) {
            const Mesh mesh = parse(SerializedBytes(version).mesh(body).file()).mesh;
            EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
            EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(4, {0, 0, -2}));
            EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
            EXPECT_EQ(mesh.attribute(vertex_color)->values, std::vector<glm::vec3>(4, {1, 0.5f, 0.25f}));
            EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
        }
    }
}

TEST(Serialized, ReadsAnyMeshOfAFile) {
    for (const std::uint16_t version : {3, 4}) {
        SerializedBytes bytes(version);
        bytes.mesh(bytes.square<float>(0, 1)).mesh(bytes.square<double>(0x12, 2)).mesh(bytes.square<float>(1, 3));
        for (int i = 0; i < 3; ++i) {
            const MeshFile one = parse(bytes.file(), i);
            EXPECT_EQ(one.mesh.positions[2], glm::vec3(i + 1, i + 1, 0));
            EXPECT_EQ(one.face_normals, i == 1);
            EXPECT_EQ(one.mesh.uvs.empty(), i != 1);
            EXPECT_EQ(one.mesh.normals.empty(), i != 2);
        }
        EXPECT_EQ(error_of(bytes.file(), 3), "there is no mesh 3, only 3");
    }
}

TEST(Serialized, RejectsEveryTruncation) {
    SerializedBytes bytes(4);
    bytes.mesh(bytes.square<float>(0xb, 1)).mesh(bytes.square<float>(0, 2));
    const std::string whole = bytes.file();
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(error_of(whole.substr(0, length), 1), "no error") << length;
    const std::string single = one_mesh(SerializedBytes(4).square<float>(0xb, 1));
    for (std::size_t length = 0; length + 20 < single.size();
         ++length) // the last 20 bytes, zlib's checksum and the table, are not needed
        EXPECT_NE(error_of(single.substr(0, length)), "no error") << length;
}

TEST(Serialized, SurvivesAnyWrongByte) {
    SerializedBytes bytes(4);
    bytes.mesh(bytes.square<float>(0xb, 1)).mesh(bytes.square<float>(0, 2));
    for (std::size_t i = 0; i < bytes.file().size(); ++i)
        for (const char replacement : {'\0', '\xff', '\x01', '\x7f'}) {
            std::string broken = bytes.file();
            broken[i] = replacement;
            EXPECT_FALSE(error_of(broken, 1).empty()); // must neither crash nor hang
        }
}

TEST(Serialized, ReportsErrors) {
    EXPECT_EQ(error_of(""), "the file ends too early");
    EXPECT_EQ(error_of("this is text"), "this is not a file of serialized meshes");
    EXPECT_EQ(error_of(SerializedBytes(2).mesh("").file()), "version 2 of the format is not known (3 and 4 are)");
    EXPECT_EQ(error_of(std::string("\x1c\x04\x04\x00not zlib at all", 19)), "the compressed data are broken");
    EXPECT_EQ(error_of(one_mesh("")), "the compressed data end too early");
    // No memory is allocated for counts that exceed the file.
    EXPECT_EQ(error_of(one_mesh(counts(1000000000, 0))),
              "the file declares 1000000000 vertices and 0 triangles, but is too short for them");
    EXPECT_EQ(error_of(one_mesh(counts(0, std::numeric_limits<std::uint64_t>::max()))),
              "the file declares 0 vertices and 18446744073709551615 triangles, but is too short for them");
    EXPECT_EQ(error_of(one_mesh(counts(1, 0))), "the compressed data end too early");

    std::string body = SerializedBytes(4).square<float>(0, 1);
    body[body.size() - 4] = 4;
    EXPECT_EQ(error_of(one_mesh(body)), "triangle 1 refers to vertex 4, but there are 4");
    EXPECT_EQ(parse(one_mesh(SerializedBytes(4).square<double>(0, 1e300))).report.errors,
              std::vector<std::string>{"3 positions not finite: 2 triangles left out"});
    EXPECT_EQ(parse(one_mesh(SerializedBytes(4).square<float>(0, std::numeric_limits<double>::quiet_NaN())))
                  .mesh.triangles.size(),
              0u);
}

TEST(Serialized, LoadsInAScene) {
    const TemporaryFolder folder;
    SerializedBytes bytes(4);
    bytes.mesh(bytes.square<float>(0x12, 1)).mesh(bytes.square<double>(8, 2));
    folder.write("m.serialized", bytes.file());
    const auto scene = [&](const std::string& parameters) {
        return folder.write("s.xml", "<scene version='0.6.0'><shape type='serialized'><string name='filename' "
                                     "value='m.serialized'/>" +
                                         parameters + "</shape></scene>");
    };
    const Mesh first = load_mitsuba_xml(scene("")).description.shapes.at(0).mesh;
    EXPECT_TRUE(first.normals.empty()); // the file asks for face normals
    EXPECT_EQ(first.uvs[2], glm::vec2(1, 1));
    const Mesh second = load_mitsuba_xml(scene("<integer name='shapeIndex' value='1'/>"
                                               "<transform name='toWorld'><translate z='5'/></transform>"))
                            .description.shapes.at(0)
                            .mesh;
    EXPECT_EQ(second.positions[2], glm::vec3(2, 2, 5));
    EXPECT_EQ(second.normals, std::vector<glm::vec3>(4, {0, 0, 1})); // computed
    EXPECT_EQ(second.attribute(vertex_color)->values.size(), 4u);
}

} // namespace tessera
