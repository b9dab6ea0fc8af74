#include "render/io/plain_images.h"
#include "tests/load/pfm_bytes.h"
#include "tests/load/temporary_folder.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

class Pfm : public testing::Test {
protected:
    std::string error_of(const std::string& bytes) const {
        try {
            read_pfm(folder.write("a.pfm", bytes));
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "no error";
    }

    TemporaryFolder folder;
};

TEST_F(Pfm, ReadsBothByteOrdersBitExactly) {
    const RgbImage image = test::random_image(7, 5, 1);
    for (const bool is_little_endian : {false, true}) {
        const RgbImage read = read_pfm(folder.write("a.pfm", pfm_bytes(image, 3, is_little_endian)));
        ASSERT_EQ(read.width(), 7);
        ASSERT_EQ(read.height(), 5);
        EXPECT_TRUE(std::equal(read.begin(), read.end(), image.begin())) << is_little_endian;
    }
}

TEST_F(Pfm, ReadsGreyAsRgb) {
    const RgbImage image = test::random_image(4, 3, 2);
    const RgbImage read = parse_pfm(pfm_bytes(image, 1));
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x)
            EXPECT_EQ(read(x, y), Rgb(image(x, y).r));
}

// The bytes are literal, independent of the writer: 1, 2 in the lower row, 3, 4 in the upper row.
TEST_F(Pfm, RowsGoFromTheBottomUp) {
    using std::string_literals::operator""s;
    const std::string pixels = "\x3f\x80\0\0\x40\0\0\0\x40\x40\0\0\x40\x80\0\0"s;
    for (const std::string header : {"Pf\n2 2\n1.0\n", "Pf 2 2 1 ", "Pf\r\n2 2\r\n0.5\r\n", "Pf\n2\n2\n+1e0\n"}) {
        const RgbImage read = parse_pfm(header + pixels);
        EXPECT_EQ(read(0, 1), Rgb(1)) << header;
        EXPECT_EQ(read(1, 1), Rgb(2)) << header;
        EXPECT_EQ(read(0, 0), Rgb(3)) << header;
        EXPECT_EQ(read(1, 0), Rgb(4)) << header;
    }
}

// The header ends at one white-space character, even if the first pixel begins with another.
TEST_F(Pfm, PixelsMayLookLikeWhiteSpace) {
    const std::string pixels = "\n\r\t ";
    EXPECT_GT(parse_pfm("Pf\n1 1\n1\n" + pixels)(0, 0).r, 0);
    EXPECT_GT(parse_pfm("Pf\n1 1\n-1\n" + pixels)(0, 0).r, 0);
}

TEST_F(Pfm, KeepsNonFinitePixels) {
    const RgbImage read = parse_pfm(pfm_bytes(RgbImage(1, 1, Rgb(NAN, INFINITY, 1))));
    EXPECT_TRUE(std::isnan(read(0, 0).r));
    EXPECT_TRUE(std::isinf(read(0, 0).g));
}

TEST_F(Pfm, ErrorsNameFilesWithMalformedHeaders) {
    const std::string pixels(48, 'x'); // 2 x 2 pixels of three channels
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "not a PFM file"},
        {"P6\n2 2\n255\n", "not a PFM file"},
        {"PF", "ends within its header"},
        {"PF\n2 2", "ends within its header"},
        {"PF4\n2 2\n-1\n" + pixels, "'PF4'"},
        {"PF\nwide 2\n-1\n" + pixels, "width is not a number: 'wide'"},
        {"PF\n2 2x\n-1\n" + pixels, "height is not a number: '2x'"},
        {"PF\n2.5 2\n-1\n" + pixels, "width is not a whole number"},
        {"PF\n0 2\n-1\n" + pixels, "0 by 2 pixels"},
        {"PF\n2 -2\n-1\n" + pixels, "2 by -2 pixels"},
        {"PF\n1000000 1000000\n-1\n" + pixels, "too large"},
        {"PF\n1e300 1e300\n-1\n" + pixels, "too large"},
        {"PF\n16000 16000\n-1\n" + pixels, "too short"},
        {"PF\n2 2\n0\n" + pixels, "scale is 0"},
        {"PF\n2 2\nnan\n" + pixels, "scale is not a number"},
        {"PF\n2 3\n-1\n" + pixels, "48 bytes of pixels, not the 72 of 2 by 3"},
        {"PF\n2 2\n-1\n" + pixels + "x", "49 bytes of pixels, not the 48"},
    };
    for (const auto& [bytes, expected] : cases) {
        const std::string message = error_of(bytes);
        EXPECT_NE(message.find(expected), std::string::npos) << bytes << ": " << message;
        EXPECT_NE(message.find("a.pfm"), std::string::npos) << message;
    }
}

TEST_F(Pfm, RejectsEveryTruncation) {
    const std::string bytes = pfm_bytes(test::random_image(3, 2, 1));
    for (std::size_t length = 0; length < bytes.size(); ++length)
        EXPECT_NE(error_of(bytes.substr(0, length)).find("a.pfm"), std::string::npos) << length;
    EXPECT_EQ(error_of(bytes), "no error");
}

TEST_F(Pfm, ErrorsNameMissingFilesAndFolders) {
    std::filesystem::create_directories(folder.path() / "b.pfm");
    for (const char* name : {"none.pfm", "b.pfm"}) {
        try {
            read_pfm(folder.path() / name);
            ADD_FAILURE() << name;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
    }
}

} // namespace
} // namespace tessera
