#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

namespace tessera {

/// The purposes for which a path draws random numbers at one vertex. Every purpose has its own dimension, so
/// that a path drawn again takes the same numbers whatever it skips.
enum class Draw : std::uint32_t {
    emitter, ///< for light sample j > 0 of a vertex: of that many times 65 vertices further on
             ///< (Tracer::sample_light)
    emitter_position,
    emitter_cell,
    lobe,
    direction,
    path_survival,   ///< roulette on path length
    reuse_survival,  ///< roulette on reuse
    weight_survival, ///< roulette on small weights; a slot in place of a vertex
    count
};

/// Random numbers as a function of (seed, pixel, sample, vertex, purpose): no state, so the picture is the same
/// for any number of threads and any order of work. SplitMix64 [Steele 2014] with the path's key as its start.
class Random {
public:
    Random(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample)
        : key_(mix(mix(seed + 0x9e3779b97f4a7c15u) ^ (std::uint64_t{sample} << 32 | pixel))) {}

    /// Uniform in [0, 1).
    float draw(int vertex, Draw purpose) const {
        return to_unit(static_cast<std::uint32_t>(bits(vertex, purpose) >> 32));
    }

    /// Uniform in [0, 1)^2.
    glm::vec2 draw_2d(int vertex, Draw purpose) const {
        const std::uint64_t b = bits(vertex, purpose);
        return {to_unit(static_cast<std::uint32_t>(b >> 32)), to_unit(static_cast<std::uint32_t>(b))};
    }

    static std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

private:
    static float to_unit(std::uint32_t b) { return static_cast<float>(b >> 8) * 0x1p-24f; }

    std::uint64_t bits(int vertex, Draw purpose) const {
        const auto dimension = static_cast<std::uint64_t>(vertex) * static_cast<std::uint64_t>(Draw::count) +
                               static_cast<std::uint64_t>(purpose) + 1;
        return mix(key_ + dimension * 0x9e3779b97f4a7c15u);
    }

    std::uint64_t key_;
};

} // namespace tessera
