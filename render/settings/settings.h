#pragma once

#include "recon/enumeration.h"

#include <cstdint>
#include <iterator>
#include <string_view>

namespace tessera {

inline constexpr int most_edges = 64; ///< of a light path
inline constexpr int most_tile = 16;  ///< pixels along a tile's edge

/// Camera positions from which a pass sees a pixel with several surfaces, if it reuses paths. In equal time, three
/// and four positions do not lower the error further (TRIALS.md, "Several positions").
inline constexpr int edge_positions = 2;
/// Camera rays of a sample in a pixel with the edge of a directly visible emitter. In the Bathroom at 16 samples a
/// pixel, one ray has 1.1 (PT) and 1.8 (G-PR) times the relMSE of a grid of sixteen (RESULTS.md,
/// very_direct_rays=1,16).
inline constexpr int edge_emitter_rays = 16;

/// Over what textures of reflectances, and lamps that the camera sees, are filtered.
enum class TextureFilter : std::uint8_t {
    off,    ///< points, as Mitsuba has it
    camera, ///< what a pixel covers if the camera sees it
    path    ///< the same, but in mirrors and through glass what it covers there
};

/// Whether directions are also drawn from where earlier passes found light.
enum class Guiding : std::uint8_t {
    off,
    where_it_pays, ///< in scenes where samples tell that it brings more than it costs
    on             ///< in every scene, where a place's own samples do not tell otherwise
};

/// What decides how far base paths go and what they look for.
struct PathSettings {
    int max_depth = 8;      ///< edges of a light path; 1: emission only
    int roulette_depth = 3; ///< edges beyond which a path goes on by Russian roulette; 0: never by it
    TextureFilter filter_textures = TextureFilter::off;
    Guiding path_guiding = Guiding::where_it_pays;

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
    float shift_threshold =
        0.001f; ///< roughness above which a vertex is connectable [Kettunen 2015]; no option changes it
    float shift_distance = 6; ///< least length of an edge that is joined, in pixels' widths at its beginning

    bool operator==(const ShiftSettings&) const = default;
};

enum class Method : std::uint8_t { pt, pr, gpt, gpr };
inline constexpr Method all_methods[] = {Method::pt, Method::pr, Method::gpt, Method::gpr};
static_assert(std::size(all_methods) == enumerator_count<Method>);

/// The method's name on the command line: "pt", "pr", "gpt" or "gpr".
std::string_view short_name(Method method);
/// The method's name in the panel, such as "Path tracing".
std::string_view long_name(Method method);

/// Which pixels share their paths in PR. (G-PR needs neighbours, and so the tile.)
enum class Pattern : std::uint8_t {
    tile, ///< a square of `tile` x `tile` pixels
    rooks ///< `tile` pixels on a square of that edge, one in each row and column [Bekaert 2002]
};

/// What decides on the probability with which a base path is reused.
enum class RouletteKind : std::uint8_t {
    relative, ///< its luminance relative to the noise of its sampling set (reuse_roulette.h)
    absolute, ///< its luminance against rr_delta [Bauszat 2017, 3.3]
    none      ///< every path is reused
};

/// What of a pixel's radiance primal and gradients are made of [Fang 2024].
enum class Basis : std::uint8_t {
    none,   ///< the radiance itself
    albedo, ///< the radiance over the albedo of what the pixel sees
    sh1,    ///< that in parts, by what arrives in spherical harmonics of degree 0 and 1
    sh2,    ///< up to degree 2
    sh3,    ///< up to degree 3
    box     ///< in nine parts of the sphere
};

/// Everything beside the scene, the camera and the size that decides the picture's bits. What each setting is
/// called, and its limits: settings_table.h.
struct RenderSettings : PathSettings, ShiftSettings {
    Method method = Method::gpr;
    int tile = 6;           ///< pixels along a tile's edge [1, most_tile]
    bool adapt_tile = true; ///< adaptive tile splitting (learned_reuse.h)
    Pattern pattern = Pattern::tile;
    RouletteKind roulette = RouletteKind::relative;
    float rr_delta = 0.1f; ///< absolute roulette's delta, a radiance
    bool edge_rays =
        true; ///< several camera rays per sample at edges: edge_positions and edge_emitter_rays, or one
    Basis basis = Basis::albedo;
    std::uint64_t seed = 0;

    bool operator==(const RenderSettings&) const = default;
};

/// Whether the method measures gradients.
inline bool has_gradients(Method method) {
    return method == Method::gpt || method == Method::gpr;
}

/// Whether its pixels share the light of base paths by tiles or patterns.
inline bool reuses_paths(Method method) {
    return method == Method::pr || method == Method::gpr;
}

/// Whether what it measures is divided by albedos. (PT has nothing that could gain by it.)
inline bool is_demodulated(const RenderSettings& s) {
    return s.method != Method::pt && s.basis != Basis::none;
}

/// Whether it is measured in parts. (PR's picture needs no gradients, and so no parts.)
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

/// Whether its tiles can be cut into smaller ones: N-rooks patterns cannot.
inline bool has_tiles_to_cut(const RenderSettings& s) {
    return s.method == Method::gpr || (s.method == Method::pr && s.pattern == Pattern::tile);
}

/// Returns whether the pilot pass measures the gain of path reuse (learned_reuse.h). It measures gradients, and
/// basis components do not support pixels without reuse.
inline bool finds_gain_of_sharing(const RenderSettings& s) {
    return s.method == Method::gpr && s.adapt_tile && s.tile > 1 && !is_expanded(s);
}

} // namespace tessera
