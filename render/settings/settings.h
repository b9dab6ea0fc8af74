#pragma once

#include "recon/enumeration.h"

#include <cstdint>
#include <iterator>
#include <string_view>

namespace tessera {

inline constexpr int most_edges = 64; ///< limit of max_depth
inline constexpr int most_tile = 16;  ///< limit of tile

/// Camera positions from which a pass sees a pixel with several surfaces, if it reuses paths; n of theory (20).
/// Three and four positions do not lower the error at equal time (docs/decisions.md).
inline constexpr int edge_positions = 2;
/// Camera rays of a sample in a pixel with the edge of a directly visible emitter. With one ray, relMSE is larger
/// (docs/decisions.md).
inline constexpr int edge_emitter_rays = 16;

/// Footprint over which textures of reflectance and of directly visible emitters are averaged.
enum class TextureFilter : std::uint8_t {
    off,    ///< none: textures are looked up at points, as in Mitsuba
    camera, ///< that of a pixel which sees the point directly
    path    ///< the same, but in mirrors and through glass that of the pixel's own path
};

/// Whether guides, learned from earlier passes, draw some of the directions.
enum class Guiding : std::uint8_t {
    off,
    automatic, ///< in scenes where samples show that the gain exceeds the cost
    on         ///< in every scene, except in cells where samples show no gain
};

/// Settings of base paths.
struct PathSettings {
    int max_depth = 8;      ///< limit on the edges of a light path; 1: directly visible emission only
    int roulette_depth = 3; ///< edges after which Russian roulette on path length begins; 0: no roulette
    TextureFilter filter_textures = TextureFilter::off;
    Guiding path_guiding = Guiding::automatic;

    bool operator==(const PathSettings&) const = default;
};

/// The shift of a base path to another pixel.
enum class ShiftKind : std::uint8_t {
    half_vector,        ///< half vectors are copied until two vertices can be connected [Kettunen 2015]
    reconnection,       ///< x_1 is connected to x_2; direct light is not shifted [Bekaert 2002]
    replay,             ///< the whole offset path uses the base path's random numbers [Hua 2019, 3.1]
    replay_reconnection ///< random numbers are replayed until two vertices can be connected [Hua 2019, 3.1]
};

struct ShiftSettings {
    ShiftKind shift = ShiftKind::half_vector;
    /// Roughness above which a vertex is connectable [Kettunen 2015]. No option changes it.
    float shift_threshold = 0.001f;
    /// Assumed distance of the pixels of a sampling set, in pixel widths: the 6 of theory (16).
    float shift_distance = 6;

    bool operator==(const ShiftSettings&) const = default;
};

enum class Method : std::uint8_t { pt, pr, gpt, gpr };
inline constexpr Method all_methods[] = {Method::pt, Method::pr, Method::gpt, Method::gpr};
static_assert(std::size(all_methods) == enumerator_count<Method>);

/// Returns the method's name on the command line: "pt", "pr", "gpt" or "gpr".
std::string_view short_name(Method method);
/// Returns the method's name in the panel, such as "Path tracing".
std::string_view long_name(Method method);

/// Pixels that reuse each other's paths in PR. G-PR needs neighbours for its gradients, so it always has tiles.
enum class Pattern : std::uint8_t {
    tile, ///< a square of `tile` x `tile` pixels
    rooks ///< `tile` pixels of such a square, one in each row and column [Bekaert 2002]
};

/// Russian roulette on reuse: the threshold for the probability that a base path is reused.
enum class RouletteKind : std::uint8_t {
    relative, ///< the noise of the path's sampling set (reuse_roulette.h)
    absolute, ///< rr_delta [Bauszat 2017, 3.3]
    none      ///< none: every path is reused
};

/// Basis expansion: the quantity of which primal and gradients are measured [Fang 2024].
enum class Basis : std::uint8_t {
    none,   ///< the radiance itself
    albedo, ///< radiance divided by the albedo that the pixel sees, theory (27)
    sh1,    ///< components of that by incident direction, theory (31): spherical harmonics up to degree 1
    sh2,    ///< up to degree 2
    sh3,    ///< up to degree 3
    box     ///< nine boxes of equal solid angle
};

/// Reconstruction filter: the weight of a point in the value of a pixel (render/sampling/pixel_filter.h).
enum class FilterKind : std::uint8_t {
    box,
    tent,
    gaussian,
    mitchell,
    catmullrom,
    lanczos,
    scene ///< the filter of the scene's sensor
};

/// All settings that determine a picture's bits, besides scene, camera and size. Names and limits are in
/// settings_table.h.
struct RenderSettings : PathSettings, ShiftSettings {
    Method method = Method::gpr;
    int tile = 6;           ///< pixels along a tile's edge [1, most_tile]
    bool adapt_tile = true; ///< adaptive tile splitting (learned_reuse.h)
    Pattern pattern = Pattern::tile;
    RouletteKind roulette = RouletteKind::relative;
    float rr_delta = 0.1f; ///< threshold of the absolute roulette, a radiance
    bool edge_rays = true; ///< several camera rays per sample at edges (edge_positions, edge_emitter_rays)
    Basis basis = Basis::albedo;
    FilterKind filter = FilterKind::box;
    std::uint64_t seed = 0;

    bool operator==(const RenderSettings&) const = default;
};

/// Returns whether the method measures gradients.
inline bool has_gradients(Method method) {
    return method == Method::gpt || method == Method::gpr;
}

/// Returns whether base paths are reused within tiles or N-rooks patterns.
inline bool reuses_paths(Method method) {
    return method == Method::pr || method == Method::gpr;
}

/// Returns whether radiance is divided by albedos. PT neither reuses paths nor measures gradients, so it gains
/// nothing.
inline bool is_demodulated(const RenderSettings& s) {
    return s.method != Method::pt && s.basis != Basis::none;
}

/// Returns whether the basis has several components. PR has no gradients, and so no use for them.
inline bool is_expanded(const RenderSettings& s) {
    return has_gradients(s.method) && s.basis > Basis::albedo;
}

/// Returns the number of camera positions from which a pass sees a pixel with several surfaces.
inline int camera_positions(const RenderSettings& s) {
    return s.edge_rays ? edge_positions : 1;
}

/// Returns whether a pass sees some pixels from several camera positions. Only pixels that reuse paths do, because
/// each receives the light of many base paths. Coefficients of a basis expansion have one position.
inline bool has_positions(const RenderSettings& s) {
    return reuses_paths(s.method) && camera_positions(s) > 1 && !is_expanded(s);
}

/// Returns whether tiles can be split. N-rooks patterns cannot.
inline bool can_split_tiles(const RenderSettings& s) {
    return s.method == Method::gpr || (s.method == Method::pr && s.pattern == Pattern::tile);
}

/// Returns whether the pilot pass measures the gain of path reuse (learned_reuse.h). It measures gradients, and
/// basis components do not support pixels without reuse.
inline bool measures_reuse_gain(const RenderSettings& s) {
    return s.method == Method::gpr && s.adapt_tile && s.tile > 1 && !is_expanded(s);
}

} // namespace tessera
