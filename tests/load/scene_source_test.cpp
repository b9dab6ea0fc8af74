#include "render/load/scene_source.h"

#include <gtest/gtest.h>

namespace tessera {

namespace {

TEST(SceneName, CombinesFileOrFolderNameAndVariables) {
    EXPECT_EQ(scene_name({}), "cornell-box");
    EXPECT_EQ(scene_name({"a/room.xml", {}, {}}), "room");
    EXPECT_EQ(scene_name({"kitchen/scene_v3.xml", {}, {}}), "kitchen");
    EXPECT_EQ(scene_name({"glossy.xml", {{"roughness", "0.01"}, {"spp", "-4"}}, {}}), "glossy-0.01--4");
}

TEST(SceneName, HasNoFolderSeparators) {
    EXPECT_EQ(scene_name({"room.xml", {{"texture", "maps/wood.png"}, {"up", "0, 1, 0"}}, {}}),
              "room-maps_wood.png-0__1__0");
}

} // namespace

} // namespace tessera
