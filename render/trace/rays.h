// Rays and segments, one at a time and side by side in lanes.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

namespace tessera {

struct Ray {
    glm::vec3 origin;
    glm::vec3 direction; ///< unit
};

/// Numbers side by side, one a pixel of a sampling set, for loops that the compiler turns into vector code. Loops
/// run over whole vectors, to padded(count): what lies in the lanes beyond is never read for a result.
inline constexpr int lanes_a_vector = 8;
/// As many as the largest sampling set has pixels, and more (render/estimator/path_reuse.cpp sees to it).
inline constexpr int most_lanes = 37 * lanes_a_vector;

inline int padded(int lanes) {
    return (lanes + lanes_a_vector - 1) / lanes_a_vector * lanes_a_vector;
}

template <class T>
struct alignas(64) LaneArray {
    std::array<T, most_lanes> values{};

    T& operator[](int lane) { return values[lane]; }
    const T& operator[](int lane) const { return values[lane]; }
};

using FloatLanes = LaneArray<float>;
using LaneMask = LaneArray<std::int32_t>; ///< -1: yes, 0: no

struct Vec3Lanes {
    FloatLanes x, y, z;

    glm::vec3 operator[](int lane) const { return {x[lane], y[lane], z[lane]}; }
    void set(int lane, glm::vec3 v) {
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
};

/// Stretches of space that light must cross, open at both ends.
struct SegmentLanes {
    Vec3Lanes from, to;
};

} // namespace tessera
