#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>

namespace tessera {

/// Purposes for which a path draws random numbers at one vertex. Every purpose has its own dimension, so a
/// replayed path takes the same numbers even if it skips some.
enum class Draw : std::uint32_t {
    emitter,
    emitter_position,
    emitter_cell,
    lobe,
    direction,
    path_survival,  ///< roulette on path length
    reuse_survival, ///< roulette on reuse
    count = 8       ///< dimensions per vertex; another value changes the random numbers of all pictures
};

/// Converts 64 binary digits to two numbers in [0, 1): x from the upper half, y from the lower.
inline glm::vec2 unit_square(std::uint64_t digits) {
    const auto to_unit = [](std::uint32_t b) { return static_cast<float>(b >> 8) * 0x1p-24f; };
    return {to_unit(static_cast<std::uint32_t>(digits >> 32)), to_unit(static_cast<std::uint32_t>(digits))};
}

/// Returns the key of a pixel for random numbers, unique for coordinates in [-2^15, 2^15). It does not depend on
/// the size of the image, so the common pixels of two images have the same samples.
inline std::uint32_t pixel_number(glm::ivec2 pixel) {
    return (static_cast<std::uint32_t>(pixel.y) & 0xffffu) << 16 | (static_cast<std::uint32_t>(pixel.x) & 0xffffu);
}

/// Random numbers as a function of (seed, pixel, sample, vertex, purpose). There is no state, so the picture is
/// the same for any number of threads and any order of work. SplitMix64 [Steele 2014] that starts at the path's
/// key.
class Random {
public:
    /// Digits of one net_point() for each purpose at x_1 up to Draw::direction.
    using Points = std::array<std::uint64_t, static_cast<std::size_t>(Draw::direction) + 1>;

    Random(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample)
        : key_(key(seed, pixel, sample)), key_at_x1_(key_), points_{} {}

    /// Numbers at x_1 that are nets over samples, over pixels, or over both.
    struct Net {
        std::uint32_t block; ///< block of pixels; each has its own digital shift (exclusive or) for each purpose
        std::uint32_t begin; ///< first sample of the net
        Points points;       ///< of this sample and pixel
    };
    /// Takes the numbers at x_1 from `net`; all others are the same as without a net.
    Random(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, const Net& net)
        : key_(key(seed, pixel, sample)), key_at_x1_(key(seed ^ 0x7831'7831'7831'7831u, net.block, net.begin)),
          points_(net.points) {}

    /// Returns a number that is uniform in [0, 1).
    float draw(int vertex, Draw purpose) const { return draw_2d(vertex, purpose).x; }

    /// Returns a point that is uniform in [0, 1)^2.
    glm::vec2 draw_2d(int vertex, Draw purpose) const { return unit_square(digits(vertex, purpose)); }

    /// Returns 64 random bits.
    std::uint64_t digits(int vertex, Draw purpose) const {
        const auto dimension = static_cast<std::uint64_t>(vertex) * static_cast<std::uint64_t>(Draw::count) +
                               static_cast<std::uint64_t>(purpose) + 1;
        if (vertex == 1 && purpose <= Draw::direction)
            return mix(key_at_x1_ + dimension * step) ^ points_[static_cast<std::size_t>(purpose)];
        return mix(key_ + dimension * step);
    }

    /// Scrambles all bits.
    static std::uint64_t mix(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

private:
    static constexpr std::uint64_t step = 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio

    static std::uint64_t key(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample) {
        return mix(mix(seed + step) ^ (std::uint64_t{sample} << 32 | pixel));
    }

    std::uint64_t key_, key_at_x1_;
    Points points_;
};

inline std::uint32_t reversed(std::uint32_t bits) {
    bits = bits >> 16 | bits << 16;
    bits = (bits & 0xff00ff00u) >> 8 | (bits & 0x00ff00ffu) << 8;
    bits = (bits & 0xf0f0f0f0u) >> 4 | (bits & 0x0f0f0f0fu) << 4;
    bits = (bits & 0xccccccccu) >> 2 | (bits & 0x33333333u) << 2;
    return (bits & 0xaaaaaaaau) >> 1 | (bits & 0x55555555u) << 1;
}

/// Applies a nested uniform scramble [Owen 1995]: flips each digit depending on a hash of all digits before it.
/// Numbers with the same first n digits keep that property [Laine and Karras 2011, constants of Burley 2020].
inline std::uint32_t scrambled(std::uint32_t digits, std::uint32_t key) {
    std::uint32_t x = reversed(digits) + key;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversed(x);
}

/// Returns point `index` of a scrambled (0, 2)-sequence [Sobol 1967], as digits for unit_square(). The 2^n points
/// from a multiple of 2^n on are stratified: each of the 2^n equal rectangles of any one shape, made by repeated
/// halving of the square, contains one point. The order is shuffled within blocks of 2^n points, so sequences
/// with different keys are uncorrelated [Burley 2020]. Two sequences together are no net, and pairs of their
/// first digits can be less uniform than independent pairs. A digital shift, the exclusive or of all points with
/// one pattern, keeps these properties.
inline std::uint64_t net_point(std::uint32_t index, std::uint64_t key) {
    const std::uint64_t order = Random::mix(2 * key + 1), keys = Random::mix(2 * key + 2);
    const std::uint32_t i = scrambled(index, static_cast<std::uint32_t>(order));
    std::uint32_t y = 0, column = 1u << 31; // of the matrix of y, Pascal's triangle modulo 2
    for (std::uint32_t digits = i; digits != 0; digits >>= 1, column ^= column >> 1)
        y ^= digits & 1 ? column : 0;
    return std::uint64_t{scrambled(reversed(i), static_cast<std::uint32_t>(keys >> 32))} << 32 |
           scrambled(y, static_cast<std::uint32_t>(keys));
}

} // namespace tessera
