// Tests which channels of an OpenEXR file become its picture, and their conversion.
#include "render/io/exr.h"
#include "render/io/picture_file.h"
#include "tests/load/temporary_folder.h"
#include "tests/support/exr_writer.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <ImathMatrix.h>
#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Values = std::vector<std::pair<std::string, float>>;

struct ExrChannelNames : testing::Test {
    /// Writes a file of parts with constant channels.
    fs::path write(const std::vector<std::pair<std::string, Values>>& parts) const {
        std::vector<ExrTestPart> written;
        for (const auto& [name, values] : parts)
            written.push_back({constant_channels(values), name});
        write_test_exr(file, written);
        return file;
    }
    fs::path write(const Values& values) const { return write({{"", values}}); }
    /// Returns the reason why a file's picture cannot be read.
    std::string refusal(const std::string& layer = "") const {
        try {
            read_picture(file, layer);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "no error";
    }
    Rgb pixel(const std::string& layer = "") const { return read_picture(file, layer).image(3, 2); }

    TemporaryFolder folder;
    fs::path file = folder.path() / "a.exr";
};

TEST_F(ExrChannelNames, OfAColourMayBeSpelledInSeveralWays) {
    for (const Values& names : {Values{{"R", 1}, {"G", 2}, {"B", 3}, {"A", 9}},
                                {{"r", 1}, {"g", 2}, {"b", 3}},
                                {{".R", 1}, {".G", 2}, {".B", 3}},
                                {{"red", 1}, {"green", 2}, {"blue", 3}},
                                {{".r", 1}, {".g", 2}, {".b", 3}, {".a", 9}}}) {
        write(names);
        EXPECT_EQ(pixel(), Rgb(1, 2, 3)) << names[0].first;
        EXPECT_THAT(read_picture(file).notes, IsEmpty()) << names[0].first;
        EXPECT_EQ(read_exr(file, {}, {""}).layers.front().image(3, 2), Rgb(1, 2, 3)) << names[0].first;
    }
}

TEST_F(ExrChannelNames, WithoutALayerNameComeFirst) {
    write({{"R", 1}, {"G", 2}, {"B", 3}, {"albedo.R", 4}, {"albedo.G", 5}, {"albedo.B", 6}, {"Z", 7}});
    EXPECT_EQ(pixel(), Rgb(1, 2, 3));
    EXPECT_EQ(pixel("albedo"), Rgb(4, 5, 6));
    EXPECT_EQ(pixel("Z"), Rgb(7));
    EXPECT_EQ(pixel("albedo.G"), Rgb(5)) << "one channel as grey";
    EXPECT_THAT(refusal("diffuse"),
                HasSubstr("it has no layer \"diffuse\"; its channels are B, G, R, Z, albedo.B"));
}

TEST_F(ExrChannelNames, OfTheOnlyLayerAreUsedWithANote) {
    write({{"ViewLayer.Combined.R", 1},
           {"ViewLayer.Combined.G", 2},
           {"ViewLayer.Combined.B", 3},
           {"ViewLayer.Combined.A", 9},
           {"ViewLayer.Depth.Z", 7}});
    EXPECT_EQ(pixel(), Rgb(1, 2, 3));
    EXPECT_THAT(read_picture(file).notes, ElementsAre("its layer \"ViewLayer.Combined\" is used"));
    EXPECT_EQ(pixel("ViewLayer.Depth.Z"), Rgb(7));
}

TEST_F(ExrChannelNames, OfSeveralLayersMustBeChosen) {
    write({{"a.R", 1}, {"a.G", 2}, {"a.B", 3}, {"b.R", 4}, {"b.G", 5}, {"b.B", 6}});
    EXPECT_THAT(refusal(),
                HasSubstr("it has several pictures (\"a\", \"b\"), and one must be chosen; its channels "
                          "are a.B, a.G, a.R, b.B, b.G, b.R"));
    EXPECT_EQ(pixel("b"), Rgb(4, 5, 6));
    write({{"Beauty.R", 1}, {"Beauty.G", 2}, {"Beauty.B", 3}, {"b.R", 4}, {"b.G", 5}, {"b.B", 6}});
    EXPECT_EQ(pixel(), Rgb(1, 2, 3));
}

/// A missing channel is never replaced by 0, and Y alone is no picture beside X or RY.
TEST_F(ExrChannelNames, ThatAreNotAWholeColourAreRefused) {
    for (const Values& names : {Values{{"R", 1}, {"G", 2}},
                                {{"Y", 1}, {"RY", 0}},
                                {{"X", 1}, {"Y", 1}},
                                {{"R", 1}, {"Z", 2}},
                                {{"nn.X", 1}, {"nn.Y", 2}, {"nn.Z", 3}}}) {
        write(names);
        EXPECT_THAT(refusal(), HasSubstr("it has no picture with red, green and blue")) << names[0].first;
        EXPECT_THAT(refusal(), testing::ContainsRegex("its channels are .*" + names.back().first))
            << names[0].first;
    }
}

TEST_F(ExrChannelNames, OfALoneNumberAreGrey) {
    for (const std::string name : {"Y", "V", "R", "depth.Z"}) {
        write({{name, 0.25f}, {"A", 1}});
        EXPECT_EQ(pixel(), Rgb(0.25f)) << name;
    }
    write({{"Y", 0.25f}, {"Z", 3}}); // with a depth
    EXPECT_EQ(pixel(), Rgb(0.25f));
    EXPECT_EQ(pixel("Z"), Rgb(3));
}

TEST_F(ExrChannelNames, AreTakenFromThePartWithColour) {
    write({{"depth", {{"Z", 9}}},
           {"beauty", {{"R", 1}, {"G", 2}, {"B", 3}}},
           {"N", {{"X", 4}, {"Y", 5}, {"Z", 6}}}});
    EXPECT_EQ(pixel(), Rgb(1, 2, 3));
    EXPECT_THAT(read_picture(file).notes, ElementsAre("its part 1 \"beauty\" is used"));
    EXPECT_EQ(pixel("depth"), Rgb(9));
    EXPECT_EQ(pixel("0:Z"), Rgb(9));
    EXPECT_EQ(pixel("N"), Rgb(4, 5, 6)) << "a vector is not converted";
    EXPECT_EQ(pixel("beauty:G"), Rgb(2));
    EXPECT_THAT(refusal("Q"), HasSubstr("part \"depth\": Z; part \"beauty\": B, G, R; part \"N\": X, Y, Z"));
}

TEST_F(ExrChannelNames, OfSeveralPartsMustBeChosen) {
    write({{"left", {{"R", 1}, {"G", 2}, {"B", 3}}}, {"right", {{"R", 4}, {"G", 5}, {"B", 6}, {"d.R", 7}}}});
    EXPECT_THAT(refusal(), HasSubstr("it has several pictures (\"left\", \"right\")"));
    EXPECT_EQ(pixel("right"), Rgb(4, 5, 6));
    EXPECT_EQ(pixel("1"), Rgb(4, 5, 6));
    EXPECT_EQ(pixel("right:d.R"), Rgb(7));
}

TEST_F(ExrChannelNames, XyzIsConverted) {
    write({{"X", 0.9505f}, {"Y", 1}, {"Z", 1.089f}}); // white of D65
    const Rgb white = pixel();
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(white[c], 1, 2e-3);
    write({{"X", 0.4124f}, {"Y", 0.2126f}, {"Z", 0.0193f}}); // red of sRGB
    EXPECT_NEAR(pixel().r, 1, 2e-3);
    EXPECT_NEAR(pixel().g, 0, 2e-3);
    EXPECT_THAT(read_picture(file).notes, ElementsAre(HasSubstr("X, Y and Z are converted")));
}

/// The colour (0.2, 0.4, 0.6) as luminance and differences of Rec. 709, with chroma at every second pixel.
TEST_F(ExrChannelNames, LuminanceAndChromaAreConverted) {
    const float r = 0.2f, g = 0.4f, b = 0.6f, y = 0.2126f * r + 0.7152f * g + 0.0722f * b;
    const auto constant = [](float value) { return [value](int, int) { return value; }; };
    write_test_exr(file,
                   {{{{"Y", constant(y)}, {"RY", constant((r - y) / y), 2}, {"BY", constant((b - y) / y), 2}}}});
    const Rgb c = pixel();
    EXPECT_NEAR(c.r, r, 1e-3);
    EXPECT_NEAR(c.g, g, 1e-3);
    EXPECT_NEAR(c.b, b, 1e-3);
    // Chroma that rises linearly keeps its slope between the samples, also in a window that does not begin at 0.
    write_test_exr(file, {{{{"Y", constant(1)},
                            {"RY", [](int x, int) { return 0.1f * static_cast<float>(x); }, 2},
                            {"BY", constant(0), 2}},
                           "",
                           {{2, 4}, {9, 9}},
                           {{0, 0}, {9, 9}}}});
    const RgbImage image = read_picture(file).image;
    EXPECT_NEAR(image(0, 0).r, 1.2f, 1e-5);
    EXPECT_NEAR(image(3, 3).r, 1.5f, 1e-5);
}

/// White stays white, and red has the values of the matrix that is published for these primaries.
TEST_F(ExrChannelNames, OtherPrimariesAreConverted) {
    const Imf::Chromaticities acescg({0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f}, {0.32168f, 0.33767f});
    write_test_exr(
        file,
        {{constant_channels({{"R", 1}, {"G", 1}, {"B", 1}}), "", {{0, 0}, {7, 5}}, {{0, 0}, {7, 5}}, &acescg}});
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel()[c], 1, 1e-3);
    EXPECT_THAT(read_picture(file).notes, ElementsAre(HasSubstr("primaries in its header")));
    write_test_exr(
        file,
        {{constant_channels({{"R", 1}, {"G", 0}, {"B", 0}}), "", {{0, 0}, {7, 5}}, {{0, 0}, {7, 5}}, &acescg}});
    const Rgb red = pixel(); // first column of AP1 to sRGB with Bradford adaptation
    EXPECT_NEAR(red.r, 1.70505, 2e-3);
    EXPECT_NEAR(red.g, -0.13026, 2e-3);
    EXPECT_NEAR(red.b, -0.02400, 2e-3);
    const Imf::Chromaticities on_a_line({0.1f, 0.1f}, {0.2f, 0.2f}, {0.3f, 0.3f}, {0.3127f, 0.329f});
    write_test_exr(
        file,
        {{constant_channels({{"R", 1}, {"G", 0}, {"B", 0}}), "", {{0, 0}, {7, 5}}, {{0, 0}, {7, 5}}, &on_a_line}});
    EXPECT_THAT(refusal(), HasSubstr("chromaticities in its header span no colours"));
}

TEST_F(ExrChannelNames, XyzIsThePictureBesideNamedLayers) {
    write(Values{{"X", 0.9505f}, {"Y", 1}, {"Z", 1.089f}, {"primal.R", 5}, {"primal.G", 6}, {"primal.B", 7}});
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel()[c], 1, 1e-3);
}

/// R, G and B with the primaries of CIE XYZ are X, Y and Z, whatever the white in the header.
TEST_F(ExrChannelNames, WithPrimariesOfXyzAreXyz) {
    write(Values{{"X", 0.28f}, {"Y", 0.29f}, {"Z", 0.51f}});
    const Rgb expected = pixel();
    for (const Imath::V2f& white : {Imath::V2f(0.31271f, 0.32902f), Imath::V2f(1 / 3.0f, 1 / 3.0f)}) {
        const Imf::Chromaticities xyz({1, 0}, {0, 1}, {0, 0}, white);
        write_test_exr(file, {{constant_channels({{"R", 0.28f}, {"G", 0.29f}, {"B", 0.51f}}),
                               "",
                               {{0, 0}, {7, 5}},
                               {{0, 0}, {7, 5}},
                               &xyz}});
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(pixel()[c], expected[c], 1e-3) << white;
    }
}

TEST_F(ExrChannelNames, OfADeepImageAreNotSupported) {
    Imf::Header header(4, 4);
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::ZIPS_COMPRESSION;
    {
        const Imf::DeepScanLineOutputFile deep(file.c_str(), header);
    }
    EXPECT_THAT(refusal(), HasSubstr("deep images are not supported"));
    EXPECT_THAT(refusal("R"), HasSubstr("deep images are not supported"));
}

TEST_F(ExrChannelNames, WindowsAreRead) {
    write_test_exr(file, {{{{"R", [](int x, int y) { return static_cast<float>(10 * x + y); }},
                            {"G", [](int, int) { return 0.0f; }},
                            {"B", [](int, int) { return 0.0f; }}},
                           "",
                           {{-2, 1}, {5, 4}},
                           {{0, 0}, {9, 7}}}});
    const Picture picture = read_picture(file);
    EXPECT_EQ(picture.data, (PixelRect{-2, 1, 6, 5}));
    EXPECT_EQ(picture.display, (PixelRect{0, 0, 10, 8}));
    EXPECT_EQ(picture.image(0, 0).r, -19);
    EXPECT_EQ(picture.image(7, 3).r, 54);
}

} // namespace
} // namespace tessera::test
