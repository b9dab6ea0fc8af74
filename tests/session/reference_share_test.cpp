// Shards of a reference. Their sum has the same bits, whatever the order and the interruptions. Shards that do not
// belong together are not merged.
#include "render/film/counters.h"
#include "render/run/checkpoint.h"
#include "render/run/reference_render.h"
#include "render/run/reference_share.h"
#include "render/scene/scene.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct ReferenceShards : testing::Test {
    ReferenceShards() {
        recipe.size = {24, 16};
        recipe.spp = 24;
        recipe.settings.max_depth = 3;
    }

    fs::path file(const std::string& name) const { return folder.path() / name; }
    ReferenceImage whole(const std::string& name) {
        ReferenceRender render(file(name), subject, recipe, pool);
        EXPECT_TRUE(render.run([](const ReferenceRender&) { return true; }));
        return render.finish();
    }
    /// Renders shard `number` of `count`. If `end_at` is not 0, rendering is interrupted once after that many
    /// samples.
    fs::path shard(int number, int count, const std::string& name = {}, int end_at = 0) {
        ReferenceRecipe of_shard = recipe;
        of_shard.share = {number, count};
        const fs::path path = file(name.empty() ? fmt::format("{}-of-{}.share", number, count) : name);
        if (end_at > 0) {
            ReferenceRender render(path, subject, of_shard, pool);
            EXPECT_FALSE(render.run([&](const ReferenceRender& r) { return r.spp() < end_at; }));
        }
        ReferenceRender render(path, subject, of_shard, pool);
        EXPECT_EQ(render.spp_resumed(), end_at);
        EXPECT_TRUE(render.run([](const ReferenceRender&) { return true; }));
        render.finish_shard();
        EXPECT_FALSE(fs::exists(reference_checkpoint(path)));
        return path;
    }
    std::string refusal(const std::vector<fs::path>& files) const {
        try {
            merge_shards(files, file("none.exr"));
        } catch (const std::runtime_error& error) {
            EXPECT_FALSE(fs::exists(file("none.exr")));
            return error.what();
        }
        return "";
    }

    TemporaryFolder folder;
    ThreadPool pool{2};
    std::shared_ptr<const Scene> scene = all_test_scenes().front().scene;
    PictureSubject subject{{"a scene.xml", {{"x", "1"}}, {}}, scene, scene->camera()};
    ReferenceRecipe recipe;
};

TEST_F(ReferenceShards, OneOfOneEqualsTheWhole) {
    for (const Method method : all_methods) {
        recipe.settings.method = method;
        const ReferenceImage expected = whole("whole.exr");
        const ReferenceImage merged = merge_shards({shard(1, 1)}, file("merged.exr"));
        EXPECT_EQ(checksum_of(merged), checksum_of(expected)) << short_name(method);
        EXPECT_EQ(merged.settings, expected.settings);
        EXPECT_EQ(merged.camera, expected.camera);
        EXPECT_EQ(merged.scene, expected.scene);
        EXPECT_EQ(merged.seeds, expected.seeds);
    }
}

TEST_F(ReferenceShards, HaveTheSameBitsInAnyOrder) {
    std::vector<fs::path> files;
    for (int number = 1; number <= 5; ++number)
        files.push_back(shard(number, 5));
    const std::uint32_t expected = checksum_of(merge_shards(files, file("merged.exr")));
    EXPECT_EQ(checksum_of(read_reference(file("merged.exr"))), expected);
    std::reverse(files.begin(), files.end());
    for (fs::path& path : files) // rendered again with interruptions
        fs::remove(path);
    for (int number = 5; number >= 1; --number)
        shard(number, 5, {}, 2);
    EXPECT_EQ(checksum_of(merge_shards(files, file("again.exr"))), expected);
}

/// If a method learns nothing from earlier passes, the shards have the samples of the whole reference. The
/// pictures differ only by the order of summation.
TEST_F(ReferenceShards, HaveTheSamplesOfTheWhole) {
    recipe.settings.method = Method::pt;
    recipe.spp = 23; // 12 passes per half, divided among 5 shards
    const ReferenceImage expected = whole("whole.exr");
    std::vector<fs::path> files;
    for (int number = 1; number <= 5; ++number)
        files.push_back(shard(number, 5));
    const ReferenceImage merged = merge_shards(files, file("merged.exr"));
    for (std::size_t i = 0; i < expected.mean.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const float value = expected.mean.data()[i][c];
            EXPECT_NEAR(merged.mean.data()[i][c], value, 1e-4f * std::abs(value) + 1e-6f) << i;
        }
    EXPECT_EQ(merged.settings, expected.settings);
}

/// Shards of few passes learn nothing from earlier passes, but the expected picture is the same.
TEST_F(ReferenceShards, AreUnbiasedForAnyNumber) {
    recipe.settings.seed += 100;
    recipe.spp = 1600;
    const ReferenceImage expected = whole("whole.exr");
    recipe.spp = 400;
    double difference = 0, errors = 0;
    for (int render = 0; render < 3; ++render) {
        recipe.settings.seed += 100;
        std::vector<fs::path> files;
        for (int number = 1; number <= 50; ++number)
            files.push_back(shard(number, 50, fmt::format("{}-{}.share", render, number)));
        const ReferenceImage merged = merge_shards(files, file(fmt::format("merged-{}.exr", render)));
        EXPECT_EQ(variance_of(merged).size(), expected.mean.size());
        double squares = 0;
        for (std::size_t i = 0; i < expected.mean.size(); ++i) {
            const Rgb d = merged.mean.data()[i] - expected.mean.data()[i];
            const Rgb scale = expected.mean.data()[i] * expected.mean.data()[i] + Rgb(0.001f);
            squares += static_cast<double>((d * d / scale).x + (d * d / scale).y + (d * d / scale).z) / 3;
        }
        difference += squares / static_cast<double>(expected.mean.size());
        errors += error_of(merged).relative_mse + error_of(expected).relative_mse;
    }
    // The mean squared difference is the sum of both errors.
    EXPECT_LT(difference, 1.5 * errors);
    EXPECT_GT(difference, 0.5 * errors);
}

TEST_F(ReferenceShards, AreRejectedIfTheyDoNotBelongTogether) {
    const fs::path one = shard(1, 3), two = shard(2, 3), three = shard(3, 3);
    EXPECT_EQ(refusal({one}), "these of 3 shares are missing: 2, 3");
    EXPECT_THAT(refusal({one, two, three, shard(2, 3, "twice.share")}),
                HasSubstr("2-of-3.share and " + file("twice.share").string() + " are both share 2 of 3"));
    EXPECT_THAT(refusal({one, two, shard(3, 4)}),
                HasSubstr("cannot be merged: the first is of 4 shares, not 3"));
    const auto changed = [&](auto change) {
        const ReferenceRecipe before = recipe;
        const PictureSubject before_subject = subject;
        change();
        const fs::path other = shard(3, 3, "other.share");
        recipe = before;
        subject = before_subject;
        return refusal({one, two, other});
    };
    EXPECT_THAT(changed([&] { recipe.spp = 48; }), HasSubstr("spp 48, not 24"));
    EXPECT_THAT(changed([&] { recipe.settings.seed = 5; }), HasSubstr("seed 5, not 1001"));
    EXPECT_THAT(changed([&] { recipe.settings.max_depth = 2; }), HasSubstr("max_depth 2, not 3"));
    EXPECT_THAT(changed([&] { recipe.reconstruction.norm = Norm::none; }), HasSubstr("reconstruction {"));
    EXPECT_THAT(changed([&] { subject.scene = all_test_scenes().back().scene; }), HasSubstr("another scene"));
    fs::resize_file(three, fs::file_size(three) - 1);
    EXPECT_THAT(refusal({one, two, three}), HasSubstr("3-of-3.share: is damaged"));
    folder.write("text.share", "none");
    EXPECT_THAT(refusal({file("text.share")}), HasSubstr("text.share: is not a checkpoint"));
    write_checkpoint(file("plain.share"), "{}", {});
    EXPECT_THAT(refusal({file("plain.share")}), HasSubstr("is not a share of a reference"));
}

TEST_F(ReferenceShards, AreRejectedIfOfAnotherVersion) {
    const fs::path one = shard(1, 2), two = shard(2, 2);
    const Checkpoint checkpoint = read_checkpoint(two);
    std::string header = checkpoint.identity;
    const std::string version = "\"version\":\"";
    header.insert(header.find(version) + version.size(), "0.0.9, not ");
    std::vector<std::byte> state = checkpoint.state;
    write_checkpoint(two, header, {std::span(state)});
    EXPECT_THAT(refusal({one, two}), HasSubstr("the first is of version \"0.0.9, not "));
}

TEST_F(ReferenceShards, AreAtMostAsManyAsPasses) {
    recipe.spp = 8;
    recipe.share = {5, 5};
    EXPECT_THROW(passes_of(recipe), std::invalid_argument);
    recipe.share = {0, 4};
    EXPECT_THROW(passes_of(recipe), std::invalid_argument);
    int passes = 0;
    for (int number = 1; number <= 3; ++number) {
        recipe.share = {number, 3};
        EXPECT_EQ(passes_of(recipe).first, passes);
        passes += passes_of(recipe).count;
    }
    EXPECT_EQ(passes, 4);
}

} // namespace

} // namespace tessera::test
