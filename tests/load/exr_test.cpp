#include "render/io/exr.h"
#include "render/io/files.h"
#include "render/io/plain_images.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace tessera {
namespace {

namespace fs = std::filesystem;

/// Gives each test a folder, and deletes it at the end.
class ImageOutput : public testing::Test {
protected:
    ImageOutput() { fs::create_directories(folder_); }
    ~ImageOutput() override { fs::remove_all(folder_); }

    fs::path file(const char* name) const { return folder_ / name; }
    std::size_t files_in_folder() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

private:
    fs::path folder_ = fs::temp_directory_path() / ("tessera-exr-test-" + std::to_string(::getpid()));
};

std::string message_of(const auto& action) {
    try {
        action();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "no exception";
}

bool same_bits(const RgbImage& a, const RgbImage& b) {
    return a.width() == b.width() && a.height() == b.height() &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof(Rgb)) == 0;
}

/// The limit holds with and without a file size, so every image that can be written can be read.
TEST_F(ImageOutput, LimitsTheSizeOfAllImages) {
    const std::pair<std::int64_t, std::int64_t> allowed[] = {{16384, 16384}, {32768, 8192}, {1, 32768}},
                                                too_large[] = {{16385, 16384}, {32768, 32768}, {32769, 1}};
    for (const auto& [width, height] : allowed) {
        EXPECT_NO_THROW(check_image_size(width, height));
        EXPECT_NO_THROW(check_image_size(width, height, std::uintmax_t{1} << 30));
    }
    for (const auto& [width, height] : too_large) {
        EXPECT_THROW(check_image_size(width, height), std::runtime_error);
        EXPECT_THROW(check_image_size(width, height, std::uintmax_t{1} << 30), std::runtime_error);
    }
}

TEST_F(ImageOutput, RejectsPngsOfBadSize) {
    const std::vector<std::uint8_t> pixel(3);
    const std::string message = message_of([&] { write_png(file("a.png"), {32768, 32768}, pixel); });
    EXPECT_NE(message.find("a.png: an image of 32768 by 32768 pixels is too large"), std::string::npos) << message;
    EXPECT_NE(message_of([&] { write_png(file("a.png"), {100, 100}, pixel); }).find("three bytes"),
              std::string::npos);
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(ImageOutput, AttributesAreReadWithoutThePixels) {
    write_exr(file("a.exr"), {{{"", test::random_image(64, 64, 1)}}, {{"kind", "picture"}}});
    fs::resize_file(file("a.exr"), fs::file_size(file("a.exr")) / 2);
    EXPECT_NE(message_of([&] { read_exr(file("a.exr")); }), "no exception");
    EXPECT_EQ(read_exr_attributes(file("a.exr")).at("kind"), "picture");
}

TEST_F(ImageOutput, LayersAndAttributesRoundTripBitExactly) {
    ExrFile written;
    written.layers = {{"", test::random_image(37, 23, 1)},
                      {"primal", test::random_image(37, 23, 2)},
                      {"dx", test::random_image(37, 23, 3)}};
    written.layers[0].image(3, 4) = Rgb(std::numeric_limits<float>::infinity(), 1e38f, 1e-42f);
    written.attributes = {{"tessera:method", "gpr"}, {"empty", ""}};
    write_exr(file("a.exr"), written);
    const ExrFile read = read_exr(file("a.exr"));
    ASSERT_EQ(read.layers.size(), 3u);
    for (const ExrLayer& layer : written.layers) {
        const auto same_name = [&](const ExrLayer& other) { return other.name == layer.name; };
        const auto found = std::find_if(read.layers.begin(), read.layers.end(), same_name);
        ASSERT_NE(found, read.layers.end()) << layer.name;
        EXPECT_TRUE(same_bits(found->image, layer.image)) << layer.name;
    }
    EXPECT_EQ(read.layers.front().name, "");
    EXPECT_EQ(read.attributes.at("tessera:method"), "gpr");
    EXPECT_EQ(read.attributes.at("empty"), "");
    EXPECT_EQ(files_in_folder(), 1u);
}

/// Vector and single-channel layers keep their names and kinds. A single channel is read as grey.
TEST_F(ImageOutput, VectorAndSingleChannelLayersRoundTrip) {
    const RgbImage picture = test::random_image(9, 7, 1), normal = test::random_image(9, 7, 2),
                   numbers = test::random_image(9, 7, 3);
    write_exr(file("a.exr"),
              {{{"", picture}, {"N", normal, ExrChannels::xyz}, {"Z", numbers, ExrChannels::single}}, {}});
    const ExrFile read = read_exr(file("a.exr"));
    ASSERT_EQ(read.layers.size(), 3u);
    EXPECT_EQ(read.layers[1].channels, ExrChannels::xyz);
    EXPECT_TRUE(same_bits(*find_layer(read, "N"), normal));
    EXPECT_EQ(read.layers[2].channels, ExrChannels::single);
    EXPECT_EQ((*find_layer(read, "Z"))(3, 4), Rgb(numbers(3, 4).r));
    EXPECT_EQ(read_exr(file("a.exr"), {}, {"Z"}).layers.size(), 1u);
    write_exr(file("b.exr"), {{{"Z", numbers, ExrChannels::single}}, {}});
    EXPECT_EQ(read_exr(file("b.exr"), {}, {""}).layers.at(0).image(3, 4), Rgb(numbers(3, 4).r));
}

TEST_F(ImageOutput, ReadingReportsProgressAndCanBeCancelled) {
    const RgbImage image = test::random_image(5, 300, 1);
    write_exr(file("a.exr"), {{{"", image}}, {}});
    std::vector<float> fractions;
    const auto watch = [&](float fraction) {
        fractions.push_back(fraction);
        return true;
    };
    EXPECT_TRUE(same_bits(read_exr(file("a.exr"), watch).layers.front().image, image));
    EXPECT_GE(fractions.size(), 3u);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.front(), 0);
    EXPECT_LT(fractions.back(), 1);
    const auto stop = [&](float fraction) { return fraction == 0; };
    EXPECT_NE(message_of([&] { read_exr(file("a.exr"), stop); }).find("a.exr: reading was cancelled"),
              std::string::npos);
}

TEST_F(ImageOutput, ReadsAnImageOfOnePixel) {
    write_exr(file("a.exr"), {{{"", RgbImage(1, 1, Rgb(1, 2, 3))}}, {}});
    EXPECT_EQ(read_exr(file("a.exr")).layers.front().image(0, 0), Rgb(1, 2, 3));
}

TEST_F(ImageOutput, ReplacesAnOlderFile) {
    for (const float value : {1.0f, 2.0f})
        write_exr(file("a.exr"), {{{"", RgbImage(8, 8, Rgb(value))}}, {}});
    EXPECT_EQ(read_exr(file("a.exr")).layers.front().image(7, 7), Rgb(2));
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(ImageOutput, ErrorsNameTruncatedFiles) {
    write_exr(file("a.exr"), {{{"", test::random_image(64, 64, 1)}}, {{"key", "value"}}});
    std::ifstream in(file("a.exr"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    for (const double fraction : {0.0, 0.001, 0.01, 0.02, 0.1, 0.5, 0.99}) {
        std::ofstream(file("b.exr"), std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(fraction * static_cast<double>(bytes.size())));
        const std::string message = message_of([&] { read_exr(file("b.exr")); });
        EXPECT_NE(message.find("b.exr"), std::string::npos) << fraction << ": " << message;
    }
}

TEST_F(ImageOutput, ErrorsNameMissingAndForeignFiles) {
    EXPECT_NE(message_of([&] { read_exr(file("none.exr")); }).find("none.exr"), std::string::npos);
    std::ofstream(file("text.exr")) << "this is no image at all, but it has a few bytes";
    EXPECT_NE(message_of([&] { read_exr(file("text.exr")); }).find("text.exr"), std::string::npos);
}

TEST_F(ImageOutput, ErrorsNameUnwritablePathsAndLeaveNoFile) {
    const RgbImage image(4, 4);
    fs::create_directories(file("taken.exr") / "inside");
    for (const char* name : {"no/such/folder/a.exr", "taken.exr"}) {
        EXPECT_NE(message_of([&] { write_exr(file(name), {{{"", image}}, {}}); }).find(name), std::string::npos);
        EXPECT_NE(message_of([&] { write_png(file(name), image); }).find(name), std::string::npos);
    }
    EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(ImageOutput, RejectsLayersOfDifferentSizesAndNoLayers) {
    EXPECT_THROW(write_exr(file("a.exr"), {{{"", RgbImage(4, 4)}, {"dx", RgbImage(5, 4)}}, {}}),
                 std::runtime_error);
    EXPECT_THROW(write_exr(file("a.exr"), {}), std::runtime_error);
    EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(ImageOutput, WritesACompletePng) {
    write_png(file("a.png"), RgbImage(16, 9, Rgb(0.5f)), 1);
    std::ifstream in(file("a.png"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(bytes.substr(1, 3), "PNG");
    EXPECT_NE(bytes.find("IEND"), std::string::npos);
    EXPECT_EQ(files_in_folder(), 1u);
    EXPECT_THROW(write_png(file("b.png"), RgbImage()), std::runtime_error);
}

TEST(Srgb, CodesOfKnownValues) {
    EXPECT_EQ(srgb_byte(0), 0);
    EXPECT_EQ(srgb_byte(-1), 0);
    EXPECT_EQ(srgb_byte(std::nanf("")), 0);
    EXPECT_EQ(srgb_byte(1), 255);
    EXPECT_EQ(srgb_byte(1e30f), 255);
    EXPECT_EQ(srgb_byte(0.18f), 118);
    EXPECT_EQ(srgb_byte(0.0021f), 7);
}

} // namespace
} // namespace tessera
