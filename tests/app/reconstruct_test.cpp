// `tessera reconstruct`: reconstructs saved buffers of this program and of others.
#include "render/io/exr.h"
#include "tests/app/program.h"
#include "tests/load/pfm_bytes.h"
#include "tests/load/temporary_folder.h"
#include "tests/recon/test_images.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;

/// Returns the first `width` columns and `height` rows of the image.
RgbImage cut(const RgbImage& image, int width, int height) {
    RgbImage result(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            result(x, y) = image(x, y);
    return result;
}

bool same_pixels(const RgbImage& a, const RgbImage& b) {
    return a.width() == b.width() && std::equal(a.begin(), a.end(), b.begin(), b.end());
}

class Reconstruct : public testing::Test {
protected:
    fs::path file(const std::string& name) const { return folder.path() / name; }
    fs::path write(const std::string& name, const RgbImage& contents) const {
        return folder.write(name, pfm_bytes(contents));
    }
    Outcome reconstruct(const std::string& arguments) const {
        return run(folder.path(), "reconstruct " + arguments);
    }

    /// Runs the command and returns the plain RGB of out.exr.
    RgbImage result_of(const std::string& arguments) const {
        fs::remove(file("out.exr"));
        const Outcome o = reconstruct(arguments + " -o out.exr");
        EXPECT_EQ(o.exit_code, 0) << arguments << "\n" << o.output;
        return o.exit_code == 0 ? *find_layer(read_exr(file("out.exr")), "") : RgbImage(width, height);
    }

    static constexpr int width = 13, height = 9;
    TemporaryFolder folder;
    // With exact gradients, any norm and alpha reproduce the image.
    const RgbImage image = random_image(width, height, 1, 3);
    const RgbImage dx = x_differences(image), dy = y_differences(image);
};

TEST_F(Reconstruct, MatchesTheRenderFromItsBuffers) {
    fs::copy_file(fs::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml", file("box.xml"));
    const Outcome render = run(folder.path(), "render box.xml -m gpr --size 40x30 --spp 2 --recon l2,l1 "
                                              "--buffers -o buffers.exr");
    ASSERT_EQ(render.exit_code, 0) << render.output;
    const Outcome o = reconstruct("buffers.exr --recon l1,l2,none --buffers -o out.exr --stats out.json");
    ASSERT_EQ(o.exit_code, 0) << o.output;
    const ExrFile expected = read_exr(file("buffers.exr")), found = read_exr(file("out.exr"));
    const auto difference = [&](const std::string& layer, const std::string& other) {
        return relative_difference(require_layer(found, layer, "out.exr"),
                                   require_layer(expected, other, "buffers.exr"));
    };
    EXPECT_LT(difference("l2", ""), 1e-6);
    EXPECT_LT(difference("", "l1"), 1e-6);
    EXPECT_GT(difference("l2", "l1"), 1e-3);
    for (const char* name : {"primal",
                             "primal_without_direct",
                             "direct",
                             "albedo",
                             "N",
                             "Z",
                             "nearness",
                             "roughness",
                             "coefficient",
                             "coefficient_dx",
                             "coefficient_dy",
                             "coefficient_variance",
                             "coefficient_dx_variance",
                             "coefficient_dy_variance",
                             "mean_albedo",
                             "sampled_albedo",
                             "albedo_variance",
                             "sampled_share",
                             "sampled_variance",
                             "value_covariance",
                             "unexplained_variance"})
        EXPECT_TRUE(same_pixels(*find_layer(found, name), *find_layer(expected, name))) << name;
    EXPECT_EQ(found.attributes.at("tessera:settings"), expected.attributes.at("tessera:settings"));
    const auto settings = nlohmann::json::parse(found.attributes.at("tessera:reconstruction"));
    EXPECT_EQ(settings["inputs"], nlohmann::json::array({"buffers.exr"}));
    EXPECT_EQ(settings["norms"], nlohmann::json::array({"l1", "l2", "none"}));

    const auto stats = nlohmann::json::parse(std::ifstream(file("out.json")));
    EXPECT_EQ(stats["settings"], settings);
    ASSERT_EQ(stats["seconds"]["reconstruct"].size(), 3u);
    EXPECT_EQ(stats["seconds"]["reconstruct"][1]["norm"], "l2");
    EXPECT_TRUE(stats["seconds"]["load"]["cpu"].is_number());
}

/// Each reconstruction from the file has the same bits as the render's.
TEST_F(Reconstruct, HasTheSameBitsAsTheRender) {
    fs::copy_file(fs::path(TESSERA_SOURCE_DIR) / "assets/cornell-box.xml", file("box.xml"));
    const std::string norms = "guided,weighted,l2,smoothed,none";
    for (const char* basis : {"none", "albedo"}) {
        const Outcome render =
            run(folder.path(), std::string("render box.xml -m gpr --size 40x30 --spp 4 --buffers ") + "--basis " +
                                   basis + " --recon " + norms + " -o buffers.exr");
        ASSERT_EQ(render.exit_code, 0) << render.output;
        const Outcome o = reconstruct("buffers.exr --recon " + norms + " --buffers -o out.exr");
        ASSERT_EQ(o.exit_code, 0) << o.output;
        const ExrFile expected = read_exr(file("buffers.exr")), found = read_exr(file("out.exr"));
        for (const char* name :
             {"", "weighted", "l2", "smoothed", "none", "primal", "albedo", "N", "Z", "roughness"})
            EXPECT_TRUE(
                same_pixels(require_layer(found, name, "out.exr"), require_layer(expected, name, "buffers.exr")))
                << basis << ", " << name;
    }
}

TEST_F(Reconstruct, AcceptsThreeOrFourFilesOfAnyProgram) {
    // The primal has an error that the gradients do not have.
    RgbImage primal = image;
    primal(4, 5) += Rgb(1000);
    write("p.pfm", primal);
    write("dx.pfm", dx);
    write_exr(file("dy.exr"), {{{"", dy}}, {}});
    write("direct.pfm", RgbImage(width, height, Rgb(0, 0, 50)));
    const RgbImage three = result_of("p.pfm dx.pfm dy.exr");
    EXPECT_LT(std::abs(three(4, 5).r - image(4, 5).r), 100); // the error is 1000 in the primal
    EXPECT_EQ(result_of("p.pfm dx.pfm dy.exr --recon none")(4, 5), primal(4, 5));
    const RgbImage four = result_of("p.pfm dx.pfm dy.exr direct.pfm");
    for (std::size_t i = 0; i < four.size(); ++i)
        EXPECT_EQ(four.data()[i], three.data()[i] + Rgb(0, 0, 50));
    const RgbImage named = result_of("--dy dy.exr --primal p.pfm --direct direct.pfm --dx dx.pfm");
    EXPECT_TRUE(same_pixels(named, four));
}

TEST_F(Reconstruct, ExactGradientsReproduceTheImage) {
    write("p.pfm", image);
    write("dx.pfm", dx);
    write("dy.pfm", dy);
    for (const char* arguments : {"", " --recon l1", " --alpha 0.01", " --threads 2"})
        EXPECT_LT(relative_difference(result_of(std::string("p.pfm dx.pfm dy.pfm") + arguments), image), 1e-5)
            << arguments;
    // Swapped gradients do not reproduce the image.
    EXPECT_GT(relative_difference(result_of("p.pfm dy.pfm dx.pfm"), image), 1e-2);
}

// The last column of dx and the last row of dy have no meaning. They may be missing, or hold any value.
TEST_F(Reconstruct, LastColumnAndRowMayBeMissing) {
    write("p.pfm", image);
    write("narrow.pfm", cut(dx, width - 1, height));
    write("low.pfm", cut(dy, width, height - 1));
    RgbImage odd_dx = dx, odd_dy = dy;
    for (int y = 0; y < height; ++y)
        odd_dx(width - 1, y) = Rgb(NAN);
    for (int x = 0; x < width; ++x)
        odd_dy(x, height - 1) = Rgb(77);
    write("odd_dx.pfm", odd_dx);
    write("odd_dy.pfm", odd_dy);
    for (const char* arguments :
         {"p.pfm narrow.pfm low.pfm", "p.pfm odd_dx.pfm odd_dy.pfm", "p.pfm narrow.pfm odd_dy.pfm"})
        EXPECT_LT(relative_difference(result_of(arguments), image), 1e-5) << arguments;
}

TEST_F(Reconstruct, RepairsNonFinitePixels) {
    RgbImage holes = image;
    holes(3, 2) = Rgb(1, NAN, 1);
    holes(12, 8) = Rgb(-INFINITY, 0, 0);
    write("p.pfm", holes);
    write("dx.pfm", dx);
    write("dy.pfm", dy);
    const Outcome refused = reconstruct("p.pfm dx.pfm dy.pfm -o out.exr");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.output.find("p.pfm: pixel (3, 2) is (1, nan, 1)"), std::string::npos) << refused.output;
    const Outcome repaired = reconstruct("p.pfm dx.pfm dy.pfm --repair --recon none --buffers -o out.exr");
    ASSERT_EQ(repaired.exit_code, 0) << repaired.output;
    EXPECT_NE(repaired.output.find("repaired: 2"), std::string::npos) << repaired.output;
    holes(3, 2) = holes(12, 8) = Rgb(0);
    const ExrFile out = read_exr(file("out.exr"));
    EXPECT_TRUE(same_pixels(*find_layer(out, ""), holes));
    EXPECT_EQ(find_layer(out, "direct"), nullptr);
}

TEST_F(Reconstruct, AddsDirectLightAndIgnoresThePlainPicture) {
    const RgbImage direct(width, height, Rgb(50, 0, 7)), other(width, height, Rgb(1e6f));
    write_exr(file("b.exr"), {{{"", other},
                               {"primal", other},
                               {"primal_without_direct", image},
                               {"dx", dx},
                               {"dy", dy},
                               {"direct", direct},
                               {"l1", other}},
                              {}});
    RgbImage expected = image;
    for (Rgb& pixel : expected)
        pixel += Rgb(50, 0, 7);
    EXPECT_LT(relative_difference(result_of("b.exr"), expected), 1e-5);
}

TEST_F(Reconstruct, WritesAPngAndReplacesItsInput) {
    write_exr(file("b.exr"), {{{"primal", image}, {"dx", dx}, {"dy", dy}}, {}});
    EXPECT_EQ(reconstruct("b.exr -o b.png").exit_code, 0);
    EXPECT_GT(fs::file_size(file("b.png")), 0u);
    ASSERT_EQ(reconstruct("b.exr -o b.exr").exit_code, 0);
    EXPECT_LT(relative_difference(*find_layer(read_exr(file("b.exr")), ""), image), 1e-5);
}

TEST_F(Reconstruct, BadInputGetsAMessageAndExitCode2) {
    write("p.pfm", image);
    write("dx.pfm", dx);
    write("dy.pfm", dy);
    write("small.pfm", RgbImage(3, 2));
    write("narrow.pfm", cut(dx, width - 1, height));
    write("huge.pfm", RgbImage(width, height, Rgb(3e38f)));
    folder.write("cut.pfm", pfm_bytes(image).substr(0, 300));
    folder.write("text.pfm", "no image");
    folder.write("text.exr", "no image");
    folder.write("p.tiff", "II*");
    RgbImage hole = dx;
    hole(5, 1).g = NAN;
    write("hole.pfm", hole);
    write_exr(file("plain.exr"), {{{"", image}}, {}});
    write_exr(file("primal.exr"), {{{"primal", image}}, {}});
    write_exr(file("old.exr"), {{{"primal", image}, {"dx", dx}, {"dy", dy}, {"direct", image}}, {}});
    write_exr(file("layers.exr"), {{{"primal", image}, {"dx", hole}, {"dy", dy}}, {}});
    RgbImage variance(width, height, Rgb(1));
    write_exr(file("few.exr"), {{{"primal", image}, {"dx", dx}, {"dy", dy}, {"primal_variance", variance}}, {}});
    variance(5, 1) = Rgb(-1);
    write_exr(file("variance.exr"), {{{"primal", image},
                                      {"dx", dx},
                                      {"dy", dy},
                                      {"primal_variance", RgbImage(width, height, Rgb(1))},
                                      {"dx_variance", variance},
                                      {"dy_variance", variance}},
                                     {}});
    write_exr(file("patch.exr"), {{{"primal", image}, {"dx", dx}, {"dy", dy}}, {{"tessera:patch", "many"}}});
    fs::create_directories(file("folder.pfm"));
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "0 inputs"},
        {"p.pfm dx.pfm", "2 inputs"},
        {"p.pfm dx.pfm dy.pfm p.pfm p.pfm", "5 inputs"},
        {"p.pfm", "p.pfm: a single input must be an EXR file with layers"},
        {"missing.exr", "missing.exr"},
        {"text.exr", "text.exr"},
        {"plain.exr", "plain.exr has no layer \"primal\", only: \"\""},
        {"primal.exr", "primal.exr has no layer \"dx\""},
        {"old.exr", "old.exr has a layer \"direct\", but no layer \"primal_without_direct\": an older version"},
        {"layers.exr", "layers.exr, layer dx: pixel (5, 1)"},
        {"variance.exr", "variance.exr, layer dx_variance: pixel (5, 1) is -1, which is not a variance"},
        {"few.exr", "few.exr has no layer \"dx_variance\""},
        {"patch.exr", "patch.exr: attribute tessera:patch is \"many\""},
        {"missing.pfm dx.pfm dy.pfm", "missing.pfm"},
        {"p.pfm text.pfm dy.pfm", "text.pfm: it is not an OpenEXR, Radiance, PFM"},
        {"cut.pfm dx.pfm dy.pfm", "cut.pfm: it has"},
        {"folder.pfm dx.pfm dy.pfm", "folder.pfm: this is a folder"},
        {"p.tiff dx.pfm dy.pfm", "p.tiff: the name must end in .exr or .pfm"},
        {"p.pfm small.pfm dy.pfm", "p.pfm is 13x9, small.pfm is 3x2"},
        {"p.pfm dx.pfm narrow.pfm", "p.pfm is 13x9, narrow.pfm is 12x9"},
        {"p.pfm dx.pfm dy.pfm narrow.pfm", "p.pfm is 13x9, narrow.pfm is 12x9"},
        {"p.pfm hole.pfm dy.pfm", "hole.pfm: pixel (5, 1)"},
        {"huge.pfm huge.pfm huge.pfm", "too large"},
        {"--primal p.pfm --dx dx.pfm", "--dy"},
        {"--direct p.pfm", "--primal"},
        {"p.pfm dx.pfm dy.pfm --direct p.pfm", "--direct"},
        {"p.pfm dx.pfm dy.pfm --recon l3", "l3"},
        {"p.pfm dx.pfm dy.pfm --alpha 0", "--alpha"},
        {"p.pfm dx.pfm dy.pfm --threads -1", "--threads"},
        {"p.pfm dx.pfm dy.pfm --stats no/such/stats.json", "no/such"},
    };
    for (const auto& [arguments, expected] : cases) {
        const Outcome o = reconstruct(arguments + " -o out.exr");
        EXPECT_EQ(o.exit_code, 2) << arguments << "\n" << o.output;
        EXPECT_NE(o.output.find(expected), std::string::npos) << arguments << "\n" << o.output;
        EXPECT_FALSE(fs::exists(file("out.exr"))) << arguments;
    }
    for (const auto& [arguments, expected] : std::vector<std::pair<std::string, std::string>>{
             {"p.pfm dx.pfm dy.pfm", "--output"},
             {"p.pfm dx.pfm dy.pfm -o out.tiff", "must end in .exr or .png"},
             {"p.pfm dx.pfm dy.pfm -o out.png --buffers", "holds one picture"},
             {"p.pfm dx.pfm dy.pfm -o no/such/out.exr", "no/such"}}) {
        const Outcome o = reconstruct(arguments);
        EXPECT_EQ(o.exit_code, 2) << arguments << "\n" << o.output;
        EXPECT_NE(o.output.find(expected), std::string::npos) << arguments << "\n" << o.output;
    }
    for (const auto& entry : fs::directory_iterator(folder.path()))
        EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
}

TEST_F(Reconstruct, HelpDefinesTheGradients) {
    const Outcome o = reconstruct("--help");
    EXPECT_EQ(o.exit_code, 0);
    for (const char* expected : {"dx(x,y) = I(x+1,y) - I(x,y)", "dy(x,y) = I(x,y+1) - I(x,y)", "downward"})
        EXPECT_NE(o.output.find(expected), std::string::npos) << o.output;
}

} // namespace

} // namespace tessera::test
