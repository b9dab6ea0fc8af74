#include "render/io/plain_images.h"
#include "tests/ui/osmesa_context.h"
#include "ui/gl/gl.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <glad/gl.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace tessera {
namespace {

const std::vector<std::uint8_t> black{0, 0, 0};

namespace fs = std::filesystem;

struct Folder {
    fs::path path = fs::temp_directory_path() / ("tessera-screenshot-" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

TEST(Screenshot, ReadsFromTheTopLeft) {
    const test::OsmesaContext context({5, 3}); // rows of 15 bytes, which are not aligned
    glClearColor(0, 0, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 2, 1, 1); // OpenGL's rows begin at the bottom
    glClearColor(1, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    const ScreenPixels pixels = read_screen({5, 3});
    EXPECT_EQ(pixels.at(0, 0)[0], 255);
    EXPECT_EQ(pixels.at(0, 0)[2], 0);
    EXPECT_EQ(pixels.at(4, 2)[2], 255);
    EXPECT_EQ(pixels.at(0, 1)[2], 255);
}

TEST(Screenshot, WritesACompletePngAndNoOtherFile) {
    const Folder folder;
    const ScreenPixels pixels{{2, 2}, std::vector<std::uint8_t>(12, 200)};
    write_png(folder.path / "a.png", pixels.size, pixels.rgb);
    write_png(folder.path / "a.png", pixels.size, pixels.rgb); // replaces the file
    std::ifstream file(folder.path / "a.png", std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(bytes.substr(1, 3), "PNG");
    EXPECT_NE(bytes.find("IEND"), std::string::npos);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 1);
}

TEST(Screenshot, ErrorsNameTheUnwritablePath) {
    const Folder folder;
    const fs::path target = folder.path / "no such folder" / "a.png";
    try {
        write_png(target, {1, 1}, black);
        FAIL();
    } catch (const std::exception& e) {
        EXPECT_NE(std::string(e.what()).find(target.string()), std::string::npos);
    }
    fs::create_directory(folder.path / "taken");
    EXPECT_THROW(write_png(folder.path / "taken", {1, 1}, black), std::exception);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 1);
}

} // namespace
} // namespace tessera
