#include "app/cli/opened_scene.h"

#include <algorithm>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace tessera {
namespace {

TEST(SceneLoader, GivesWayToWhatDraws) {
    const int own = getpriority(PRIO_PROCESS, 0);
    int there = own;
    std::shared_ptr<const Scene> scene;
    std::thread([&] {
        SceneNotes notes;
        LoadProgress progress;
        scene = loader_of({}, 1)(notes, progress); // the scene that is built in
        there = getpriority(PRIO_PROCESS, 0);
    }).join();
    EXPECT_NE(scene, nullptr);
    EXPECT_EQ(there, std::min(own + 10, 19)) << "the least there is";
}

} // namespace
} // namespace tessera
