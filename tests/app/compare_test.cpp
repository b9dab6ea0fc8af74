#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "render/io/exr.h"
#include "render/io/picture_file.h"
#include "render/io/plain_images.h"
#include "render/run/reference_image.h"
#include "tests/recon/test_images.h"
#include "tests/support/exr_writer.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace tessera {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

class Compare : public testing::Test {
protected:
    Compare() { fs::create_directories(folder_); }
    ~Compare() override { fs::remove_all(folder_); }

    fs::path write(const char* name, const RgbImage& image, const char* layer = "") const {
        write_exr(folder_ / name, {{{layer, image}}, {}});
        return folder_ / name;
    }

    static CompareOptions options_of(const std::vector<fs::path>& images, const fs::path& reference,
                                     ComparisonFormat format = ComparisonFormat::text,
                                     const fs::path& reference2 = {}) {
        CompareOptions options;
        options.images = images;
        options.reference = reference;
        options.reference2 = reference2;
        options.format = format;
        return options;
    }
    static CompareOptions json_of(const fs::path& image, const fs::path& reference) {
        return options_of({image}, reference, ComparisonFormat::json);
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
    ASSERT_EQ(run(json_of(image, reference)), 0) << err_;
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
    ASSERT_EQ(run(json_of(file, reference)), 0) << err_;
    EXPECT_DOUBLE_EQ(nlohmann::json::parse(out_)["share_without_light"].get<double>(), 2.0 / 48);
}

TEST_F(Compare, AReferenceWithHalvesGivesTheFloorFreeError) {
    const fs::path image = write("i.exr", RgbImage(8, 6, Rgb(2))), reference = folder_ / "r.exr";
    const RgbImage low(8, 6, Rgb(1)), high(8, 6, Rgb(3));
    write_reference(reference, {mean_of(low, high), {low, high}, {1, 2}, ""});
    ASSERT_EQ(run(json_of(image, reference)), 0) << err_;
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
    CompareOptions options = json_of(image, reference);
    options.tile = 4;
    ASSERT_EQ(run(options), 0) << err_;
    EXPECT_GT(nlohmann::json::parse(out_)["tiles"]["edge_ratio"], 1000);
    options.format = ComparisonFormat::text;
    ASSERT_EQ(run(options), 0);
    EXPECT_NE(out_.find("tiles, in edges"), std::string::npos);
    options.tile = 16;
    EXPECT_EQ(run(options), 2) << "too few tiles";
    ASSERT_EQ(run(json_of(image, reference)), 0);
    EXPECT_FALSE(nlohmann::json::parse(out_).contains("tiles"));
}

TEST_F(Compare, TwoReferencesGiveTheFloorFreeError) {
    const fs::path image = write("i.exr", RgbImage(8, 6, Rgb(2))), low = write("a.exr", RgbImage(8, 6, Rgb(1))),
                   high = write("b.exr", RgbImage(8, 6, Rgb(3)));
    ASSERT_EQ(run(options_of({image}, low, ComparisonFormat::json, high)), 0) << err_;
    const auto json = nlohmann::json::parse(out_);
    EXPECT_NEAR(json["relmse_floor_free"].get<double>(), -1 / 4.001, 1e-6);
    EXPECT_EQ(json["relmse"].get<double>(), 0); // error to the mean of both references
    ASSERT_EQ(run(options_of({image}, low, ComparisonFormat::text, high)), 0);
    EXPECT_NE(out_.find("floor-free"), std::string::npos);
}

TEST_F(Compare, ComparesALayer) {
    const RgbImage bright(8, 6, Rgb(2)), dark(8, 6, Rgb(1));
    const fs::path image = folder_ / "i.exr", reference = write("r.exr", dark);
    write_exr(image, {{{"a", bright}, {"b", dark}}, {}});
    const auto mse = [&](const std::string& layer, const std::string& reference_layer) {
        CompareOptions options = json_of(image, reference_layer.empty() ? reference : image);
        options.layer = layer;
        options.reference_layer = reference_layer;
        const int code = run(options);
        return code == 0 ? nlohmann::json::parse(out_)["mse"].get<double>() : -1;
    };
    EXPECT_NEAR(mse("a", ""), 1, 1e-12);
    EXPECT_EQ(mse("b", ""), 0);
    EXPECT_NEAR(mse("b", "a"), 1, 1e-12);
    EXPECT_EQ(mse("dz", ""), -1);
    EXPECT_THAT(err_, HasSubstr("i.exr: it has no layer \"dz\"; its channels are a.B, a.G"));
    EXPECT_THAT(err_, HasSubstr("with --layer\n"));
    EXPECT_EQ(mse("", ""), -1) << "two layers to choose from";
    EXPECT_EQ(mse("a", "c"), -1);
    EXPECT_THAT(err_, HasSubstr("with --reference-layer\n"));
}

TEST_F(Compare, RejectsDifferentSizesAndNamesBoth) {
    const fs::path image = write("i.exr", RgbImage(8, 6)), reference = write("r.exr", RgbImage(9, 6));
    EXPECT_EQ(run(options_of({image}, reference)), 2);
    EXPECT_NE(err_.find("8x6"), std::string::npos) << err_;
    EXPECT_NE(err_.find("9x6"), std::string::npos) << err_;
    EXPECT_EQ(run(options_of({image}, image, ComparisonFormat::text, reference)), 2);
}

TEST_F(Compare, RejectsMissingFiles) {
    const fs::path image = write("i.exr", RgbImage(8, 6));
    EXPECT_EQ(run(json_of(image, folder_ / "none.exr")), 2);
    EXPECT_NE(err_.find("none.exr"), std::string::npos);
    EXPECT_EQ(out_, "");
}

TEST_F(Compare, EqualPicturesHaveAnInfinitePsnr) {
    const fs::path image = write("i.exr", test::random_image(8, 6, 1));
    ASSERT_EQ(run(options_of({image}, image)), 0) << err_;
    EXPECT_THAT(out_, HasSubstr("PSNR                 inf dB"));
    ASSERT_EQ(run(json_of(image, image)), 0);
    EXPECT_EQ(nlohmann::json::parse(out_)["psnr"], "inf");
}

/// Errors are means over the other pixels, whether the picture or the reference has invalid ones.
TEST_F(Compare, LeavesOutInvalidPixels) {
    RgbImage bad(32, 24, Rgb(3));
    bad(1, 2).g = std::numeric_limits<float>::quiet_NaN();
    bad(5, 4).r = std::numeric_limits<float>::infinity();
    RgbImage bad_reference(32, 24, Rgb(2));
    bad_reference(7, 7).b = -std::numeric_limits<float>::infinity();
    const fs::path image = write("i.exr", bad), reference = write("r.exr", bad_reference);
    ASSERT_EQ(run(json_of(image, reference)), 0) << err_;
    const auto json = nlohmann::json::parse(out_);
    EXPECT_EQ(json["bad_pixels"], 2);
    EXPECT_EQ(json["left_out_pixels"], 3);
    EXPECT_NEAR(json["mse"].get<double>(), 1, 1e-9);
    EXPECT_NEAR(json["relmse"].get<double>(), 1 / 4.001, 1e-9);
    EXPECT_NEAR(json["mean_ratio"].get<double>(), 1.5, 1e-9);
    EXPECT_EQ(json["psnr"], "inf") << "both are white on a screen";
    EXPECT_EQ(json["flip"], 0);
    EXPECT_THAT(err_, HasSubstr("warning: " + image.string() + ": 3 of 768 pixels are left out"));
    ASSERT_EQ(
        run(options_of({image}, reference, ComparisonFormat::text, write("s.exr", RgbImage(32, 24, Rgb(2))))), 0);
    EXPECT_THAT(out_, HasSubstr("pixels not finite    3 of 768"));
    EXPECT_THAT(out_, HasSubstr("relMSE, floor-free   0.249938 +-"));
    const fs::path nothing = write("n.exr", RgbImage(4, 4, Rgb(std::nanf(""))));
    EXPECT_EQ(run(options_of({nothing}, nothing)), 2);
    EXPECT_THAT(err_, HasSubstr("no pixel is finite"));
}

/// Crops hold x + 100 y at each pixel (x, y) of the display window, so that any shift shows.
class CompareWindows : public Compare {
protected:
    fs::path crop(const char* name, Imath::Box2i data, Imath::Box2i display = {{0, 0}, {39, 29}}) const {
        std::vector<test::ExrTestChannel> channels;
        for (const char* channel : {"R", "G", "B"})
            channels.push_back({channel, [](int x, int y) { return static_cast<float>(x + 100 * y); }});
        test::write_test_exr(folder_ / name, {{channels, "", data, display}});
        return folder_ / name;
    }
};

TEST_F(CompareWindows, CropsAreComparedWhereTheyOverlap) {
    const fs::path a = crop("a.exr", {{0, 0}, {19, 14}}), b = crop("b.exr", {{10, 5}, {39, 24}}),
                   whole = crop("w.exr", {{0, 0}, {39, 29}});
    ASSERT_EQ(run(json_of(a, b)), 0) << err_;
    EXPECT_EQ(nlohmann::json::parse(out_)["mse"], 0);
    EXPECT_EQ(nlohmann::json::parse(out_)["pixels"], 100);
    EXPECT_THAT(err_,
                HasSubstr("a.exr: compared where the pictures overlap: 10x10 pixels from (10, 5) of its 20x15"));
    ASSERT_EQ(run(json_of(whole, b)), 0) << err_;
    EXPECT_EQ(nlohmann::json::parse(out_)["mse"], 0);
    EXPECT_EQ(nlohmann::json::parse(out_)["pixels"], 600);
}

TEST_F(CompareWindows, OverscanIsCut) {
    const fs::path wide = crop("o.exr", {{-5, -3}, {44, 33}}), whole = crop("w.exr", {{0, 0}, {39, 29}});
    ASSERT_EQ(run(json_of(wide, whole)), 0) << err_;
    EXPECT_EQ(nlohmann::json::parse(out_)["mse"], 0);
    EXPECT_EQ(nlohmann::json::parse(out_)["pixels"], 1200);
    EXPECT_THAT(err_, HasSubstr("outside its display window are cut: 40x30 of 50x37 remain"));
}

TEST_F(CompareWindows, CropsWithoutOverlapAreAnError) {
    const fs::path a = crop("a.exr", {{0, 0}, {9, 9}}), b = crop("b.exr", {{10, 0}, {19, 9}});
    EXPECT_EQ(run(options_of({a}, b)), 2);
    EXPECT_THAT(err_, HasSubstr("do not overlap: " + a.string() + " has 10x10 pixels from (0, 0)"));
}

/// A picture of linear values v is the same as PNG, Radiance, PFM and EXR, up to the formats' rounding.
TEST_F(Compare, ReadsAllFormats) {
    const RgbImage picture(16, 8, Rgb(0.25f, 0.5f, 0.125f));
    const fs::path exr = write("p.exr", picture), png = folder_ / "p.png", hdr = folder_ / "p.hdr",
                   pfm = folder_ / "p.pfm";
    write_png(png, picture);
    std::ofstream radiance(hdr, std::ios::binary), map(pfm, std::ios::binary);
    radiance << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n";
    map << "PF\n16 8\n-1\n";
    for (const Rgb& pixel : picture) {
        radiance << "\x40\x80\x20\x80"; // mantissas of 1/256 and the exponent of 1
        map.write(reinterpret_cast<const char*>(&pixel), sizeof pixel);
    }
    radiance.close();
    map.close();
    ASSERT_EQ(run(options_of({exr, png, hdr, pfm}, pfm, ComparisonFormat::json)), 0) << err_;
    const auto json = nlohmann::json::parse(out_);
    ASSERT_EQ(json.size(), 4u);
    for (const auto& errors : json)
        EXPECT_LT(errors["mse"].get<double>(), 1e-5) << errors;
    EXPECT_EQ(json[0]["mse"], 0);
    EXPECT_GT(json[1]["mse"].get<double>(), 0) << "a PNG has 8 bits";
    EXPECT_EQ(json[2]["mse"], 0);
    ASSERT_EQ(run(json_of(exr, png)), 0) << err_;
}

TEST_F(Compare, PrintsATableOfSeveralPictures) {
    const fs::path reference = write("r.exr", RgbImage(8, 6, Rgb(2))), a = write("a.exr", RgbImage(8, 6, Rgb(3))),
                   b = write("b.exr", RgbImage(8, 6, Rgb(4)));
    CompareOptions options = options_of({a, folder_ / "none.exr", b}, reference);
    EXPECT_EQ(run(options), 2) << "one file cannot be read";
    EXPECT_THAT(err_, HasSubstr("none.exr"));
    EXPECT_THAT(out_, HasSubstr("a.exr"));
    EXPECT_THAT(out_, HasSubstr("b.exr"));
    EXPECT_THAT(out_, HasSubstr("mean ratio"));
    options.format = ComparisonFormat::csv;
    run(options);
    std::istringstream lines(out_);
    std::string names, first, second, more;
    std::getline(lines, names);
    std::getline(lines, first);
    std::getline(lines, second);
    EXPECT_THAT(names, StartsWith("image,layer,reference,reference2,relmse,relmse_trimmed,mse,"));
    EXPECT_THAT(first, HasSubstr("a.exr,,"));
    EXPECT_THAT(first, HasSubstr(",1,0.4975")); // MSE, MAPE = 1 / 2.01
    EXPECT_THAT(second, HasSubstr(",4,0.9950"));
    EXPECT_FALSE(std::getline(lines, more));
}

TEST_F(Compare, WritesErrorMaps) {
    RgbImage image(8, 6, Rgb(2));
    image(3, 2) = Rgb(1, 2, 2);
    image(4, 2).r = std::numeric_limits<float>::quiet_NaN();
    const fs::path a = write("a.exr", image), reference = write("r.exr", RgbImage(8, 6, Rgb(2)));
    CompareOptions options = options_of({a}, reference);
    for (const char* kind : {"squared", "relative", "flip", "difference"})
        for (const char* extension : {".exr", ".png"})
            options.maps.push_back(parse_map(fmt::format("{}={}", kind, (folder_ / kind).string() + extension)));
    ASSERT_EQ(run(options), 0) << err_;
    const auto map = [&](const char* name) { return read_picture(folder_ / name).image; };
    EXPECT_NEAR(map("squared.exr")(3, 2).g, 1.0 / 3, 1e-6);
    EXPECT_EQ(map("squared.exr")(2, 2), Rgb(0));
    EXPECT_TRUE(std::isnan(map("squared.exr")(4, 2).r));
    EXPECT_NEAR(map("relative.exr")(3, 2).r, 1 / 4.001 / 3, 1e-6);
    EXPECT_EQ(map("difference.exr")(3, 2), Rgb(-1, 0, 0));
    EXPECT_EQ(map("flip.exr").width(), 8);
    EXPECT_NEAR(map("difference.png")(3, 2).r, 0, 1e-3);
    EXPECT_NEAR(map("difference.png")(0, 0).r, srgb_to_linear(128 / 255.0f), 1e-3);
    EXPECT_GT(luminance(map("squared.png")(3, 2)), 2 * luminance(map("squared.png")(0, 0)));
    options.images = {a, reference};
    options.maps.resize(1);
    ASSERT_EQ(run(options), 0) << err_;
    EXPECT_TRUE(fs::exists(folder_ / "squared-2.exr"));
    EXPECT_EQ(map("squared-2.exr")(3, 2), Rgb(0));
    EXPECT_THROW(parse_map("flap=a.png"), BadInput);
    EXPECT_THROW(parse_map("flip=a.jpg"), BadInput);
    EXPECT_THROW(parse_map("flip"), BadInput);
}

/// Files that other programs wrote: the same noisy picture in several layouts, and the reference in others.
TEST_F(Compare, ReadsFilesOfOtherPrograms) {
    const fs::path folder = fs::path(TESSERA_SHARED_DIR) / "bugs";
    if (!fs::exists(folder / "exr_reference.exr"))
        GTEST_SKIP() << "there are no files in " << folder;
    const auto relative_mse = [&](const std::string& name) {
        EXPECT_EQ(run(json_of(folder / name, folder / "exr_reference.exr")), 0) << err_;
        return nlohmann::json::parse(out_)["relmse"].get<double>();
    };
    const double noise = relative_mse("exr_aov_layers.exr");
    EXPECT_GT(noise, 0.005);
    for (const char* name : {"exr_lowercase_rgb.exr", "exr_vray_dot_channels.exr", "exr_layers_only.exr",
                             "exr_multipart_rgb_second.exr", "x_dot.exr"})
        EXPECT_DOUBLE_EQ(relative_mse(name), noise) << name;
    EXPECT_NEAR(relative_mse("picture.png"), noise, 0.01 * noise);
    EXPECT_LT(relative_mse("exr_xyz_channels.exr"), 1e-6);
    EXPECT_LT(relative_mse("exr_luminance_chroma.exr"), 1e-3);
    ASSERT_EQ(run(json_of(folder / "exr_crop_a.exr", folder / "exr_crop_b.exr")), 0) << err_;
    EXPECT_EQ(nlohmann::json::parse(out_)["psnr"], "inf");
    EXPECT_EQ(nlohmann::json::parse(out_)["pixels"], 30 * 19);
}

TEST_F(Compare, TakesTheReferenceFromOptionOrPosition) {
    CompareArguments words;
    words.files = {"a.exr", "b.exr"};
    EXPECT_EQ(parse_compare(words).reference, "b.exr");
    EXPECT_EQ(parse_compare(words).images, std::vector<fs::path>{"a.exr"});
    words.files.emplace_back("c.exr");
    EXPECT_EQ(parse_compare(words).reference2, "c.exr");
    words.files.emplace_back("d.exr");
    EXPECT_THROW(parse_compare(words), BadInput);
    words.options.reference = "r.exr";
    EXPECT_EQ(parse_compare(words).images.size(), 4u);
    words.files.resize(1);
    EXPECT_EQ(parse_compare(words).reference, "r.exr");
    words.options.reference.clear();
    EXPECT_THROW(parse_compare(words), BadInput);
}

} // namespace
} // namespace tessera
