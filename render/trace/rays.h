// Rays and segments, and arrays of them with one lane per pixel.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

namespace tessera {

struct Ray {
    glm::vec3 origin;
    glm::vec3 direction; ///< unit
};

// Lane arrays have one lane per pixel of a sampling set, for loops that the compiler vectorises. Loops run over
// whole vectors, up to padded(count). No result depends on the lanes from `count` on.

inline constexpr int lanes_per_vector = 8;
/// Capacity of lane arrays: at least the pixels of the largest sampling set (checked in
/// render/estimator/path_reuse.cpp).
inline constexpr int most_lanes = 37 * lanes_per_vector;

inline int padded(int lanes) {
    return (lanes + lanes_per_vector - 1) / lanes_per_vector * lanes_per_vector;
}

template <class T>
struct alignas(64) LaneArray {
    std::array<T, most_lanes> values{};

    T& operator[](int lane) { return values[lane]; }
    const T& operator[](int lane) const { return values[lane]; }
};

using FloatLanes = LaneArray<float>;
using LaneMask = LaneArray<std::int32_t>; ///< -1: true, 0: false

struct Vec3Lanes {
    FloatLanes x, y, z;

    glm::vec3 operator[](int lane) const { return {x[lane], y[lane], z[lane]}; }
    void set(int lane, glm::vec3 v) {
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
};

/// Segments that are tested for occlusion, without their end points.
struct SegmentLanes {
    Vec3Lanes from, to;
};

} // namespace tessera
