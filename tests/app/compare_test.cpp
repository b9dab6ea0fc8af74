#include "app/commands/commands.h"
#include "render/io/exr.h"
#include "render/run/reference_image.h"
#include "tests/recon/test_images.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace tessera {
namespace {

namespace fs = std::filesystem;

class Compare : public testing::Test {
protected:
    Compare() { fs::create_directories(folder_); }
    ~Compare() override { fs::remove_all(folder_); }

    fs::path write(const char* name, const RgbImage& image, const char* layer = "") const {
        write_exr(folder_ / name, {{{layer, image}}, {}});
        return folder_ / name;
    }

    /// Runs the command and captures its output in out_ and err_.
    int run(const CompareOptions& options) {
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        const int code = run_compare(options);
        out_ = testing::internal::GetCapturedStdout();
        err_ = testing::internal::GetCapturedStderr();
        return code;
    }

    fs::path folder_ = fs::temp_directory_path() / ("tessera-compare-test-" + std::to_string(::getpid()));
    std::string out_, err_;
};

TEST_F(Compare, PrintsJson) {
    const fs::path image = write("i.exr", RgbImage(8, 6, Rgb(3))),
                   reference = write("r.exr", RgbImage(8, 6, Rgb(2)));
    ASSERT_EQ(run({image, reference, {}, {}, true}), 0) << err_;
    const auto json = nlohmann::json::parse(out_);
    EXPECT_NEAR(json["relmse"].get<double>(), 1 / 4.001, 1e-6);
    EXPECT_NEAR(json["mse"].get<double>(), 1, 1e-6);
    EXPECT_NEAR(json["mape"].get<double>(), 1 / 2.01, 1e-6);
    EXPECT_NEAR(json["mean_ratio"].get<double>(), 1.5, 1e-6);
    EXPECT_FALSE(json.contains("relmse_floor_free"));
}

TEST_F(Compare, CountsPixelsWithoutLight) {
    RgbImage image(8, 6, Rgb(3));
    image(1, 2) = Rgb(0);
    image(5, 4) = Rgb(0.1f, -1, 0.1f);
    image(6, 4) = Rgb(0, 0, 1);
    const fs::path file = write("i.exr", image), reference = write("r.exr", RgbImage(8, 6, Rgb(2)));
    ASSERT_EQ(run({file, reference, {}, {}, true}), 0) << err_;
    EXPECT_DOUBLE_EQ(nlohmann::json::parse(out_)["share_without_light"].get<double>(), 2.0 / 48);
}

TEST_F(Compare, AReferenceWithHalvesGivesTheFloorFreeError) {
    const fs::path image = write("i.exr", RgbImage(8, 6, Rgb(2))), reference = folder_ / "r.exr";
    const RgbImage low(8, 6, Rgb(1)), high(8, 6, Rgb(3));
    write_reference(reference, {mean_of(low, high), {low, high}, {1, 2}, ""});
    ASSERT_EQ(run({image, reference, {}, {}, true}), 0) << err_;
    const auto json = nlohmann::json::parse(out_);
    EXPECT_NEAR(json["relmse_floor_free"].get<double>(), -1 / 4.001, 1e-6);
    EXPECT_EQ(json["relmse"].get<double>(), 0);
}

TEST_F(Compare, MeasuresTheGridOfTiles) {
    RgbImage tiled(64, 48, Rgb(1));
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            tiled(x, y) += Rgb(0.01f * static_cast<float>((x / 4 * 7 + y / 4 * 5) % 11) +
                               1e-4f * static_cast<float>(x * y % 3));
    const fs::path image = write("i.exr", tiled), reference = write("r.exr", RgbImage(64, 48, Rgb(1)));
    ASSERT_EQ(run({image, reference, {}, {}, true, 4}), 0) << err_;
    EXPECT_GT(nlohmann::json::parse(out_)["tiles"]["edge_ratio"], 1000);
    ASSERT_EQ(run({image, reference, {}, {}, false, 4}), 0);
    EXPECT_NE(out_.find("tiles, in edges"), std::string::npos);
    EXPECT_EQ(run({image, reference, {}, {}, false, 16}), 2) << "too few tiles";
    ASSERT_EQ(run({image, reference, {}, {}, true}), 0);
    EXPECT_FALSE(nlohmann::json::parse(out_).contains("tiles"));
}

TEST_F(Compare, TwoReferencesGiveTheFloorFreeError) {
    const fs::path image = write("i.exr", RgbImage(8, 6, Rgb(2))), low = write("a.exr", RgbImage(8, 6, Rgb(1))),
                   high = write("b.exr", RgbImage(8, 6, Rgb(3)));
    ASSERT_EQ(run({image, low, high, {}, true}), 0) << err_;
    const auto json = nlohmann::json::parse(out_);
    EXPECT_NEAR(json["relmse_floor_free"].get<double>(), -1 / 4.001, 1e-6);
    EXPECT_EQ(json["relmse"].get<double>(), 0); // error to the mean of both references
    ASSERT_EQ(run({image, low, high, {}, false}), 0);
    EXPECT_NE(out_.find("floor-free"), std::string::npos);
}

TEST_F(Compare, ComparesALayer) {
    const fs::path image = write("i.exr", RgbImage(8, 6, Rgb(2)), "primal"),
                   reference = write("r.exr", RgbImage(8, 6));
    EXPECT_EQ(run({image, reference, {}, "primal", false}), 0);
    EXPECT_EQ(run({image, reference, {}, "dz", false}), 2);
    EXPECT_NE(err_.find("primal"), std::string::npos) << err_;
    EXPECT_EQ(run({image, reference, {}, "", false}), 2);
}

TEST_F(Compare, RejectsDifferentSizesAndNamesBoth) {
    const fs::path image = write("i.exr", RgbImage(8, 6)), reference = write("r.exr", RgbImage(9, 6));
    EXPECT_EQ(run({image, reference, {}, {}, false}), 2);
    EXPECT_NE(err_.find("8x6"), std::string::npos) << err_;
    EXPECT_NE(err_.find("9x6"), std::string::npos) << err_;
    EXPECT_EQ(run({image, image, reference, {}, false}), 2);
}

TEST_F(Compare, RejectsMissingFiles) {
    const fs::path image = write("i.exr", RgbImage(8, 6));
    EXPECT_EQ(run({image, folder_ / "none.exr", {}, {}, true}), 2);
    EXPECT_NE(err_.find("none.exr"), std::string::npos);
    EXPECT_EQ(out_, "");
}

} // namespace
} // namespace tessera
