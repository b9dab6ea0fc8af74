// Views of a scene: sensors, crop windows, pixel formats, camera paths and several scenes of `tessera render`.
#include "app/cli/picture_names.h"
#include "app/cli/pixel_format.h"
#include "render/io/exr.h"
#include "tests/app/program.h"
#include "tests/load/temporary_folder.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <glm/vec2.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string film(const std::string& size, const std::string& children) {
    const std::size_t x = size.find('x');
    return "<film type='hdrfilm'><integer name='width' value='" + size.substr(0, x) +
           "'/><integer name='height' value='" + size.substr(x + 1) + "'/>" + children + "</film>";
}

/// Returns a scene with two sensors: a white rectangle covers the middle of the first, which sees nothing else.
std::string two_sensors(const std::string& film_children = "", const std::string& integrator = "") {
    return "<scene version='3.0.0'><integrator type='path'>" + integrator +
           "</integrator><sensor type='orthographic'><transform name='to_world'><lookat origin='0,0,4' "
           "target='0,0,0' up='0,1,0'/></transform>" +
           film("24x16", film_children) +
           "</sensor><sensor type='perspective' id='near'><float name='fov' value='60'/>"
           "<transform name='to_world'><lookat origin='0,0,2' target='0,0,0' up='0,1,0'/></transform>" +
           film("10x12", "") +
           "</sensor><emitter type='constant'/><shape type='rectangle'><transform name='to_world'>"
           "<scale x='0.501' y='0.335'/></transform><bsdf type='diffuse'><rgb name='reflectance' "
           "value='0.4,0.2,0.1'/></bsdf></shape></scene>";
}

const std::string render_pt = "-m pt --spp 4 --threads 1 ";

class Views : public testing::Test {
protected:
    Outcome render(const std::string& arguments) const { return run(folder_.path(), "render " + arguments); }
    ExrFile picture(const std::string& name) const { return read_exr(folder_.path() / name); }
    glm::ivec2 size_of(const std::string& name) const {
        const RgbImage image = picture(name).layers.front().image;
        return {image.width(), image.height()};
    }
    std::set<std::string> channels(const std::string& name) const {
        const Imf::InputFile input((folder_.path() / name).c_str());
        std::set<std::string> names;
        const Imf::ChannelList& list = input.header().channels();
        for (auto c = list.begin(); c != list.end(); ++c)
            names.insert(c.name());
        return names;
    }
    TemporaryFolder folder_;
};

TEST_F(Views, SensorsAreChosenByNumberOrId) {
    folder_.write("s.xml", two_sensors());
    const Outcome first = render("s.xml -o a.exr " + render_pt);
    EXPECT_EQ(first.exit_code, 0) << first.output;
    EXPECT_THAT(first.output, HasSubstr("several sensors, 0, 1 (near): sensor 0 is used"));
    EXPECT_EQ(size_of("a.exr"), glm::ivec2(24, 16));
    for (const std::string sensor : {"1", "near"}) {
        const Outcome chosen = render("s.xml -o b.exr --sensor " + sensor + " " + render_pt);
        EXPECT_EQ(chosen.exit_code, 0) << chosen.output;
        EXPECT_THAT(chosen.output, testing::Not(HasSubstr("several sensors")));
        EXPECT_EQ(size_of("b.exr"), glm::ivec2(10, 12));
    }
    const Outcome unknown = render("s.xml -o c.exr --sensor far " + render_pt);
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.output, HasSubstr("there is no sensor 'far'; the scene has 0, 1 (near)"));
    EXPECT_FALSE(fs::exists(folder_.path() / "c.exr"));
    EXPECT_THAT(run(folder_.path(), "info s.xml").output, HasSubstr("sensors    0, 1 (near)"));
}

TEST_F(Views, ACropIsPartOfTheWholePicture) {
    folder_.write("s.xml", two_sensors());
    const std::string options = "--no-edge-rays --path-guiding off " + render_pt;
    ASSERT_EQ(render("s.xml -o whole.exr " + options).exit_code, 0);
    ASSERT_EQ(render("s.xml -o part.exr --crop 5,3,12x9 " + options).exit_code, 0);
    const RgbImage whole = picture("whole.exr").layers.front().image,
                   part = picture("part.exr").layers.front().image;
    ASSERT_EQ(part.width(), 12);
    ASSERT_EQ(part.height(), 9);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 12; ++x)
            ASSERT_NEAR(part(x, y).g, whole(x + 5, y + 3).g, 1e-5f) << x << ", " << y;
    ASSERT_EQ(render("s.xml -o large.exr --size 48x32 --crop 30,20,10x8 " + options).exit_code, 0);
    EXPECT_EQ(size_of("large.exr"), glm::ivec2(10, 8));
    const Outcome outside = render("s.xml -o c.exr --crop 20,0,10x10 " + options);
    EXPECT_EQ(outside.exit_code, 2);
    EXPECT_THAT(outside.output, HasSubstr("--crop 20,0,10x10: the window does not lie within the film of 24x16"));
    for (const std::string bad : {"1,2", "1,2,3", "a", "-1,0,4x4", "0,0,0x4", "0,0,4x4,"})
        EXPECT_EQ(render("s.xml -o c.exr --crop=" + bad + " " + options).exit_code, 2) << bad;
}

TEST_F(Views, ACropWindowOfTheFileScalesWithItsFilm) {
    folder_.write("s.xml", two_sensors("<integer name='crop_offset_x' value='6'/><integer name='crop_offset_y' "
                                       "value='4'/><integer name='crop_width' value='12'/><integer "
                                       "name='crop_height' value='8'/>"));
    ASSERT_EQ(render("s.xml -o a.exr " + render_pt).exit_code, 0);
    EXPECT_EQ(size_of("a.exr"), glm::ivec2(12, 8));
    // The rectangle is as large as the window, which is centred.
    const RgbImage window = picture("a.exr").layers.front().image;
    for (const Rgb& c : window) // the sky is white
        EXPECT_LT(c.r, 0.8f);
    ASSERT_EQ(render("s.xml -o b.exr --size 48x32 " + render_pt).exit_code, 0);
    EXPECT_EQ(size_of("b.exr"), glm::ivec2(24, 16));
    ASSERT_EQ(render("s.xml -o c.exr --crop none " + render_pt).exit_code, 0);
    EXPECT_EQ(size_of("c.exr"), glm::ivec2(24, 16));
}

/// The window of a camera file sets the size of the picture, unless --crop replaces it.
TEST_F(Views, TheCropWindowOfACameraFileIsUsed) {
    folder_.write("s.xml", two_sensors());
    const std::string camera = "{\"to_world\": [-1,0,0,0, 0,1,0,0, 0,0,-1,4, 0,0,0,1], \"orthographic\": true, "
                               "\"crop\": [24, 16, 6, 4, 12, 10]}";
    folder_.write("c.json", camera);
    folder_.write("path.json", "[" + camera + "]");
    for (const auto& [option, file] : {std::pair("--camera c.json -o a.exr ", "a.exr"),
                                       std::pair("--cameras path.json -o a-##.exr ", "a-00.exr")}) {
        const std::string command = std::string("s.xml ") + option + render_pt;
        ASSERT_EQ(render(command).exit_code, 0);
        EXPECT_EQ(size_of(file), glm::ivec2(12, 10)) << option;
        ASSERT_EQ(render(command + "--size 48x32").exit_code, 0);
        EXPECT_EQ(size_of(file), glm::ivec2(24, 20)) << option;
        ASSERT_EQ(render(command + "--crop 0,0,5x7").exit_code, 0);
        EXPECT_EQ(size_of(file), glm::ivec2(5, 7)) << option;
        ASSERT_EQ(render(command + "--crop none").exit_code, 0);
        EXPECT_EQ(size_of(file), glm::ivec2(24, 16)) << option;
    }
}

TEST_F(Views, AReferenceWithAnotherFilterOfTheSceneIsRejected) {
    const std::string bench = "bench s.xml -m pt --spp 2 --seeds 1 --size 24x16 --filter scene --reference refs "
                              "--reference-spp 4 --threads 1 -o ";
    folder_.write("s.xml", two_sensors("<rfilter type='gaussian'/>"));
    const Outcome first = run(folder_.path(), bench + "out1");
    ASSERT_EQ(first.exit_code, 0) << first.output;
    ASSERT_EQ(run(folder_.path(), bench + "out2").exit_code, 0) << "the same scene again";
    folder_.write("s.xml", two_sensors("<rfilter type='tent'/>"));
    const Outcome changed = run(folder_.path(), bench + "out3");
    EXPECT_EQ(changed.exit_code, 2);
    EXPECT_THAT(changed.output, HasSubstr("different reconstruction filter"));
}

TEST_F(Views, PixelFormatsHaveTheirChannels) {
    folder_.write("s.xml", two_sensors("<string name='pixel_format' value='rgba'/>",
                                       "<boolean name='hide_emitters' value='true'/>"));
    ASSERT_EQ(render("s.xml -o a.exr " + render_pt).exit_code, 0);
    EXPECT_EQ(channels("a.exr"), (std::set<std::string>{"R", "G", "B", "A"}));
    ASSERT_EQ(render("s.xml -o y.exr --pixel-format luminance " + render_pt).exit_code, 0);
    EXPECT_EQ(channels("y.exr"), std::set<std::string>{"Y"});
    ASSERT_EQ(render("s.xml -o xyz.exr --pixel-format xyza " + render_pt).exit_code, 0);
    EXPECT_EQ(channels("xyz.exr"), (std::set<std::string>{"X", "Y", "Z", "A"}));
    EXPECT_EQ(render("s.xml -o b.exr --buffers --pixel-format xyz " + render_pt).exit_code, 2);
    ASSERT_EQ(render("s.xml -o b.exr --buffers " + render_pt).exit_code, 0);
    EXPECT_TRUE(channels("b.exr").contains("A"));
    EXPECT_EQ(render("s.xml -o b.exr --pixel-format cmyk " + render_pt).exit_code, 2);
}

TEST_F(Views, APngHasAlphaAndColoursThatAreNotPremultiplied) {
    folder_.write("s.xml", two_sensors("", "<boolean name='hide_emitters' value='true'/>"));
    ASSERT_EQ(render("s.xml -o a.png --pixel-format rgba " + render_pt).exit_code, 0);
    std::ifstream in(folder_.path() / "a.png", std::ios::binary);
    std::string bytes(26, '\0');
    in.read(bytes.data(), 26);
    EXPECT_EQ(bytes[25], 6) << "colour type of PNG: RGB with alpha";
}

TEST(PixelFormats, AreConvertedFromLinearRgb) {
    const auto converted = [](PixelFormat format) {
        ExrFile file{{{"", RgbImage(1, 1, Rgb(0.2f, 0.5f, 0.1f))}}, {}};
        set_pixel_format(file, format, Image<float>(1, 1, 0.25f));
        return file;
    };
    const ExrFile y = converted(PixelFormat::luminance_alpha), xyz = converted(PixelFormat::xyza);
    const float luminance = 0.2126f * 0.2f + 0.7152f * 0.5f + 0.0722f * 0.1f;
    ASSERT_EQ(y.layers.size(), 2u);
    EXPECT_NEAR(y.layers[0].image(0, 0).r, luminance, 1e-4f);
    EXPECT_EQ(y.layers[1].image(0, 0).r, 0.25f);
    ASSERT_EQ(xyz.layers.size(), 4u);
    EXPECT_NEAR(xyz.layers[0].image(0, 0).r, 0.4124f * 0.2f + 0.3576f * 0.5f + 0.1805f * 0.1f, 1e-4f);
    EXPECT_NEAR(xyz.layers[1].image(0, 0).r, luminance, 1e-4f);
    EXPECT_NEAR(xyz.layers[2].image(0, 0).r, 0.0193f * 0.2f + 0.1192f * 0.5f + 0.9505f * 0.1f, 1e-4f);
}

TEST(PictureNames, FramesAreNumbered) {
    EXPECT_EQ(frame_name("out/walk.exr", 7), "out/walk-0007.exr");
    EXPECT_EQ(frame_name("walk-##.exr", 123), "walk-123.exr");
    EXPECT_EQ(frame_name("###_a.png", 4), "004_a.png");
    EXPECT_EQ(scene_outputs("out/a.exr", {"room"}).at(0), "out/a.exr");
    const auto several = scene_outputs("out/a.exr", {"room", "hall", "room"});
    EXPECT_EQ(several.at(1), "out/a-hall.exr");
    EXPECT_EQ(several.at(2), "out/a-room-2.exr");
}

TEST_F(Views, ACameraPathMakesNumberedFrames) {
    folder_.write("s.xml", two_sensors());
    const auto camera = [](float x) {
        return "{\"to_world\": [-1,0,0," + std::to_string(x) +
               ", 0,1,0,0, 0,0,-1,4, 0,0,0,1], \"orthographic\": true}";
    };
    folder_.write("path.json", "[" + camera(0) + ",\n" + camera(9) + "]");
    const Outcome outcome = render("s.xml -o f-##.exr --cameras path.json " + render_pt);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_NEAR(picture("f-00.exr").layers.front().image(12, 8).r, 0.4f, 0.2f);
    EXPECT_NEAR(picture("f-01.exr").layers.front().image(12, 8).g, 1, 1e-3f) << "the sky";
    folder_.write("bad.json", "[" + camera(0) + ",\n{\"fov\": 40}]");
    const Outcome bad = render("s.xml -o g.exr --cameras bad.json " + render_pt);
    EXPECT_EQ(bad.exit_code, 2);
    EXPECT_THAT(bad.output, HasSubstr("bad.json:2:1: the camera has no 'to_world'"));
    EXPECT_FALSE(fs::exists(folder_.path() / "g-0000.exr"));
}

TEST_F(Views, AnErrorInOneSceneDoesNotStopTheOthers) {
    folder_.write("a.xml", two_sensors());
    folder_.write("broken.xml", "<scene version='3.0.0'><shape/></scene>");
    folder_.write("c.xml", two_sensors());
    const Outcome outcome = render("a.xml broken.xml absent.xml c.xml -o out.exr " + render_pt);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("broken.xml:1"));
    EXPECT_THAT(outcome.output, HasSubstr("absent.xml"));
    EXPECT_TRUE(fs::exists(folder_.path() / "out-a.exr"));
    EXPECT_TRUE(fs::exists(folder_.path() / "out-c.exr"));
    EXPECT_FALSE(fs::exists(folder_.path() / "out-broken.exr"));
}

} // namespace

} // namespace tessera::test
