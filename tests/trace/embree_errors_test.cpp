// Errors inside Embree: no exception passes its C interface, and the program throws after Embree has returned.
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
Function* embree_function(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

} // namespace

// These functions replace those of Embree's library, because the dynamic linker prefers symbols of the program.
// They are noexcept, as C functions are for the compiler: an exception through them ends the program.
extern "C" {

__attribute__((visibility("default"))) void
rtcSetDeviceErrorFunction(void* device, void (*function)(void*, int, const char*), void* argument) noexcept {
    error_function = function;
    error_argument = argument;
    embree_function<void(void*, void (*)(void*, int, const char*), void*)>("rtcSetDeviceErrorFunction")(
        device, function, argument);
}

__attribute__((visibility("default"))) void rtcCommitScene(void* scene) noexcept {
    embree_function<void(void*)>("rtcCommitScene")(scene);
    if (commits_fail) {
        error_function(error_argument, 4, "out of memory");
        error_function(error_argument, 1, "a consequence of the first error");
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

TEST(EmbreeErrors, AreThrownAfterEmbreeHasReturned) {
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
    EXPECT_TRUE(Intersector(shapes).closest({{0.2f, 0.2f, 1}, {0, 0, -1}}, hit)); // later objects work
}

struct Unexpected {};

/// An exception of a monitor reaches the caller unchanged, and not as an error of Embree.
TEST(EmbreeErrors, PassOnExceptionsOfAMonitor) {
    const std::vector<Shape> shapes = triangle();
    const BuildMonitor monitor([](double) -> bool { throw Unexpected(); });
    EXPECT_THROW(Intersector{shapes}, Unexpected);
}

} // namespace

} // namespace tessera::test
