// Rendering of references. Interruptions do not change a bit of the result.
#include "render/io/memory.h"
#include "render/run/checkpoint.h"
#include "render/run/reference_render.h"
#include "render/scene/scene.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/scene_builder.h"

#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct References : testing::Test {
    References() {
        recipe.size = {24, 16};
        recipe.spp = 12;
        recipe.settings.max_depth = 3;
    }

    fs::path file(const char* name) const { return folder.path() / name; }

    ReferenceRender begin(const char* name) { return {file(name), subject, recipe, pool}; }

    /// Renders until the reference has `spp` samples per pixel. Returns empty if it completes before.
    std::optional<int> run_to(const char* name, int spp) {
        ReferenceRender render = begin(name);
        if (render.run([&](const ReferenceRender& r) { return r.spp() < spp; }))
            return std::nullopt;
        return render.spp();
    }
    ReferenceImage complete(const char* name) {
        ReferenceRender render = begin(name);
        EXPECT_TRUE(render.run([](const ReferenceRender&) { return true; }));
        return render.finish();
    }
    std::string refusal(const char* name) {
        try {
            begin(name);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    }

    TemporaryFolder folder;
    ThreadPool pool{2};
    std::shared_ptr<const Scene> scene = all_test_scenes().front().scene;
    PictureSubject subject{{}, scene, scene->camera()};
    ReferenceRecipe recipe;
};

TEST_F(References, ResumeFromAnyPassWithTheSameBits) {
    const ReferenceImage whole = complete("whole.exr");
    EXPECT_FALSE(fs::exists(reference_checkpoint(file("whole.exr"))));
    for (int spp : {1, 5, 8}) // after an odd number of samples, one half is ahead
        EXPECT_EQ(run_to("parts.exr", spp), spp);
    EXPECT_TRUE(fs::exists(reference_checkpoint(file("parts.exr"))));
    ReferenceRender render = begin("parts.exr");
    EXPECT_EQ(render.spp_resumed(), 8);
    EXPECT_TRUE(std::isinf(render.seconds_left()));
    ASSERT_TRUE(render.run([](const ReferenceRender&) { return true; }));
    EXPECT_EQ(render.seconds_left(), 0);
    const ReferenceImage parts = render.finish();
    EXPECT_EQ(checksum_of(parts), checksum_of(whole));
    EXPECT_EQ(checksum_of(read_reference(file("parts.exr"))), checksum_of(whole));
    EXPECT_FALSE(fs::exists(reference_checkpoint(file("parts.exr"))));
}

/// A stop request before a pass prevents the pass.
TEST_F(References, StopRequestPreventsThePass) {
    ReferenceRender render = begin("a.exr");
    std::stop_source stop;
    EXPECT_FALSE(render.run(
        [&](const ReferenceRender& r) {
            if (r.spp() == 3)
                stop.request_stop();
            return true;
        },
        stop.get_token()));
    EXPECT_EQ(render.spp(), 3);
    EXPECT_EQ(begin("a.exr").spp_resumed(), 3);
}

std::uint32_t bits_of(const RgbImage& image) {
    return checksum(std::as_bytes(std::span(image.data(), image.size())));
}

/// A pass that is stopped at any time, any number of times, loses nothing and counts nothing twice.
TEST_F(References, StoppedPassesResumeWithTheSameBits) {
    constexpr glm::ivec2 size(240, 180);
    constexpr int passes = 3;
    Render whole(scene, scene->camera(), size, recipe.settings),
        parts(scene, scene->camera(), size, recipe.settings);
    int stopped_within = 0;
    for (std::chrono::duration<double> time(1e-4); parts.spp() < passes; time *= 1.2) {
        const std::uint32_t before = bits_of(parts.images().dx); // constant until a pass adds samples
        std::stop_source stop;
        const std::jthread ender([&] {
            std::this_thread::sleep_for(time);
            stop.request_stop();
        });
        if (!parts.pass(pool, stop.get_token()))
            stopped_within += bits_of(parts.images().dx) != before;
    }
    EXPECT_GT(stopped_within, 0);
    while (whole.spp() < passes)
        whole.pass(pool);
    EXPECT_EQ(bits_of(parts.images().primal), bits_of(whole.images().primal));
    EXPECT_EQ(bits_of(parts.images().dx), bits_of(whole.images().dx));
    EXPECT_EQ(bits_of(parts.images().very_direct), bits_of(whole.images().very_direct));
    EXPECT_EQ(parts.counters().camera_paths, whole.counters().camera_paths);
    EXPECT_EQ(parts.counters().rays, whole.counters().rays);
}

TEST_F(References, AreRecognisedByTheirHeaderAlone) {
    complete("a.exr");
    fs::resize_file(file("a.exr"), fs::file_size(file("a.exr")) / 2);
    EXPECT_THROW(read_reference(file("a.exr")), std::runtime_error);
    EXPECT_TRUE(is_reference(file("a.exr")));
}

TEST_F(References, OddNumbersOfSamplesAreRoundedUp) {
    recipe.spp = 5;
    ReferenceRender render = begin("odd.exr");
    ASSERT_TRUE(render.run([](const ReferenceRender&) { return true; }));
    EXPECT_EQ(render.spp(), 6);
}

TEST_F(References, KnowTheirErrorWhileRendering) {
    ReferenceRender render = begin("a.exr");
    ASSERT_FALSE(render.run([&](const ReferenceRender& r) { return r.spp() < 4; }));
    const double early = render.error_so_far().relative_mse;
    ASSERT_TRUE(render.run([](const ReferenceRender&) { return true; }));
    const FloorFreeError late = render.error_so_far();
    EXPECT_GT(early, late.relative_mse);
    EXPECT_EQ(error_of(render.finish()).relative_mse, late.relative_mse);
}

TEST_F(References, FilesHoldTheVarianceOfEachPixel) {
    const ReferenceImage whole = complete("a.exr");
    const ExrFile file = read_exr(folder.path() / "a.exr");
    const RgbImage& variance = *find_layer(file, "variance");
    ASSERT_EQ(variance.size(), whole.mean.size());
    double relative = 0; // relMSE as in recon/metrics/metrics.h, from the file's layers alone
    for (std::size_t i = 0; i < variance.size(); ++i)
        for (int c = 0; c < 3; ++c)
            relative += variance.data()[i][c] /
                        (static_cast<double>(whole.mean.data()[i][c]) * whole.mean.data()[i][c] + 0.001) / 3;
    EXPECT_NEAR(relative / static_cast<double>(variance.size()) / error_of(whole).relative_mse, 1, 1e-4);
}

/// Halves with gradients are reconstructed by L2, and halves without are not reconstructed. The header states it.
TEST_F(References, HaveAFixedReconstruction) {
    const auto half_of = [&](unsigned i) {
        RenderSettings settings = recipe.settings;
        settings.seed += i;
        Render render(scene, scene->camera(), recipe.size, settings);
        while (render.spp() < recipe.spp / 2)
            render.pass(pool);
        return render.take_images();
    };
    const std::pair<Method, Norm> cases[] = {{Method::pt, Norm::none}, {Method::gpr, Norm::l2}};
    for (const auto& [method, norm] : cases) {
        recipe.settings.method = method;
        const ReferenceImage image = complete("a.exr");
        for (unsigned i = 0; i < 2; ++i)
            EXPECT_EQ(bits_of(image.halves[i]), bits_of(reconstruct(half_of(i), reconstruction_of(recipe)).image));
        EXPECT_EQ(reconstruction_of(recipe).norm, norm);
        EXPECT_EQ(origin_of(read_reference(file("a.exr"))),
                  (ReferenceOrigin{method, std::string(to_string(norm))}));
    }
    recipe.reconstruction.norm = Norm::weighted;
    EXPECT_EQ(to_string(origin_of(complete("b.exr"))), "gpr, reconstructed by weighted");
    EXPECT_EQ(to_string(origin_of(ReferenceImage{})), "an unknown method");
}

/// Doubt is the standard error from the halves' difference in 3x3 pixels over their brightness, or 1 at marked
/// pixels.
TEST(Doubt, IsTheRelativeErrorOr1AtMarkedPixels) {
    std::array<RgbImage, 2> halves{RgbImage(9, 5, Rgb(0.98f)), RgbImage(9, 5, Rgb(0.98f))};
    halves[0](2, 2) = Rgb(1.48f); // a difference of 0.5 is an error of 0.25, and of 0.25 / 3 over 3x3 pixels
    Image<float> marked(9, 5, 0);
    marked(7, 1) = 1;
    const Image<float> doubt = doubt_of(halves, marked);
    EXPECT_NEAR(doubt(2, 2), 0.25 / 3 / (0.98 + 0.25 / 9 + 0.0098), 1e-4);
    EXPECT_EQ(doubt(2, 2), doubt(1, 1));
    EXPECT_EQ(doubt(4, 2), 0);
    EXPECT_EQ(doubt(7, 1), 1);
    EXPECT_DOUBLE_EQ(untrusted_fraction(doubt), 1 / 45.0);
    EXPECT_EQ(doubt_of({RgbImage(2, 2, Rgb(0)), RgbImage(2, 2, Rgb(0))}, Image<float>(2, 2, 0))(1, 1), 0);
}

/// Paths find the lamp only by hitting it. Pixels that rest on one such sample are in doubt.
TEST_F(References, DoubtPixelsThatRestOnOneSample) {
    SceneBuilder builder;
    const int white = builder.diffuse(Rgb(0.7f));
    builder.quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, white);
    const int lamp = builder.light(Texture(Rgb(20)));
    builder.quad({-0.2f, 1, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f}, white, lamp);
    builder.quad({-2, 0.5f, 2}, {4, 0, 0}, {0, 0, -4}, builder.glass(1.5f, true));
    builder.camera({0, 0.3f, 1.9f}, {0, 0, 0}, 60);
    scene = builder.build();
    subject = {{}, scene, scene->camera()};
    recipe.settings.max_depth = 6;
    const ReferenceImage few = complete("few.exr");
    EXPECT_GT(untrusted_fraction(few.doubt), 0.05);
    const RgbImage* layer = nullptr;
    const ExrFile written = read_exr(folder.path() / "few.exr");
    ASSERT_NE(layer = find_layer(written, "doubt"), nullptr);
    EXPECT_EQ((*layer)(3, 3).x, few.doubt(3, 3));
}

/// A black pixel on a surface is in doubt, because its light may be undiscovered. A pixel without surface is not.
TEST_F(References, DoubtBlackSurfaces) {
    SceneBuilder builder;
    const int lamp = builder.light(Texture(Rgb(1)));
    const int white = builder.diffuse(Rgb(0.7f));
    builder.quad({-1, -1, 0}, {1, 0, 0}, {0, 2, 0},
                 white); // the left half of the picture; the right half is empty
    builder.quad({-1, -1, -1}, {2, 0, 0}, {0, -2, 0}, white, lamp); // a lamp that lights no visible surface
    builder.camera({0, 0, 3}, {0, 0, 0}, 30);
    scene = builder.build();
    subject = {{}, scene, scene->camera()};
    const ReferenceImage image = complete("dark.exr");
    ASSERT_TRUE(is_black(image.mean(3, 8)));
    EXPECT_EQ(image.doubt(3, 8), 1);
    EXPECT_EQ(image.doubt(21, 8), 0);
}

TEST_F(References, RejectACheckpointOfAnotherPicture) {
    run_to("a.exr", 4);
    subject.camera.fov *= 0.9f;
    EXPECT_THAT(refusal("a.exr"), HasSubstr("is of another camera"));
    subject.camera = scene->camera();
    recipe.settings.max_depth = 4;
    EXPECT_THAT(refusal("a.exr"), HasSubstr("is of max_depth 3, not 4"));
    recipe.settings.max_depth = 3;
    recipe.spp = 2;
    EXPECT_THAT(refusal("a.exr"), HasSubstr("has 4 spp already, and 2 are asked for"));
}

/// No sample sees the changed mesh, so only the checksum of the loaded scene reveals it.
TEST_F(References, RejectACheckpointOfAChangedMeshOutOfSight) {
    const auto room = [](float far) {
        SceneBuilder builder;
        builder.quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, builder.diffuse(Rgb(0.5f)));
        builder.quad({-1, -1, far}, {2, 0, 0}, {0, 2, 0}, builder.diffuse(Rgb(0.5f)));
        builder.camera({0, 0, 3}, {0, 0, 0}, 40);
        return builder.build();
    };
    ReferenceRecipe short_recipe = recipe;
    short_recipe.spp = 4;
    const auto begin_with = [&](float far) {
        const auto changed = room(far);
        return std::make_unique<ReferenceRender>(
            file("m.exr"), PictureSubject{{"scene.xml", {}, {}}, changed, changed->camera()}, short_recipe, pool);
    };
    int calls = 0;
    EXPECT_FALSE(begin_with(50)->run([&](const ReferenceRender&) { return ++calls < 3; }));
    EXPECT_EQ(begin_with(50)->spp_resumed(), 2);
    try {
        begin_with(51);
        FAIL() << "the checkpoint resumed in another scene";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("is of another scene (other geometry)"));
    }
}

/// Checkpoints of different versions of the program can differ in size.
TEST_F(References, RejectACheckpointOfAnotherVersion) {
    run_to("a.exr", 4);
    const fs::path checkpoint = reference_checkpoint(file("a.exr"));
    Checkpoint old = read_checkpoint(checkpoint);
    old.state.resize(old.state.size() - 16);
    write_checkpoint(checkpoint, old.identity, {std::span(old.state)});
    EXPECT_THAT(refusal("a.exr"), HasSubstr("a.exr.checkpoint is of another version of the program"));
    EXPECT_TRUE(fs::exists(checkpoint));
}

TEST_F(References, FilesHoldTheCamera) {
    recipe.spp = 2;
    subject.camera.fov = 17;
    complete("a.exr");
    EXPECT_THAT(read_reference(file("a.exr")).camera, HasSubstr("\"fov\": 17"));
}

} // namespace

} // namespace tessera::test
