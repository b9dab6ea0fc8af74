#include "app/commands/commands.h"
#include "recon/picture/oidn.h"
#include "render/io/exr.h"
#include "render/run/first_hits.h"
#include "render/run/thread_pool.h"
#include "render/scene/scene.h"
#include "tests/support/scene_builder.h"
#include "ui/state/companions.h"
#include "ui/viewer/viewer_options.h"

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace tessera {
namespace {

using nlohmann::json;

struct SavedPictureTest : testing::Test {
    SavedPictureTest() {
        auto images = std::make_shared<GradientImages>();
        images->primal = RgbImage(16, 12, Rgb(0.5f));
        images->dx = images->dy = RgbImage(16, 12, Rgb(0));
        snapshot->settings.method = Method::gpt;
        snapshot->spp = 7;
        snapshot->images = images;
    }
    ExrFile saved(const SavedPicture& picture) const {
        const auto file =
            std::filesystem::temp_directory_path() / ("tessera-saved-" + std::to_string(::getpid()) + ".exr");
        write_saved_picture(file, picture);
        ExrFile exr = read_exr(file);
        std::filesystem::remove(file);
        return exr;
    }
    /// Gives the snapshot a reconstruction that no solver would produce.
    void reconstruct(int spp) {
        snapshot->reconstruction = std::make_shared<Reconstruction>(Reconstruction{marked, 0.25, 42, 1.5});
        snapshot->reconstruction_spp = spp;
        snapshot->reconstructed_with = settings;
    }
    RgbImage plain(const SavedPicture& picture) const { return *find_layer(saved(picture), ""); }

    std::shared_ptr<Snapshot> snapshot = std::make_shared<Snapshot>();
    ReconstructionSettings settings;
    const RgbImage marked{16, 12, Rgb(0.125f, 0.25f, 3)};
};

TEST_F(SavedPictureTest, HeaderStatesHowItWasMade) {
    snapshot->seconds = 3.5;
    snapshot->cpu_seconds = 9.25;
    snapshot->counters.camera_paths = 1344;
    settings.norm = Norm::l1;
    const SceneSource source{"room.xml", {{"roughness", "0.1"}}, {}};
    const ExrFile exr = saved({snapshot, settings, source, nullptr, nullptr});

    const auto about = json::parse(exr.attributes.at("tessera:settings"));
    EXPECT_EQ(about.at("norm"), "l1");
    EXPECT_EQ(about.at("scene"), "room.xml");
    EXPECT_EQ(about.at("variables").at("roughness"), "0.1");
    const auto stats = json::parse(exr.attributes.at("tessera:stats"));
    EXPECT_EQ(stats.at("seconds").at("render").at("wall"), 3.5);
    EXPECT_EQ(stats.at("seconds").at("render").at("cpu"), 9.25);
    EXPECT_EQ(stats.at("spp"), 7);
    EXPECT_EQ(stats.at("camera_paths"), 1344);
    EXPECT_EQ(exr.attributes.count("tessera:camera"), 1u);
    EXPECT_NE(find_layer(exr, "dx"), nullptr);
    EXPECT_EQ(find_layer(exr, "first_hit_albedo"), nullptr); // without a scene
    EXPECT_EQ(find_layer(exr, "error_relMSE"), nullptr);
}

TEST_F(SavedPictureTest, SavesTheDisplayedReconstruction) {
    reconstruct(7);
    const ExrFile exr = saved({snapshot, settings, {}, nullptr, nullptr});
    EXPECT_EQ((*find_layer(exr, ""))(3, 4), marked(3, 4));
    const auto stats = json::parse(exr.attributes.at("tessera:stats")).at("seconds").at("reconstruct").at(0);
    EXPECT_EQ(stats.at("iterations"), 42);
    EXPECT_EQ(stats.at("wall"), 1.5);
    EXPECT_TRUE(stats.at("cpu").is_null());
    EXPECT_EQ(stats.at("norm"), "guided");
    EXPECT_NE(find_layer(exr, "primal"), nullptr);
}

/// Without the denoiser, the session shows the guided reconstruction.
TEST_F(SavedPictureTest, SavesGuidedWithoutTheDenoiser) {
    if (oidn_problem().empty())
        GTEST_SKIP() << "the denoiser is installed";
    reconstruct(7);
    settings.norm = Norm::oidn;
    EXPECT_EQ(plain({snapshot, settings, {}, nullptr, nullptr})(3, 4), marked(3, 4));
}

TEST_F(SavedPictureTest, ReconstructsIfTheDisplayedPictureIsOutdated) {
    reconstruct(6); // a reconstruction of an earlier pass
    EXPECT_NEAR(plain({snapshot, settings, {}, nullptr, nullptr})(3, 4).b, 0.5f, 1e-3f);
    reconstruct(7);
    settings.alpha = 0.1f; // changed after the reconstruction
    EXPECT_NEAR(plain({snapshot, settings, {}, nullptr, nullptr})(3, 4).b, 0.5f, 1e-3f);
}

/// The CPU time excludes the viewer's other threads, which keep rendering.
TEST_F(SavedPictureTest, CpuSecondsAreThoseOfTheReconstruction) {
    auto images = std::make_shared<GradientImages>(*snapshot->images);
    images->primal = RgbImage(320, 240, Rgb(0.5f));
    images->dx = images->dy = RgbImage(320, 240, Rgb(0));
    for (std::size_t i = 0; i < images->primal.size(); i += 3)
        images->primal.data()[i] = images->dx.data()[i / 2] = Rgb(static_cast<float>(i % 17));
    snapshot->images = images;
    settings.norm = Norm::l1;
    std::atomic<int> begun = 0;
    std::atomic<bool> is_saved = false;
    std::vector<std::jthread> others;
    for (int i = 0; i < 3; ++i)
        others.emplace_back([&] {
            for (++begun; !is_saved;)
                ;
        });
    while (begun < 3)
        std::this_thread::yield();
    const double before = thread_cpu_seconds();
    const ExrFile exr = saved({snapshot, settings, {}, nullptr, nullptr});
    const double thread_seconds = thread_cpu_seconds() - before;
    is_saved = true;
    const auto stats = json::parse(exr.attributes.at("tessera:stats")).at("seconds").at("reconstruct").at(0);
    EXPECT_GT(stats.at("cpu"), 0);
    EXPECT_LE(stats.at("cpu"), thread_seconds);
}

TEST_F(SavedPictureTest, HasFirstHitLayers) {
    test::SceneBuilder room;
    const int red = room.diffuse({0.6f, 0.1f, 0.1f});
    room.room({red, red, red, red, red});
    room.camera({0, 0, 3.4f}, {0, 0, 0}, 40);
    const std::shared_ptr<const Scene> scene = room.build();
    snapshot->camera = scene->camera();
    const ExrFile exr = saved({snapshot, settings, {}, scene, nullptr});
    const FirstHits hits = trace_first_hits(*scene, scene->camera(), {16, 12});
    EXPECT_NEAR((*find_layer(exr, "first_hit_albedo"))(8, 6).r, 0.6f, 0.02f);
    EXPECT_EQ((*find_layer(exr, "first_hit_normal"))(8, 6), hits.normal(8, 6));
    EXPECT_EQ((*find_layer(exr, "first_hit_depth"))(8, 6), Rgb(hits.depth(8, 6)));
    EXPECT_GT(hits.depth(8, 6), 0);
}

TEST_F(SavedPictureTest, HasTheErrorsOfTheSavedPicture) {
    reconstruct(7);
    auto reference = std::make_shared<Reference>();
    reference->name = "truth.exr";
    reference->image = RgbImage(16, 12, Rgb(1));
    const ExrFile exr = saved({snapshot, settings, {}, nullptr, reference});
    const std::pair<const char*, ErrorKind> layers[] = {{"error_relMSE", ErrorKind::relative_squared},
                                                        {"error_squared", ErrorKind::squared},
                                                        {"error_absolute", ErrorKind::absolute},
                                                        {"error_relative", ErrorKind::relative}};
    for (const auto& [name, kind] : layers) {
        ASSERT_NE(find_layer(exr, name), nullptr) << name;
        EXPECT_EQ((*find_layer(exr, name))(3, 4).r, pixel_error(kind, marked(3, 4), Rgb(1))) << name;
    }
    EXPECT_EQ(exr.attributes.at("tessera:errors_to"), "truth.exr");
    reference->image = RgbImage(8, 6, Rgb(1)); // another size
    const ExrFile without = saved({snapshot, settings, {}, nullptr, reference});
    EXPECT_EQ(find_layer(without, "error_relMSE"), nullptr);
    EXPECT_EQ(without.attributes.count("tessera:errors_to"), 0u);
}

} // namespace
} // namespace tessera
