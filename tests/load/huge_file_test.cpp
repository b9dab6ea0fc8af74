// Files that need more memory than is available are refused before allocation, and the message states the sizes.

#include "render/io/available_memory.h"
#include "render/load/plugins.h"
#include "render/mesh/meshes.h"
#include "tests/load/serialized_bytes.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/memory_limit.h"

#include <functional>
#include <sstream>

#include <gtest/gtest.h>

namespace tessera {

namespace {

using test::MemoryLimit;

constexpr rlim_t available_bytes = 20 << 20;

/// Returns the message of the OutOfMemory error that `read` throws under a memory limit, or "not refused".
std::string refusal(const std::function<void()>& read) {
    try {
        const MemoryLimit limit(available_bytes);
        read();
    } catch (const OutOfMemory& error) {
        return error.what();
    }
    return "not refused";
}

class HugeFile : public testing::Test {
protected:
    void SetUp() override {
        if (!test::can_limit_memory)
            GTEST_SKIP() << "sanitizers take all address space";
    }
    TemporaryFolder folder;
};

TEST_F(HugeFile, PlyOfFourBillionVertices) {
    const std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
        "property float y\nproperty float z\nend_header\n";
    const std::filesystem::path file = folder.write("huge.ply", header);
    std::filesystem::resize_file(file, header.size() + 48'000'000'000); // a sparse file, which takes no disk space
    EXPECT_EQ(refusal([&] { read_ply(file); }).find("its 4000000000 vertices need 89.4 GiB of memory, and "), 0u);
}

TEST_F(HugeFile, PlyOfManyFaces) {
    const std::string text = "ply\nformat binary_little_endian 1.0\nelement face 4000000\nproperty list uchar int "
                             "vertex_indices\nend_header\n" +
                             std::string(4'000'000, '\0');
    const std::filesystem::path file = folder.write("faces.ply", text);
    EXPECT_EQ(refusal([&] { read_ply(file); }).find("its 4000000 faces need 46 MiB of memory, and "), 0u);
}

TEST_F(HugeFile, Serialized) {
    std::string body;
    SerializedBytes::append<std::uint32_t>(body, 0x1000);
    SerializedBytes::append<std::uint64_t>(body, 2'000'000);
    SerializedBytes::append<std::uint64_t>(body, 1'000'000);
    std::istringstream stream(SerializedBytes(3).mesh(body).file() + std::string(100'000, '\0'));
    EXPECT_EQ(refusal([&] {
                  parse_serialized(stream, 0);
              }).find("its 2000000 vertices and 1000000 triangles need 57 MiB of memory, and "),
              0u);
}

TEST_F(HugeFile, Obj) {
    std::string text;
    for (int i = 0; i < 1'000'000; ++i)
        text += "v 0 0 0\n";
    const std::filesystem::path file = folder.write("huge.obj", text + "f 1 2 3\n");
    EXPECT_EQ(refusal([&] { read_obj(file); }).find("its 1000000 vertices and 1 triangles need "), 0u);
}

TEST_F(HugeFile, Texture) {
    std::string tga(18 + 1'000'000, '\0');
    tga[2] = 10;                                // true colour, run-length encoded
    tga[12] = tga[14] = static_cast<char>(160); // width and height of 4000, lower bytes
    tga[13] = tga[15] = 15;
    tga[16] = 24;
    EXPECT_EQ(refusal([&] {
                  parse_bitmap(tga, ".tga", true, [] { return true; });
              }).find("its pixels need 92 MiB of memory, and "),
              0u);
}

} // namespace

} // namespace tessera
