// Mesh and image files that are truncated, declare a false size, or hold invalid data.

#include "render/io/exr.h"
#include "render/io/files.h"
#include "render/io/memory.h"
#include "render/io/plain_images.h"
#include "render/load/mitsuba_xml.h"
#include "render/load/plugins.h"
#include "tests/load/serialized_bytes.h"
#include "tests/load/temporary_folder.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera {

namespace {

constexpr const char* formats[] = {"obj", "ply", "serialized"};

class BrokenFile : public testing::Test {
protected:
    /// Returns the error message of a scene with a shape of this type and file, or "no error".
    std::string error_of_shape(const std::string& type, const std::string& file) const {
        return error_of("<shape type='" + type + "'><string name='filename' value='" + file + "'/></shape>");
    }

    std::string error_of_texture(const std::string& file) const {
        return error_of("<bsdf type='diffuse'><texture name='reflectance' type='bitmap'>"
                        "<string name='filename' value='" +
                        file + "'/></texture></bsdf>");
    }

    std::string error_of(const std::string& body) const {
        try {
            load_mitsuba_xml(folder.write("s.xml", "<scene version='3.0.0'>" + body + "</scene>"), {}, serial_for,
                             nullptr, true);
        } catch (const LoadError& e) {
            return e.what();
        }
        return "no error";
    }

    void write_prefix(const std::string& name, const std::string& bytes, std::size_t length) const {
        folder.write(name, std::string_view(bytes).substr(0, length));
    }

    Mesh mesh_of(const std::string& type, const std::string& file) const {
        return load_mitsuba_xml(folder.write("s.xml", "<scene version='3.0.0'><shape type='" + type +
                                                          "'><string name='filename' value='" + file +
                                                          "'/></shape></scene>"))
            .description.shapes.at(0)
            .mesh;
    }

    TemporaryFolder folder;
};

std::string ply(const std::string& vertices, int vertex_count, const std::string& faces, int face_count) {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertex_count) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(face_count) +
           "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces;
}

/// Returns the header of a PNG of this size, without pixels.
std::string png_header(std::uint32_t width, std::uint32_t height) {
    std::string header("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
    const auto append = [&](std::uint32_t number) {
        for (int shift = 24; shift >= 0; shift -= 8)
            header += static_cast<char>(number >> shift & 0xff);
    };
    append(width);
    append(height);
    header += std::string("\x08\x02\0\0\0", 5);
    append(checksum(std::as_bytes(std::span(header)).subspan(12))); // CRC of the chunk's type and data
    return header + std::string("\0\0\0\0IDAT\0\0\0\0", 12);
}

/// Returns the header of an OpenEXR file with a data window of this size, in pixels.
std::string exr_header(std::int32_t width, std::int32_t height) {
    std::string bytes("\x76\x2f\x31\x01\x02\0\0\0", 8);
    const auto attribute = [&](const std::string& name, const std::string& type, const std::string& value) {
        bytes += name + '\0' + type + '\0';
        SerializedBytes::append(bytes, static_cast<std::int32_t>(value.size()));
        bytes += value;
    };
    std::string channels;
    for (const char* name : {"B", "G", "R"}) {
        channels += std::string(name) + '\0';
        for (const std::int32_t number : {2, 0, 1, 1}) // type float, pLinear 0, x and y sampling 1
            SerializedBytes::append(channels, number);
    }
    std::string window;
    for (const std::int32_t number : {0, 0, width - 1, height - 1})
        SerializedBytes::append(window, number);
    std::string unit;
    SerializedBytes::append(unit, 1.0f);
    attribute("channels", "chlist", channels + '\0');
    attribute("compression", "compression", std::string(1, '\0'));
    attribute("dataWindow", "box2i", window);
    attribute("displayWindow", "box2i", window);
    attribute("lineOrder", "lineOrder", std::string(1, '\0'));
    attribute("pixelAspectRatio", "float", unit);
    attribute("screenWindowCenter", "v2f", std::string(8, '\0'));
    attribute("screenWindowWidth", "float", unit);
    return bytes + '\0';
}

} // namespace

TEST_F(BrokenFile, RejectsEmptyAndForeignFiles) {
    folder.write("empty", "");
    folder.write("foreign", "GIF87 or another\nformat\n");
    EXPECT_NE(error_of_shape("ply", "empty").find("cannot load 'empty': line 1"), std::string::npos);
    EXPECT_NE(error_of_shape("serialized", "empty").find("the file ends too early"), std::string::npos);
    EXPECT_NE(error_of_shape("ply", "foreign").find("does not begin with 'ply'"), std::string::npos);
    EXPECT_NE(error_of_shape("serialized", "foreign").find("not a file of serialized"), std::string::npos);
    EXPECT_NE(error_of_texture("empty").find("it is not an OpenEXR"), std::string::npos);
    EXPECT_NE(error_of_texture("foreign").find("it is not an OpenEXR"), std::string::npos);
    // OBJ files have no signature, and unknown keywords are allowed.
    EXPECT_THAT(error_of_shape("obj", "empty"), testing::HasSubstr("there are no triangles in it"));
}

TEST_F(BrokenFile, RejectsTruncatedImages) {
    RgbImage image(16, 16, Rgb(0.25f));
    image(3, 3) = Rgb(1, 0, 0.5f);
    write_png(folder.path() / "whole.png", image);
    write_exr(folder.path() / "whole.exr", {{{"", image}}, {}});
    for (const std::string extension : {".png", ".exr"}) {
        const std::string whole = read_bytes(folder.path() / ("whole" + extension));
        EXPECT_EQ(error_of_texture("whole" + extension), "no error");
        for (const std::size_t length : {std::size_t{0}, std::size_t{4}, std::size_t{20}, whole.size() / 4,
                                         whole.size() / 2, whole.size() - 20}) {
            write_prefix("part" + extension, whole, length);
            EXPECT_NE(error_of_texture("part" + extension).find("cannot load 'part" + extension),
                      std::string::npos)
                << extension << " " << length;
        }
    }
}

/// Cameras and old programs write superfluous bytes between JPEG segments.
TEST_F(BrokenFile, AcceptsSuperfluousBytesInAJpegAndRejectsATruncatedOne) {
    const std::string whole =
        read_bytes(std::filesystem::path(TESSERA_SOURCE_DIR) / "tests/fuzz/seeds/picture/square.jpg");
    const std::size_t end = whole.rfind("\xff\xd9");
    ASSERT_NE(end, std::string::npos);
    folder.write("more.jpg", whole.substr(0, end) + std::string(5, '\0') + whole.substr(end));
    EXPECT_EQ(error_of_texture("more.jpg"), "no error");
    folder.write("less.jpg", whole.substr(0, end - 8));
    EXPECT_THAT(error_of_texture("less.jpg"), testing::HasSubstr("cannot load 'less.jpg'"));
}

TEST_F(BrokenFile, DetectsTheImageFormatFromTheContents) {
    const RgbImage image(9, 2, Rgb(0.5f, 1, 0.25f));
    write_exr(folder.path() / "exr.png", {{{"", image}}, {}});
    write_png(folder.path() / "png.exr", image, 0);
    for (const char* name : {"exr.png", "png.exr"})
        EXPECT_EQ(error_of_texture(name), "no error") << name;
    const std::string softimage = std::string("\x53\x80\xf6\x34", 4) + std::string(84, '\0') + "PICT" +
                                  std::string("\0\1\0\1\0\0\0\0\0\0\0\0", 12) + std::string(16, '\7');
    for (const char* name : {"a.pic", "a.png", "a.hdr"}) {
        folder.write(name, softimage);
        EXPECT_THAT(error_of_texture(name),
                    testing::HasSubstr("it is not an OpenEXR, Radiance, PFM, PNG, JPEG, BMP or TGA"));
    }
}

TEST_F(BrokenFile, RejectsRadianceRunsThatDoNotFitTheRow) {
    const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 16\n" + std::string("\2\2\0\20", 4);
    const std::string row = "\x90\x80\x90\x40\x90\x20\x90\x81"; // each channel as a run of 16 bytes
    folder.write("fine.hdr", head + row);
    EXPECT_EQ(error_of_texture("fine.hdr"), "no error");
    EXPECT_EQ(read_bitmap(folder.path() / "fine.hdr", true, [] { return true; }).bitmap.floats.at(15),
              Rgb(1, 0.5f, 0.25f));
    for (const std::string& broken : {head + std::string("\0", 1), head + "\x91" + row, head + row.substr(0, 5),
                                      head.substr(0, 40), std::string("#?RADIANCE\n\n-Y 1 +X 1\nabcd")}) {
        folder.write("broken.hdr", broken);
        EXPECT_THAT(error_of_texture("broken.hdr"), testing::HasSubstr("cannot load 'broken.hdr'"));
    }
}

TEST_F(BrokenFile, ReadingAnImageStopsWhenCancelled) {
    const RgbImage image(64, 64, Rgb(0.5f));
    write_exr(folder.path() / "a.exr", {{{"", image}}, {}});
    write_png(folder.path() / "a.png", image, 0);
    folder.write("a.hdr", "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\nabcd");
    for (const char* name : {"a.exr", "a.png", "a.hdr"})
        EXPECT_THROW(read_bitmap(folder.path() / name, true, [] { return false; }), std::exception) << name;
}

TEST_F(BrokenFile, RejectsImagesOfImpossibleSize) {
    const auto expect = [&](const char* file, const std::string& bytes, const std::string& message) {
        folder.write(file, bytes);
        EXPECT_NE(error_of_texture(file).find(message), std::string::npos) << error_of_texture(file);
    };
    expect("a.png", png_header(1000000, 1000000), "cannot load 'a.png': the picture cannot be read");
    expect("b.png", png_header(17000, 17000), "an image of 17000 by 17000 pixels is too large");
    expect("c.png", png_header(16000, 16000), "the file is too short for 16000 by 16000 pixels");
    expect("a.exr", exr_header(1000000, 1000000), "cannot load 'a.exr'");
    const std::string offsets(std::size_t{8} * 20000, '\0'); // table of row offsets
    expect("b.exr", exr_header(20000, 20000) + offsets, "an image of 20000 by 20000 pixels is too large");
    expect("c.exr", exr_header(100000000, 2) + std::string(16, '\0'),
           "an image of 100000000 by 2 pixels is too large");
    expect("d.exr", exr_header(0, 5), "cannot load 'd.exr'");
}

TEST_F(BrokenFile, RejectsFalseCountsInAPly) {
    const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
    folder.write("faces.ply", ply(three, 3, "3 0 1 2\n", 1000000000));
    EXPECT_NE(error_of_shape("ply", "faces.ply").find("the header declares 1000000000 rows of 'face'"),
              std::string::npos);
    folder.write("vertices.ply", ply(three, 1000000000, "3 0 1 2\n", 1));
    EXPECT_NE(error_of_shape("ply", "vertices.ply").find("the header declares 1000000000 rows of 'vertex'"),
              std::string::npos);
    std::string list = ply(three, 3, "", 1);
    list.replace(list.find("list uchar"), 10, "list uint");
    folder.write("list.ply", list + "1000000000 0 1 2\n");
    EXPECT_NE(error_of_shape("ply", "list.ply").find("face 0: the file ends too early"), std::string::npos);
}

TEST_F(BrokenFile, RejectsIndicesOutOfRange) {
    folder.write("obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    folder.write("ply", ply("0 0 0\n1 0 0\n0 1 0\n", 3, "3 0 1 3\n", 1));
    std::string body = SerializedBytes(4).square<float>(0, 1);
    body[body.size() - 4] = 4;
    folder.write("serialized", SerializedBytes(4).mesh(body).file());
    for (const char* format : formats)
        EXPECT_NE(error_of_shape(format, format).find(" refers to "), std::string::npos) << format;
}

/// Triangles with a broken position are lost, and the others stay.
TEST_F(BrokenFile, LeavesOutTrianglesWithPositionsThatAreNotFinite) {
    const std::string faces = "f 1 2 3\nf 1 3 4\n";
    for (const char* broken : {"nan 0 0", "0 -inf 0", "1.#IND 0 0", "0 0 1e99", "-nan(ind) 0 0"}) {
        folder.write("a.obj", std::string("v 0 0 0\nv ") + broken + "\nv 0 1 0\nv 0 0 1\n" + faces);
        EXPECT_THAT(error_of_shape("obj", "a.obj"),
                    testing::HasSubstr("'a.obj': 1 position not finite: 1 triangle left out"));
        EXPECT_EQ(mesh_of("obj", "a.obj").triangles.size(), 1u);
        folder.write("a.ply",
                     ply(std::string("0 0 0\n") + broken + "\n0 1 0\n0 0 1\n", 4, "3 0 1 2\n3 0 2 3\n", 2));
        EXPECT_THAT(error_of_shape("ply", "a.ply"),
                    testing::HasSubstr("'a.ply': 1 position not finite: 1 triangle left out"));
        EXPECT_EQ(mesh_of("ply", "a.ply").triangles.size(), 1u);
    }
    folder.write("a.serialized", SerializedBytes(4).mesh(SerializedBytes(4).square<double>(0, 1e300)).file());
    EXPECT_THAT(error_of_shape("serialized", "a.serialized"), testing::HasSubstr("not finite"));
}

TEST_F(BrokenFile, LoadsDegenerateAndFlippedTriangles) {
    // The faces are a point, a line, a triangle, and the same triangle flipped.
    const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n2 0 0\n";
    const std::string faces = "3 0 0 0\n3 0 1 3\n3 0 1 2\n3 0 2 1\n";
    folder.write("m.ply", ply(vertices, 4, faces, 4));
    const Mesh mesh = mesh_of("ply", "m.ply");
    EXPECT_EQ(mesh.triangles.size(), 4u);
    for (const glm::vec3 n : mesh.normals)
        EXPECT_NEAR(glm::length(n), 1, 1e-5);
    EXPECT_EQ(front_normal(mesh, mesh.triangles[0]), glm::vec3(0));
    EXPECT_EQ(front_normal(mesh, mesh.triangles[1]), glm::vec3(0));
}

TEST_F(BrokenFile, RejectsASecondVertexList) {
    folder.write("m.ply",
                 "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                 "property float z\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                 "end_header\n0 0 0\n1 1 1\n");
    EXPECT_NE(error_of_shape("ply", "m.ply").find("vertex 0: there is a second list of vertices"),
              std::string::npos);
}

} // namespace tessera
