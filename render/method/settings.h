#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace tessera {

enum class Method : std::uint8_t { pt, pr, gpt, gpr };
inline constexpr Method all_methods[] = {Method::pt, Method::pr, Method::gpt, Method::gpr};

/// "pt", "pr", "gpt", "gpr": the names of the command line.
std::string_view short_name(Method method);
/// "Path tracing", ...: the names of the panel.
std::string_view long_name(Method method);
/// Empty: no such method.
std::optional<Method> method_from_name(std::string_view short_name);

/// Everything beside the scene, the camera and the size that decides the picture's bits.
struct RenderSettings {
    Method method = Method::gpr;
    int max_depth = 8;     ///< edges of a light path; 1: emission only [1, 64]
    int tile = 6;          ///< pixels along a tile's edge [1, 16]
    float rr_delta = 0.1f; ///< reuse roulette's delta, a radiance [Bauszat 2017, 3.3]; 0: every path is reused
    float q_min = 0.1f;    ///< least probability that a path is reused (0, 1]
    float shift_threshold = 0.001f; ///< roughness above which a vertex is connectable [Kettunen 2015]
    std::uint64_t seed = 0;

    bool operator==(const RenderSettings&) const = default;
};

/// Whether the method measures gradients.
inline bool has_gradients(Method method) {
    return method == Method::gpt || method == Method::gpr;
}

} // namespace tessera
