#include "app/cli/opened_scene.h"

#include <algorithm>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace tessera {
namespace {

TEST(SceneLoader, LoadsWithLowerPriority) {
    const int own_priority = getpriority(PRIO_PROCESS, 0);
    int loader_priority = own_priority;
    std::shared_ptr<const Scene> scene;
    std::thread([&] {
        SceneNotes notes;
        LoadProgress progress;
        scene = loader_of({}, 1)(notes, progress); // the built-in scene
        loader_priority = getpriority(PRIO_PROCESS, 0);
    }).join();
    EXPECT_NE(scene, nullptr);
    EXPECT_EQ(loader_priority, std::min(own_priority + 10, 19)) << "the loading thread has a lower priority";
}

} // namespace
} // namespace tessera
