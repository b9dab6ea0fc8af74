// Error messages about files name the file.

#include "app/cli/opened_scene.h"
#include "app/experiment/result.h"
#include "render/io/available_memory.h"
#include "render/io/exr.h"
#include "render/run/thread_pool.h"
#include "tests/app/program.h"
#include "tests/load/pfm_bytes.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/memory_limit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class NamedFiles : public testing::Test {
protected:
    TemporaryFolder folder_;
};

TEST_F(NamedFiles, TwoScenesWithTheSameName) {
    for (const char* place : {"a", "b"}) {
        fs::create_directory(folder_.path() / place);
        folder_.write(std::string(place) + "/box.xml", "<scene version='3.0.0'><shape type='cube'/></scene>");
    }
    const Outcome o = run(folder_.path(), "stability a/box.xml b/box.xml -o out");
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_THAT(o.output, HasSubstr("a/box.xml and b/box.xml are both named \"box\""));
}

TEST_F(NamedFiles, ImageTooSmallForATileSpectrum) {
    write_exr(folder_.path() / "small.exr", {{{"", RgbImage(16, 16)}}, {}});
    const Outcome o = run(folder_.path(), "compare small.exr small.exr --tile 8");
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_THAT(o.output, HasSubstr("small.exr: a tile spectrum needs "));
}

TEST_F(NamedFiles, BuffersThatOverflowFloats) {
    folder_.write("p.pfm", pfm_bytes(RgbImage(16, 16, Rgb(3e38f))));
    folder_.write("d.pfm", pfm_bytes(RgbImage(16, 16, Rgb(-3e38f))));
    const Outcome o = run(folder_.path(), "reconstruct p.pfm d.pfm d.pfm --recon l2 -o out.exr");
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_THAT(o.output, HasSubstr("p.pfm: the values are too large"));
}

TEST_F(NamedFiles, UnreadableJournal) {
    const fs::path file = folder_.path() / "journal.jsonl";
    fs::create_directory(file);
    try {
        Journal().read(file);
        FAIL() << "a folder was read as a journal";
    } catch (const std::exception& error) {
        EXPECT_THAT(error.what(), HasSubstr("journal.jsonl: this is a folder"));
    }
}

TEST_F(NamedFiles, SceneWithoutMemoryForItsBvh) {
    if (!can_limit_memory)
        GTEST_SKIP() << "sanitizers take all address space";
    std::string ply =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1000000\nproperty list uchar uchar vertex_index\nend_header\n";
    for (const float number : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f})
        ply.append(reinterpret_cast<const char*>(&number), sizeof number);
    for (int i = 0; i < 1'000'000; ++i)
        ply.append("\3\0\1\2", 4);
    folder_.write("many.ply", ply);
    const fs::path scene = folder_.write("many.xml", "<scene version='3.0.0'><shape type='ply'><string "
                                                     "name='filename' value='many.ply'/></shape></scene>");
    ThreadPool pool(1);
    try {
        const MemoryLimit limit(100 << 20);
        open_scene({scene, {}}, pool);
        FAIL() << "the memory limit has no effect";
    } catch (const OutOfMemory& error) {
        EXPECT_THAT(error.what(), HasSubstr("many.xml: 1000000 triangles in a BVH need 130 MiB of memory"));
    }
}

} // namespace

} // namespace tessera::test
