// Plugins of <emitter>: the lights read, the notes and the errors.
#include "render/load/mitsuba_xml.h"

#include <cmath>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec3.hpp>
#include <gmock/gmock.h>

namespace tessera {

namespace {

LoadedScene load(const std::string& xml, const std::string& version = "3.0.0") {
    return parse_mitsuba_xml("<scene version='" + version + "'>" + xml + "<sensor type='perspective'/></scene>",
                             "test");
}

std::string error_of(const std::string& xml) {
    try {
        load(xml);
    } catch (const LoadError& e) {
        return e.what();
    }
    return "no error";
}

TEST(EmitterPlugins, PointHasAPositionOrATransform) {
    const LoadedScene loaded =
        load("<emitter type='point'><point name='position' x='1' y='2' z='3'/>"
             "<rgb name='intensity' value='4, 5, 6'/></emitter>"
             "<emitter type='point'><transform name='to_world'><translate x='7'/></transform>"
             "</emitter>");
    ASSERT_EQ(loaded.description.point_lights.size(), 2u);
    EXPECT_EQ(loaded.description.point_lights[0].position, glm::vec3(1, 2, 3));
    EXPECT_EQ(loaded.description.point_lights[0].intensity, Rgb(4, 5, 6));
    EXPECT_EQ(loaded.description.point_lights[1].position, glm::vec3(7, 0, 0));
    EXPECT_TRUE(loaded.notes.empty());
}

TEST(EmitterPlugins, SpotFallsOffLinearlyWithTheAngle) {
    const LoadedScene loaded = load(
        "<emitter type='spot'><float name='cutoffAngle' value='30'/><float name='beamWidth' value='10'/>"
        "<transform name='toWorld'><lookat origin='0,0,0' target='0,0,-5' up='0,1,0'/></transform></emitter>");
    const PointLight& spot = loaded.description.point_lights.at(0);
    const auto at = [&](float degrees) {
        const float a = degrees * 3.14159265f / 180;
        return spot.toward({std::sin(a), 0, -std::cos(a)}).r;
    };
    EXPECT_FLOAT_EQ(at(0), 1);
    EXPECT_FLOAT_EQ(at(9.9f), 1);
    EXPECT_NEAR(at(20), 0.5f, 1e-4f);
    EXPECT_EQ(at(30.1f), 0);
    EXPECT_EQ(at(180), 0);
}

TEST(EmitterPlugins, DirectionIsThatOfPropagation) {
    const LoadedScene loaded = load("<emitter type='directional'><vector name='direction' x='0' y='-2' z='0'/>"
                                    "<rgb name='irradiance' value='3'/></emitter>");
    EXPECT_EQ(loaded.description.directional_lights.at(0).to_light, glm::vec3(0, 1, 0));
    EXPECT_EQ(loaded.description.directional_lights.at(0).irradiance, Rgb(3));
}

// In the cone, u grows with +x and v with +y, as in Mitsuba 3.
TEST(EmitterPlugins, SpotWithATexture) {
    const LoadedScene loaded = load("<emitter type='spot'><float name='cutoff_angle' value='40'/>"
                                    "<texture type='checkerboard' name='texture'><rgb name='color0' value='1'/>"
                                    "<rgb name='color1' value='0'/></texture></emitter>");
    EXPECT_TRUE(loaded.notes.empty());
    const PointLight& spot = loaded.description.point_lights.at(0);
    const auto toward = [&](float x, float y) { return spot.toward(glm::normalize(glm::vec3(x, y, 1))).r; };
    EXPECT_EQ(toward(0.2f, 0.2f), 1);
    EXPECT_EQ(toward(-0.2f, -0.2f), 1);
    EXPECT_EQ(toward(-0.2f, 0.2f), 0);
    EXPECT_EQ(toward(0.2f, -0.2f), 0);

    const LoadedScene wide = load("<emitter type='spot'><float name='cutoff_angle' value='95'/>"
                                  "<texture type='checkerboard' name='texture'/></emitter>");
    ASSERT_EQ(wide.notes.size(), 1u);
    EXPECT_THAT(wide.notes[0].text,
                testing::HasSubstr("the texture is not used: it needs a 'cutoff_angle' below 90 degrees"));
    EXPECT_FALSE(wide.description.point_lights.at(0).slide);
}

TEST(EmitterPlugins, ProjectorIrradianceIsPiTimesItsPicture) {
    const LoadedScene loaded = load("<emitter type='projector'><float name='fov' value='60'/>"
                                    "<float name='scale' value='2'/><rgb name='irradiance' value='1, 2, 3'/>"
                                    "<transform name='to_world'><translate x='7'/></transform></emitter>");
    EXPECT_TRUE(loaded.notes.empty());
    const PointLight& light = loaded.description.point_lights.at(0);
    EXPECT_EQ(light.position, glm::vec3(7, 0, 0));
    const glm::vec3 plane_point(0.2f, 0.1f, 1);
    const float distance = glm::length(plane_point);
    const Rgb irradiance = light.toward(plane_point / distance) / (distance * distance) / distance;
    EXPECT_LT(glm::distance(irradiance, 2 * glm::pi<float>() * Rgb(1, 2, 3)), 1e-4f);
    EXPECT_EQ(light.toward(glm::normalize(glm::vec3(0.58f, 0, 1))), Rgb(0)); // tan 30 is 0.577
    EXPECT_EQ(light.toward({0, 0, -1}), Rgb(0));
}

TEST(EmitterPlugins, UsesOnlyTheFirstEnvironment) {
    const LoadedScene loaded = load("<emitter type='constant'><rgb name='radiance' value='0.5'/></emitter>"
                                    "<emitter type='constant'/>");
    EXPECT_EQ(loaded.description.environment.map->bitmap->floats.at(0), Rgb(0.5f));
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_THAT(loaded.notes[0].text, testing::HasSubstr("another environment already"));
}

TEST(EmitterPlugins, TexturedAreaLight) {
    const LoadedScene loaded = load("<shape type='rectangle'><emitter type='area'><texture type='checkerboard' "
                                    "name='radiance'><rgb name='color0' value='3'/></texture></emitter></shape>");
    EXPECT_FALSE(loaded.description.area_lights.at(0).radiance.is_constant());
    EXPECT_TRUE(loaded.notes.empty());
}

TEST(EmitterPlugins, EmittingShapesAreBlackWithoutAMaterial) {
    const LoadedScene loaded =
        load("<shape type='rectangle'><emitter type='area'/></shape>"
             "<shape type='rectangle'/>"
             "<shape type='rectangle'><emitter type='area'/><bsdf type='diffuse'/></shape>");
    const auto reflectance = [&](std::size_t shape) {
        const auto& material = loaded.description.materials[loaded.description.shapes[shape].material];
        return std::get<DiffuseMaterial>(material.kind).reflectance.mean();
    };
    EXPECT_EQ(reflectance(0), Rgb(0));
    EXPECT_EQ(reflectance(1), Rgb(0.5f));
    EXPECT_EQ(reflectance(2), Rgb(0.5f));
}

TEST(EmitterPlugins, SunskyOfBothSyntaxes) {
    const std::string emitter = "<emitter type='sunsky'><float name='turbidity' value='3'/>"
                                "<vector name='sunDirection' x='0.3' y='0.8' z='-0.2'/></emitter>";
    const LoadedScene old = load(emitter, "0.6.0");
    const auto& environment = old.description.environment;
    ASSERT_TRUE(environment.map && environment.sun);
    const glm::vec3 expected = glm::normalize(glm::vec3(0.3f, 0.8f, -0.2f));
    EXPECT_LT(glm::distance(environment.sun->direction, expected), 1e-5f);
    EXPECT_GT(environment.sun->radiance.r, environment.sun->radiance.b); // yellowish
    const Environment sky(environment);
    const Rgb up = sky.radiance({0, 1, 0});
    EXPECT_GT(up.b, up.r); // blue
    EXPECT_TRUE(is_black(sky.radiance({0, -1, 0})));
    ASSERT_EQ(old.notes.size(), 1u);
    EXPECT_THAT(old.notes[0].text, testing::HasSubstr("Preetham"));

    // +z is up in the new syntax.
    const Environment turned(load("<emitter type='sky'><vector name='sun_direction' x='0.3' y='0.2' z='0.8'/>"
                                  "</emitter>")
                                 .description.environment);
    EXPECT_GT(turned.radiance({0, 0, 1}).b, 0);
    EXPECT_TRUE(is_black(turned.radiance({0, 0, -1})));
}

TEST(EmitterPlugins, ErrorsNameBadValues) {
    const auto has = [](const char* text) { return testing::HasSubstr(text); };
    EXPECT_THAT(error_of("<emitter type='point'><rgb name='intensity' value='-1'/></emitter>"),
                has("'intensity' must not be negative"));
    EXPECT_THAT(error_of("<emitter type='spot'><float name='cutoff_angle' value='200'/></emitter>"),
                has("'cutoff_angle' must be between 0 and 180"));
    EXPECT_THAT(error_of("<emitter type='directional'><vector name='direction' x='0' y='0' z='0'/></emitter>"),
                has("the direction must not be 0"));
    EXPECT_THAT(error_of("<emitter type='projector'><float name='scale' value='-1'/></emitter>"),
                has("'scale' must not be negative"));
    EXPECT_THAT(error_of("<emitter type='projector'><float name='fov' value='180'/></emitter>"),
                has("the field of view must be between 0 and 180 degrees"));
    EXPECT_THAT(error_of("<emitter type='projector'><rgb name='irradiance' value='-1'/></emitter>"),
                has("'irradiance' must not be negative"));
    EXPECT_THAT(error_of("<emitter type='envmap'/>"), has("'envmap' needs a 'filename'"));
    EXPECT_THAT(error_of("<emitter type='sunsky'><integer name='month' value='13'/></emitter>"),
                has("there is no day 2010-13-10"));
    EXPECT_THAT(error_of("<emitter type='sunsky'><integer name='month' value='-250'/></emitter>"),
                has("there is no day 2010--250-10"));
    EXPECT_THAT(error_of("<emitter type='sun'><integer name='year' value='70000'/></emitter>"),
                has("there is no day 70000-7-10"));
    EXPECT_THAT(error_of("<emitter type='sun'><float name='sun_aperture' value='-1'/></emitter>"),
                has("'sun_aperture' must be from 0 to 180 degrees"));
    EXPECT_THAT(error_of("<emitter type='sky'><float name='turbidity' value='70'/></emitter>"),
                has("'turbidity' must be from 1 to 10"));
}

TEST(EmitterPlugins, ClampsTheScaleOfAProjector) {
    const LoadedScene loaded = load("<emitter type='projector'><float name='scale' value='1e20'/></emitter>");
    EXPECT_EQ(loaded.description.point_lights.at(0).intensity, Rgb(1e15f));
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_THAT(loaded.notes[0].text, testing::HasSubstr("'scale' is clamped to 1e15"));
}

TEST(EmitterPlugins, ReportsUnknownEmitters) {
    const LoadedScene loaded = load("<emitter type='laser'/>");
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_THAT(loaded.notes[0].text, testing::HasSubstr("'laser' is not known; it gives no light"));
}

} // namespace

} // namespace tessera
