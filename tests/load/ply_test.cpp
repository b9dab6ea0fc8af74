#include "render/mesh/meshes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera {

namespace {

const std::string properties = "property float x\nproperty float y\nproperty double z\nproperty uchar quality\n"
                               "property list uchar short neighbours\n"
                               "property float nx\nproperty float ny\nproperty float nz\n"
                               "property float s\nproperty float t\n";

std::string header(const std::string& format, const std::string& index_types) {
    return "ply\r\nformat " + format + " 1.0\ncomment made by hand\nobj_info none\nelement camera 1\n" +
           "property int width\nelement vertex 4\n" + properties + "element face 2\nproperty list " + index_types +
           " vertex_indices\nproperty float area\nelement edge 1\nproperty int a\nend_header\n";
}

/// Appends values to a string, in either byte order.
class Bytes {
public:
    explicit Bytes(bool big_endian) : big_endian_(big_endian) {}

    template <class T>
    Bytes& add(T value) {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        if (big_endian_)
            std::reverse(raw, raw + sizeof(T));
        bytes_.append(raw, sizeof(T));
        return *this;
    }
    const std::string& string() const { return bytes_; }

private:
    bool big_endian_;
    std::string bytes_;
};

template <class Count, class Index>
std::string binary_square(bool big_endian, const std::string& types) {
    Bytes b(big_endian);
    b.add<std::int32_t>(640);
    for (int i = 0; i < 4; ++i) {
        const float x = i == 1 || i == 2;
        const float y = i >= 2;
        b.add(x).add(y).add(0.5).add<std::uint8_t>(7).add<std::uint8_t>(2).add<std::int16_t>(1).add<std::int16_t>(
            2);
        b.add(0.0f).add(0.0f).add(1.0f).add(x).add(y);
    }
    b.add<Count>(4);
    for (int i = 0; i < 4; ++i)
        b.add(static_cast<Index>(i));
    b.add(1.0f);
    b.add<Count>(2)
        .add(static_cast<Index>(0))
        .add(static_cast<Index>(1))
        .add(0.0f); // a face of two corners, which gives no triangle
    b.add<std::int32_t>(5);
    return header(big_endian ? "binary_big_endian" : "binary_little_endian", types) + b.string();
}

const std::string ascii_square = header("ascii", "uint8 int32") + "640\n"
                                                                  "0 0 0.5 7 2 1 2 0 0 1 0 0\n"
                                                                  "1 0 5e-1 7 0 0 0 1 1 0\r\n"
                                                                  "+1 1 .5 7 1 3 0 0 1 1 1\n"
                                                                  "0 1 0.5 7 0 0 0 1 0 1\n"
                                                                  "4 0 1 2 3 1.0\n"
                                                                  "2 0 1 0\n"
                                                                  "5";

void expect_square(const Mesh& mesh) {
    EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0.5f}, {1, 0, 0.5f}, {1, 1, 0.5f}, {0, 1, 0.5f}}));
    EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(4, {0, 0, 1}));
    EXPECT_EQ(mesh.uvs, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
}

Mesh mesh_of(const std::string& bytes) {
    return parse_ply(bytes).mesh;
}

std::string error_of(const std::string& bytes) {
    try {
        parse_ply(bytes);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "no error";
}

/// Returns an ASCII PLY file with these vertices and faces.
std::string ascii_ply(const std::string& vertices, const std::string& faces, int vertex_count = 3,
                      int face_count = 1) {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertex_count) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(face_count) +
           "\nproperty list int int vertex_index\nend_header\n" + vertices + faces;
}

const std::string three = "0 0 0\n1 0 0\n0 1 0\n";

} // namespace

TEST(Ply, ReadsAllFormatsAndTypes) {
    expect_square(mesh_of(ascii_square));
    for (const bool big_endian : {false, true}) {
        expect_square(mesh_of(binary_square<std::uint8_t, std::int32_t>(big_endian, "uchar int")));
        expect_square(mesh_of(binary_square<std::uint8_t, std::uint32_t>(big_endian, "uint8 uint")));
        expect_square(mesh_of(binary_square<std::int8_t, std::uint8_t>(big_endian, "int8 uchar")));
        expect_square(mesh_of(binary_square<std::uint16_t, std::int16_t>(big_endian, "ushort short")));
        expect_square(mesh_of(binary_square<std::int32_t, std::uint16_t>(big_endian, "int uint16")));
    }
}

TEST(Ply, FacesMayPrecedeVertices) {
    const Mesh mesh =
        mesh_of("ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_index\n"
                "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
                "3 2 1 0\n" +
                three);
    EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{2, 1, 0}}));
    EXPECT_TRUE(mesh.normals.empty());
    EXPECT_TRUE(mesh.uvs.empty());
}

TEST(Ply, AttributesHaveMitsubasNames) {
    const auto mesh =
        mesh_of("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                "property float z\nproperty float foo_1\nproperty float foo_2\nproperty float foo_3\n"
                "property float rough_0\nproperty float pair_0\nproperty float pair_1\n"
                "property float quality\nproperty float tint_g\nproperty float tint_r\n"
                "property float tint_b\nelement face 2\nproperty uchar red\n"
                "property list int int vertex_index\nproperty uchar green\nproperty uchar blue\n"
                "end_header\n"
                "0 0 0 1 2 3 0.5 0 0 9 7 6 8\n1 0 0 4 5 6 0.25 0 0 9 7 6 8\n"
                "1 1 0 1 2 3 1 0 0 9 7 6 8\n0 1 0 1 2 3 1 0 0 9 7 6 8\n"
                "255 4 0 1 2 3 0 255\n0 3 0 1 2 255 0\n");
    ASSERT_EQ(mesh.attributes.size(), 4u);
    EXPECT_EQ(mesh.attribute("vertex_foo")->values.at(1), glm::vec3(4, 5, 6));
    EXPECT_EQ(mesh.attribute("vertex_rough")->values.at(1), glm::vec3(0.25f));
    EXPECT_EQ(mesh.attribute("vertex_tint_color")->values.at(3), glm::vec3(6, 7, 8));
    const std::vector<glm::vec3> faces = {{1, 0, 1}, {1, 0, 1}, {0, 1, 0}}; // the first face is two triangles
    EXPECT_EQ(mesh.attribute("face_color")->values, faces);
    EXPECT_FALSE(mesh.attribute("vertex_pair"));
    EXPECT_FALSE(mesh.attribute("vertex_quality"));
}

TEST(Ply, RejectsEveryTruncation) {
    for (const std::string& whole : {ascii_square, binary_square<std::uint8_t, std::int32_t>(false, "uchar int"),
                                     binary_square<std::uint8_t, std::int32_t>(true, "uchar int")}) {
        for (std::size_t length = 0; length < whole.size(); ++length) {
            const std::string message = error_of(whole.substr(0, length));
            // The last byte belongs to the unused element 'edge', so its loss may go unnoticed.
            if (length + 1 < whole.size()) {
                EXPECT_NE(message, "no error") << length;
            }
        }
    }
}

TEST(Ply, SurvivesAnyWrongByte) {
    for (const std::string& whole :
         {ascii_square, binary_square<std::uint8_t, std::int32_t>(false, "uchar int")}) {
        for (std::size_t i = 0; i < whole.size(); ++i)
            for (const char replacement : {'\0', '\xff', '9', ' ', '\n', '-', '\x7f'}) {
                std::string broken = whole;
                broken[i] = replacement;
                const std::string message = error_of(broken); // must neither crash nor hang
                EXPECT_FALSE(message.empty());
            }
    }
}

TEST(Ply, ReportsErrors) {
    EXPECT_EQ(error_of(ascii_ply(three, "3 0 1 2\n")), "no error");
    EXPECT_EQ(error_of(ascii_ply(three, "3 0 1 3\n")), "a face refers to vertex 3, but there are 3");
    EXPECT_EQ(error_of(ascii_ply(three, "3 0 1 -1\n")), "face 0: -1.000000 is not a vertex index");
    EXPECT_EQ(error_of(ascii_ply(three, "3 0 1 1.5\n")), "face 0: 1.500000 is not a vertex index");
    EXPECT_EQ(error_of(ascii_ply(three, "-3 0 1 1\n")), "face 0: a list cannot have the length -3.000000");
    EXPECT_EQ(error_of(ascii_ply(three, "3 0 1")), "face 0: the file ends too early");
    EXPECT_EQ(error_of(ascii_ply("0 0 0\n1 0 1e-400\n0 1 0\n", "3 0 1 2\n")), "no error");
    EXPECT_EQ(error_of(ascii_ply("0 0 zero\n1 0 0\n0 1 0\n", "3 0 1 2\n")), "vertex 0: 'zero' is not a number");
    EXPECT_EQ(error_of(ascii_ply(three, "3 0 1 2\n", 3, 1000000000)),
              "the header declares 1000000000 rows of 'face', but the file ends too early for them");
    EXPECT_EQ(error_of("ply\nformat ascii 2.0\nend_header\n"),
              "line 2: the format must be 'ascii', 'binary_little_endian' or 'binary_big_endian', version 1.0");
    EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement vertex -1\nend_header\n"), "line 3: '-1' is not a count");
    EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty text x\nend_header\n"),
              "line 4: the type 'text' is not known");
    EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"),
              "vertex 0: x, y or z is missing");
    EXPECT_EQ(error_of("ply\nend_header\n"), "line 2: the header names no format");
    EXPECT_EQ(error_of("ply\nformat ascii 1.0\n"), "line 3: the header has no end");
    EXPECT_EQ(error_of(""), "line 1: the header has no end");
    // Elements without properties take no time, whatever their number.
    EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement void 99999999999999999\nend_header\n"), "no error");
}

} // namespace tessera
