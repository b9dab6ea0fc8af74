// Sensors and films: several sensors, crop windows, pixel formats and reconstruction filters.
#include "render/io/text.h"
#include "render/load/mitsuba_xml.h"

#include <stdexcept>
#include <string>

#include <glm/vec2.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera {

namespace {

LoadedScene parse(const std::string& body, const std::string& version = "3.0.0") {
    return parse_mitsuba_xml("<scene version=\"" + version + "\">" + body + "</scene>", "test.xml");
}

/// Returns a sensor whose film, of 96 x 64 pixels, has these children.
std::string with_film(const std::string& children, const std::string& id = "") {
    return "<sensor type='perspective'" + (id.empty() ? "" : " id='" + id + "'") +
           "><float name='fov' value='40'/><film type='hdrfilm'><integer name='width' value='96'/>"
           "<integer name='height' value='64'/>" +
           children + "</film></sensor>";
}

std::string crop(int x, int y, int width, int height) {
    const auto integer = [](const char* name, int value) {
        return "<integer name='" + std::string(name) + "' value='" + std::to_string(value) + "'/>";
    };
    return integer("crop_offset_x", x) + integer("crop_offset_y", y) + integer("crop_width", width) +
           integer("crop_height", height);
}

PixelFilter filter_of(const std::string& rfilter) {
    return parse(with_film(rfilter)).description.camera.filter;
}

std::string error_of(const std::string& body) {
    try {
        parse(body);
        return "";
    } catch (const LoadError& error) {
        return error.what();
    }
}

} // namespace

TEST(Sensors, AllAreReadAndTheFirstIsUsed) {
    const LoadedScene loaded =
        parse(with_film("") + "<sensor type='perspective' id='second'><float name='fov' value='60'/>"
                              "<film type='hdrfilm'><integer name='width' value='50'/>"
                              "<integer name='height' value='40'/></film></sensor>");
    const std::vector<Sensor>& sensors = loaded.description.sensors;
    ASSERT_EQ(sensors.size(), 2u);
    EXPECT_EQ(loaded.description.size, glm::ivec2(96, 64));
    EXPECT_EQ(loaded.description.camera.fov, 40);
    EXPECT_EQ(sensors[1].size, glm::ivec2(50, 40));
    EXPECT_EQ(sensors[1].camera.fov, 60);
    EXPECT_TRUE(loaded.notes.empty());
    EXPECT_EQ(find_sensor(sensors, "second"), 1u);
    EXPECT_EQ(find_sensor(sensors, "0"), 0u);
    for (const char* unknown : {"2", "-1", "", "third"})
        EXPECT_THROW(find_sensor(sensors, unknown), std::runtime_error) << unknown;
    EXPECT_EQ(list_of(sensors), "0, 1 (second)");
}

TEST(Sensors, CropWindowsAreReadInBothSpellings) {
    const CropWindow expected{{96, 64}, {30, 10}, {40, 36}};
    const LoadedScene loaded = parse(with_film(crop(30, 10, 40, 36)));
    EXPECT_EQ(loaded.description.camera.crop, expected);
    EXPECT_EQ(loaded.description.size, glm::ivec2(40, 36));
    const LoadedScene old =
        parse(with_film("<integer name='cropOffsetX' value='30'/><integer name='cropOffsetY' value='10'/>"
                        "<integer name='cropWidth' value='40'/><integer name='cropHeight' value='36'/>"),
              "0.6.0");
    EXPECT_EQ(old.description.camera.crop, expected);
    EXPECT_TRUE(parse(with_film(crop(0, 0, 96, 64))).description.camera.crop.empty());
}

TEST(Sensors, ACropWindowOutsideItsFilmIsAnError) {
    EXPECT_THAT(
        error_of(with_film(crop(60, 10, 40, 36))),
        testing::HasSubstr("the crop window, 40x36 pixels at (60, 10), does not lie within the film of 96x64"));
    for (const std::string& bad :
         {crop(-1, 0, 10, 10), crop(0, 0, 0, 10), crop(0, 60, 10, 5), crop(2147483647, 0, 1, 1),
          std::string("<integer name='crop_offset_x' value='1'/>")})
        EXPECT_NE(error_of(with_film(bad)), "") << bad;
}

TEST(Sensors, PixelFormatsAreReadInAnyCase) {
    const auto format = [](const std::string& name) {
        return parse(with_film("<string name='pixel_format' value='" + name + "'/>"));
    };
    EXPECT_EQ(format("rgba").description.format, PixelFormat::rgba);
    EXPECT_EQ(format("luminance_alpha").description.format, PixelFormat::luminance_alpha);
    EXPECT_EQ(format("XYZ").description.format, PixelFormat::xyz);
    EXPECT_EQ(parse(with_film("")).description.format, PixelFormat::rgb);
    const LoadedScene unknown = format("cmyk");
    EXPECT_EQ(unknown.description.format, PixelFormat::rgb);
    ASSERT_EQ(unknown.notes.size(), 1u);
    EXPECT_EQ(unknown.notes[0].text, "the pixel format 'cmyk' is not known: rgb is used instead");
}

TEST(Sensors, FiltersHaveMitsubasParameters) {
    EXPECT_EQ(filter_of(""), gaussian_filter(0.5f));
    EXPECT_EQ(filter_of("<rfilter type='box'/>"), PixelFilter());
    EXPECT_EQ(filter_of("<rfilter type='gaussian'><float name='stddev' value='0.7'/></rfilter>"),
              gaussian_filter(0.7f));
    EXPECT_EQ(filter_of("<rfilter type='tent'><float name='radius' value='1.5'/></rfilter>").radius, 1.5f);
    const PixelFilter mitchell = filter_of(
        "<rfilter type='mitchell'><float name='B' value='0.5'/><float name='C' value='0.25'/></rfilter>");
    EXPECT_EQ(mitchell.kind, FilterKind::mitchell);
    EXPECT_EQ(mitchell.first, 0.5f);
    EXPECT_EQ(mitchell.second, 0.25f);
    EXPECT_EQ(filter_of("<rfilter type='lanczos'><integer name='lobes' value='2'/></rfilter>").radius, 2);
    EXPECT_EQ(filter_of("<rfilter type='catmullrom'/>").second, 0.5f);
    EXPECT_NE(error_of(with_film("<rfilter type='gaussian'><float name='stddev' value='0'/></rfilter>")), "");
    EXPECT_NE(error_of(with_film("<rfilter type='tent'><float name='radius' value='-1'/></rfilter>")), "");
    const LoadedScene unknown = parse(with_film("<rfilter type='sharp'/>"));
    EXPECT_EQ(unknown.description.camera.filter, PixelFilter());
    ASSERT_EQ(unknown.notes.size(), 1u);
}

TEST(Sensors, HiddenEmittersAreReadFromAnyIntegrator) {
    const std::string hide = "<boolean name='hide_emitters' value='true'/>";
    EXPECT_TRUE(parse("<integrator type='path'>" + hide + "</integrator>").description.hides_emitters);
    EXPECT_TRUE(parse("<integrator type='aov'><integrator type='path'>" + hide + "</integrator></integrator>")
                    .description.hides_emitters);
    EXPECT_FALSE(parse("<integrator type='path'/>").description.hides_emitters);
}

} // namespace tessera
