// Shapes of type "shapegroup" and "instance".

#include "render/load/mitsuba_xml.h"

#include <string>

#include <glm/mat4x4.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tessera {

namespace {

LoadedScene parse(const std::string& body, const std::string& version = "3.0.0") {
    return parse_mitsuba_xml("<scene version='" + version + "'>" + body + "</scene>", "s.xml");
}

std::string error_of(const std::string& body) {
    try {
        parse_mitsuba_xml("<scene version='3.0.0'>" + body + "</scene>", "s.xml", {}, serial_for, nullptr, true);
    } catch (const LoadError& e) {
        return e.what();
    }
    return "no error";
}

constexpr const char* group = "<shape type='shapegroup' id='g'><shape type='cube'><bsdf type='diffuse'/></shape>"
                              "<shape type='sphere'/></shape>";

TEST(InstancePlugin, InstancesShareOneGroup) {
    const LoadedScene loaded =
        parse(std::string("<shape type='instance'><ref id='g'/><transform name='to_world'><translate x='2'/>"
                          "</transform></shape>") +
              group + "<shape type='instance'><ref id='g'/></shape><shape type='rectangle'/>");
    const SceneDescription& scene = loaded.description;
    ASSERT_EQ(scene.groups.size(), 1u);
    EXPECT_EQ(scene.groups[0].name, "g");
    ASSERT_EQ(scene.groups[0].shapes.size(), 2u);
    EXPECT_EQ(scene.groups[0].shapes[0].mesh.triangles.size(), 12u);
    EXPECT_EQ(scene.shapes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].to_world[3].x, 2);
    EXPECT_EQ(scene.instances[1].to_world, glm::mat4(1));
}

TEST(InstancePlugin, AcceptsTheOldSpellingAndGroupsWithinInstances) {
    const LoadedScene loaded =
        parse(std::string("<shape type='instance'><transform name='toWorld'><scale value='3'/>"
                          "</transform>") +
                  group + "</shape>",
              "0.6.0");
    ASSERT_EQ(loaded.description.groups.size(), 1u);
    ASSERT_EQ(loaded.description.instances.size(), 1u);
    EXPECT_EQ(loaded.description.instances[0].to_world[1].y, 3);
}

TEST(InstancePlugin, RejectsInvalidGroupsAndInstances) {
    using testing::HasSubstr;
    EXPECT_THAT(
        error_of("<shape type='shapegroup' id='g'><shape type='cube'><emitter type='area'/></shape></shape>"),
        HasSubstr("a shape of a shapegroup cannot emit light"));
    EXPECT_THAT(error_of(std::string(group) + "<shape type='shapegroup' id='h'><shape type='instance'><ref "
                                              "id='g'/></shape></shape>"),
                HasSubstr("a shapegroup holds neither groups nor instances"));
    EXPECT_THAT(error_of("<shape type='shapegroup' id='h'><ref id='h'/></shape>"),
                HasSubstr("a shapegroup holds neither groups nor instances"));
    EXPECT_THAT(error_of("<shape type='cube' id='c'/><shape type='instance'><ref id='c'/></shape>"),
                HasSubstr("an instance needs exactly one shapegroup"));
    EXPECT_THAT(error_of("<shape type='instance'/>"),
                HasSubstr("s.xml:1:24: an instance needs exactly one shapegroup"));
    EXPECT_THAT(error_of(std::string(group) +
                         "<shape type='instance'><ref id='g'/><transform name='to_world'><scale "
                         "x='0'/></transform></shape>"),
                HasSubstr("the 'to_world' of an instance must have an inverse"));
}

} // namespace

} // namespace tessera
