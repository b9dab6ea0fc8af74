#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>

namespace tessera {

/// The purposes for which a path draws random numbers at one vertex. Every purpose has its own dimension, so
/// that a path drawn again takes the same numbers whatever it skips.
enum class Draw : std::uint32_t {
    emitter,
    emitter_position,
    emitter_cell,
    lobe,
    direction,
    path_survival,  ///< roulette on path length
    reuse_survival, ///< roulette on reuse
    count = 8       ///< dimensions of a vertex; another value changes the random numbers of all pictures
};

/// Two numbers in [0, 1) by 32 digits each in base 2: x in the upper half, y in the lower.
inline glm::vec2 unit_square(std::uint64_t digits) {
    const auto to_unit = [](std::uint32_t b) { return static_cast<float>(b >> 8) * 0x1p-24f; };
    return {to_unit(static_cast<std::uint32_t>(digits >> 32)), to_unit(static_cast<std::uint32_t>(digits))};
}

/// The number of a pixel that random numbers depend on. It does not depend on the size of the image, so that a
/// wider image has the same samples in the pixels that both have. Unique for coordinates in [-2^15, 2^15).
inline std::uint32_t pixel_number(glm::ivec2 pixel) {
    return (static_cast<std::uint32_t>(pixel.y) & 0xffffu) << 16 | (static_cast<std::uint32_t>(pixel.x) & 0xffffu);
}

/// Random numbers as a function of (seed, pixel, sample, vertex, purpose): no state, so the picture is the same
/// for any number of threads and any order of work. SplitMix64 [Steele 2014] with the path's key as its start.
class Random {
public:
    /// What is drawn at x_1, up to the direction in which a path goes on: for each purpose the digits of a point,
    /// as net_point() has them.
    using Points = std::array<std::uint64_t, static_cast<std::size_t>(Draw::direction) + 1>;

    Random(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample)
        : key_(key(seed, pixel, sample)), key_at_x1_(key_), points_{} {}

    /// What is drawn at x_1 where that is a net over samples, or over pixels, or both.
    struct Net {
        std::uint32_t
            block; ///< of pixels; each has patterns of its own for each net, by which digits are turned over
        std::uint32_t begin; ///< the first sample
        Points points;       ///< of the sample and the pixel, in the block
    };
    /// The other numbers are as without.
    Random(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, const Net& net)
        : key_(key(seed, pixel, sample)), key_at_x1_(key(seed ^ 0x7831'7831'7831'7831u, net.block, net.begin)),
          points_(net.points) {}

    /// Uniform in [0, 1).
    float draw(int vertex, Draw purpose) const { return draw_2d(vertex, purpose).x; }

    /// Uniform in [0, 1)^2.
    glm::vec2 draw_2d(int vertex, Draw purpose) const { return unit_square(digits(vertex, purpose)); }

    /// 64 random bits.
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
    static constexpr std::uint64_t step = 0x9e3779b97f4a7c15u; // the golden ratio's digits

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

/// A nested uniform scramble [Owen 1995]: turns each digit over or not, by a hash of all digits before it, so that
/// numbers alike in their first n digits stay so [Laine and Karras 2011, with the constants of Burley 2020].
inline std::uint32_t scrambled(std::uint32_t digits, std::uint32_t key) {
    std::uint32_t x = reversed(digits) + key;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reversed(x);
}

/// The digits, as unit_square() takes them, of point `index` of a (0, 2)-sequence [Sobol 1967]: of 2^n points in a
/// row, from a multiple of 2^n on, there is one in each of the 2^n rectangles of any one shape into which halving
/// cuts the square. Scrambled, in an order that is shuffled by blocks of 2^n: points of two keys, taken together,
/// are uncorrelated [Burley 2020], but no net; first digits, which differ in all points 2 k and 2 k + 1, go
/// together more or less evenly than by chance. The same holds with all points' digits turned over by one pattern
/// (exclusive or).
inline std::uint64_t net_point(std::uint32_t index, std::uint64_t key) {
    const std::uint64_t order = Random::mix(2 * key + 1), keys = Random::mix(2 * key + 2);
    const std::uint32_t i = scrambled(index, static_cast<std::uint32_t>(order));
    std::uint32_t y = 0, column = 1u << 31; // of Pascal's triangle modulo 2, the second dimension's matrix
    for (std::uint32_t digits = i; digits != 0; digits >>= 1, column ^= column >> 1)
        y ^= digits & 1 ? column : 0;
    return std::uint64_t{scrambled(reversed(i), static_cast<std::uint32_t>(keys >> 32))} << 32 |
           scrambled(y, static_cast<std::uint32_t>(keys));
}

} // namespace tessera
