#include "app/saved_picture.h"
#include "render/load/exr.h"

#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace tessera {
namespace {

TEST(SavedPicture, ItsHeaderTellsHowItWasMade) {
    auto images = std::make_shared<GradientImages>();
    images->primal = RgbImage(16, 12, Rgb(0.5f));
    images->dx = images->dy = RgbImage(16, 12, Rgb(0));
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->settings.method = Method::gpt;
    snapshot->spp = 7;
    snapshot->seconds = 3.5;
    snapshot->cpu_seconds = 9.25;
    snapshot->counters.camera_paths = 1344;
    snapshot->images = images;
    ReconstructionSettings reconstruction;
    reconstruction.norm = Norm::l1;
    reconstruction.joint_colour = false;
    const auto file =
        std::filesystem::temp_directory_path() / ("tessera-saved-" + std::to_string(::getpid()) + ".exr");
    write_saved_picture(file, {snapshot, reconstruction, "room.xml"});
    const ExrFile exr = read_exr(file);
    std::filesystem::remove(file);

    const auto settings = nlohmann::json::parse(exr.attributes.at("tessera:settings"));
    EXPECT_EQ(settings.at("norm"), "l1");
    EXPECT_EQ(settings.at("joint_colour"), false);
    const auto stats = nlohmann::json::parse(exr.attributes.at("tessera:stats"));
    EXPECT_EQ(stats.at("seconds").at("render").at("wall"), 3.5);
    EXPECT_EQ(stats.at("seconds").at("render").at("cpu"), 9.25);
    EXPECT_EQ(stats.at("spp"), 7);
    EXPECT_EQ(stats.at("camera_paths"), 1344);
    EXPECT_EQ(exr.attributes.count("tessera:camera"), 1u);
    EXPECT_NE(find_layer(exr, "dx"), nullptr);
}

} // namespace
} // namespace tessera
