// The threads of a render, the BVH and reconstructions check the available memory before they allocate.

#include "render/io/available_memory.h"
#include "render/run/checked_reconstruction.h"
#include "render/run/render.h"
#include "render/scene/scene.h"
#include "tests/support/memory_limit.h"
#include "tests/support/rooms.h"

#include <functional>
#include <new>
#include <string>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

std::string refusal(rlim_t bytes, const std::function<void()>& work) {
    try {
        const MemoryLimit limit(bytes);
        work();
    } catch (const OutOfMemory& error) {
        return error.what();
    }
    return "not refused";
}

class MemoryCheck : public testing::Test {
protected:
    void SetUp() override {
        if (!can_limit_memory)
            GTEST_SKIP() << "sanitizers take all address space";
    }
};

TEST_F(MemoryCheck, RefusesThreads) {
    const auto scene = Room().build();
    RenderSettings settings;
    settings.method = Method::gpr;
    Render render(scene, scene->camera(), {32, 32}, settings);
    ThreadPool pool(4);
    const std::string text = refusal(2 << 20, [&] { render.pass(pool); });
    EXPECT_EQ(text.find("4 threads need "), 0u) << text;
    EXPECT_TRUE(render.pass(pool)); // the render is usable after the error
    EXPECT_GT(Render::bytes({32, 32}, settings, 5), Render::bytes({32, 32}, settings, 4));
}

TEST_F(MemoryCheck, RefusesABvh) {
    std::vector<Shape> shapes(1);
    shapes[0].mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    shapes[0].mesh.triangles.assign(1'000'000, glm::uvec3(0, 1, 2));
    const std::string text = refusal(50 << 20, [&] { Intersector intersector(shapes); });
    EXPECT_EQ(text.find("1000000 triangles in a BVH need 130 MiB of memory, and "), 0u) << text;
    const Intersector intersector(shapes);
    EXPECT_LT(intersector.bytes(), 136'000'000u); // memory kept after the build
}

TEST_F(MemoryCheck, RefusesAReconstruction) {
    const RgbImage black(640, 480);
    const GradientImages images{black, black, black, {}};
    Reconstructor reconstructor;
    const std::string text =
        refusal(10 << 20, [&] { reconstruct_checked(reconstructor, images, {Norm::weighted}); });
    EXPECT_EQ(text.find("640x480 pixels reconstructed by weighted need 38 MiB of memory, and "), 0u) << text;
    EXPECT_EQ(reconstruct_checked(reconstructor, images, {Norm::weighted}).image.width(), 640);
}

TEST_F(MemoryCheck, NamesWhatAnUnforeseenFailureNeeded) {
    const auto fail = [] { throw std::bad_alloc(); };
    EXPECT_EQ(refusal(1 << 30, [&] { with_memory_for("the scene box.xml", fail); }),
              "there is not enough memory for the scene box.xml");
    EXPECT_EQ(message_of(std::bad_alloc()), "there is not enough memory");
    EXPECT_EQ(message_of(std::runtime_error("broken")), "broken");
}

} // namespace

} // namespace tessera::test
