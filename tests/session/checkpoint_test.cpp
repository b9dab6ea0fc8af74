// Renders that resume from a checkpoint, and invalid checkpoint files.
#include "render/run/checkpoint.h"
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::shared_ptr<const Scene> patchwork() {
    for (const TestScene& t : all_test_scenes())
        if (t.name == "patchwork")
            return t.scene;
    return nullptr;
}

Render new_render(const std::shared_ptr<const Scene>& scene, Method method) {
    RenderSettings settings;
    settings.method = method;
    settings.tile = 5;
    settings.path_guiding = Guiding::off; // checkpoints do not store what path guiding has learned
    return Render(scene, scene->camera(), {37, 29}, settings);
}

bool same_bits(const RgbImage& a, const RgbImage& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Rgb)) == 0);
}

/// A checkpoint restores all state that a pass reads or changes: film, LearnedReuse and counters.
TEST(Checkpoint, ResumedRenderHasTheSameBits) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "render.checkpoint";
    const std::shared_ptr<const Scene> scene = patchwork();
    ThreadPool pool(2);
    for (Method method : all_methods) {
        Render whole = new_render(scene, method), first = new_render(scene, method);
        for (int i = 0; i < 5; ++i)
            whole.pass(pool);
        for (int i = 0; i < 2; ++i)
            first.pass(pool);
        write_checkpoint(file, "mine", first.memory());

        Render second = new_render(scene, method);
        const Checkpoint checkpoint = read_checkpoint(file);
        EXPECT_EQ(checkpoint.identity, "mine");
        restore(checkpoint, second.memory());
        EXPECT_EQ(second.spp(), 2);
        EXPECT_EQ(second.cpu_seconds(), first.cpu_seconds());
        for (int i = 0; i < 3; ++i)
            second.pass(pool);
        const GradientImages a = whole.images(), b = second.images();
        EXPECT_TRUE(same_bits(a.primal, b.primal)) << short_name(method);
        EXPECT_TRUE(same_bits(a.dx, b.dx)) << short_name(method);
        EXPECT_TRUE(same_bits(a.dy, b.dy)) << short_name(method);
        EXPECT_TRUE(same_bits(a.very_direct, b.very_direct)) << short_name(method);
        EXPECT_EQ(whole.counters().rays, second.counters().rays) << short_name(method);
        EXPECT_EQ(whole.counters().reused_paths, second.counters().reused_paths) << short_name(method);
    }
}

class CheckpointFile : public testing::Test {
protected:
    CheckpointFile() { write_checkpoint(file_, "identity", {memory_of(numbers_)}); }

    std::string bytes() const {
        std::ostringstream out;
        out << std::ifstream(file_, std::ios::binary).rdbuf();
        return out.str();
    }
    std::string refusal() const {
        try {
            read_checkpoint(file_);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    }

    TemporaryFolder folder_;
    fs::path file_ = folder_.path() / "a.checkpoint";
    std::array<int, 100> numbers_{1, 2, 3};
};

TEST_F(CheckpointFile, RestoresWhatWasWritten) {
    std::array<int, 60> first{};
    std::array<int, 40> second{};
    restore(read_checkpoint(file_), {memory_of(first), memory_of(second)});
    EXPECT_EQ(first[2], 3);
    EXPECT_TRUE(std::equal(second.begin(), second.end(), numbers_.begin() + 60));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1) << "no other file is left";
}

TEST_F(CheckpointFile, RejectsStateOfAnotherSizeUnchanged) {
    std::array<int, 99> numbers{7};
    EXPECT_THROW(restore(read_checkpoint(file_), {memory_of(numbers)}), std::runtime_error);
    EXPECT_EQ(numbers[0], 7);
}

TEST_F(CheckpointFile, DetectsAnyChangedOrMissingByte) {
    const std::string whole = bytes();
    EXPECT_EQ(refusal(), "");
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string changed = whole;
        changed[i] = static_cast<char>(changed[i] ^ 0x10);
        folder_.write("a.checkpoint", changed);
        EXPECT_THAT(refusal(), HasSubstr("a.checkpoint: is ")) << "byte " << i;
    }
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        folder_.write("a.checkpoint", whole.substr(0, length));
        EXPECT_THAT(refusal(), HasSubstr("a.checkpoint: is ")) << "length " << length;
    }
    folder_.write("a.checkpoint", whole + "x");
    EXPECT_THAT(refusal(), HasSubstr("is damaged"));
    fs::remove(file_);
    EXPECT_THAT(refusal(), HasSubstr("is not a checkpoint"));
}

} // namespace

} // namespace tessera::test
