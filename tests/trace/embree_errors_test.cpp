// What goes wrong while Embree works: nothing is thrown through its C interface, and it is told afterwards.
#include "render/trace/intersector.h"

#include <stdexcept>
#include <string>

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

void (*error_function)(void*, int, const char*) = nullptr;
void* error_argument = nullptr;
bool commits_fail = false;

template <class Function>
Function* embrees_own(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

} // namespace

// The program's functions come before those of Embree's library. These are C, as far as the compiler is told: it
// ends the program where an exception would pass.
extern "C" {

__attribute__((visibility("default"))) void
rtcSetDeviceErrorFunction(void* device, void (*function)(void*, int, const char*), void* argument) noexcept {
    error_function = function;
    error_argument = argument;
    embrees_own<void(void*, void (*)(void*, int, const char*), void*)>("rtcSetDeviceErrorFunction")(
        device, function, argument);
}

__attribute__((visibility("default"))) void rtcCommitScene(void* scene) noexcept {
    embrees_own<void(void*)>("rtcCommitScene")(scene);
    if (commits_fail) {
        error_function(error_argument, 4, "out of memory");
        error_function(error_argument, 1, "and what follows from it");
    }
}
}

namespace tessera::test {

namespace {

std::vector<Shape> triangle() {
    std::vector<Shape> shapes(1);
    shapes[0].mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    shapes[0].mesh.triangles = {{0, 1, 2}};
    return shapes;
}

TEST(EmbreeErrors, AreThrownOnceEmbreeHasReturned) {
    const std::vector<Shape> shapes = triangle();
    commits_fail = true;
    std::string message;
    try {
        const Intersector intersector(shapes);
    } catch (const std::runtime_error& error) {
        message = error.what();
    }
    commits_fail = false;
    EXPECT_EQ(message, "there is not enough memory for the BVH");
    Hit hit;
    EXPECT_TRUE(Intersector(shapes).closest({{0.2f, 0.2f, 1}, {0, 0, -1}}, hit)); // another one is none the worse
}

struct Unexpected {};

/// What a monitor throws comes out as it is, and not as an error of Embree's.
TEST(EmbreeErrors, AMonitorMayThrow) {
    const std::vector<Shape> shapes = triangle();
    const BuildMonitor monitor([](double) -> bool { throw Unexpected(); });
    EXPECT_THROW(Intersector{shapes}, Unexpected);
}

} // namespace

} // namespace tessera::test
