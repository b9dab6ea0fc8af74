#include "render/load/mitsuba_xml.h"
#include "render/load/scene_source.h"
#include "tests/load/temporary_folder.h"

#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {

namespace {

constexpr const char* two_meshes = "<scene version='3.0.0'>"
                                   "<shape type='obj'><string name='filename' value='a.obj'/></shape>"
                                   "<shape type='obj'><string name='filename' value='b.obj'/></shape></scene>";
constexpr const char* mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(LoadProgress, CountsFiles) {
    const TemporaryFolder folder;
    folder.write("a.obj", mesh);
    folder.write("b.obj", mesh);
    LoadProgress progress;
    std::vector<std::string> seen;
    const ParallelFor one_by_one = [&](int count, const std::function<void(int)>& body) {
        for (int i = 0; i < count; ++i) {
            seen.push_back(to_string(progress.state()));
            body(i);
        }
        seen.push_back(to_string(progress.state()));
    };
    load_mitsuba_xml(folder.write("s.xml", two_meshes), {}, one_by_one, &progress);
    EXPECT_EQ(seen, (std::vector<std::string>{"meshes and textures, 0 of 2", "meshes and textures, 1 of 2",
                                              "meshes and textures, 2 of 2"}));
}

TEST(LoadProgress, StopsBetweenFilesWhenCancelled) {
    const TemporaryFolder folder;
    folder.write("a.obj", mesh);
    folder.write("b.obj", mesh);
    LoadProgress progress;
    const ParallelFor one_by_one = [&](int count, const std::function<void(int)>& body) {
        for (int i = 0; i < count; ++i) {
            body(i);
            progress.give_up();
        }
    };
    EXPECT_THROW(load_mitsuba_xml(folder.write("s.xml", two_meshes), {}, one_by_one, &progress),
                 std::runtime_error);
    EXPECT_EQ(progress.state().done, 1);
}

TEST(LoadProgress, NamesItsStages) {
    LoadProgress progress;
    EXPECT_EQ(to_string(progress.state()), "scene file");
    progress.begin(LoadProgress::Stage::bvh);
    EXPECT_EQ(to_string(progress.state()), "BVH");
}

} // namespace

} // namespace tessera
