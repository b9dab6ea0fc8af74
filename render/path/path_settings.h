#pragma once

#include <cstdint>

namespace tessera {

inline constexpr int most_edges = 64; ///< of a light path

/// What decides how far base paths go and what they look for.
struct PathSettings {
    int max_depth = 8;      ///< edges of a light path; 1: emission only [1, 64]
    int light_samples = 1;  ///< points on lights drawn at every vertex [1, 16]
    int roulette_depth = 0; ///< edges beyond which a path goes on by Russian roulette; 0: never by it [0, 64]

    bool operator==(const PathSettings&) const = default;
};

/// How a base path is taken to another pixel.
enum class ShiftKind : std::uint8_t {
    half_vector,        ///< half vectors are copied until two vertices can be connected [Kettunen 2015]
    reconnection,       ///< x_1 to x_2 alone; direct light stays where it is [Bekaert 2002]
    replay,             ///< the offset takes the same random numbers, all the way [Hua 2019, 3.1]
    replay_reconnection ///< random numbers are replayed until two vertices can be connected [Hua 2019, 3.1]
};

struct ShiftSettings {
    ShiftKind shift = ShiftKind::half_vector;
    float shift_threshold = 0.001f; ///< roughness above which a vertex is connectable [Kettunen 2015] [0, 1]
    float shift_distance = 6;       ///< least length of an edge that is joined, in pixels' widths at x_1 [0, 1000]

    bool operator==(const ShiftSettings&) const = default;
};

} // namespace tessera
