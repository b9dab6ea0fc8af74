#pragma once

#include "render/sampling/random.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// The random numbers of a pass: where in their pixels and on the lens its paths begin, and those that they draw.
/// The former, and what is drawn at x_1, are nets over the passes; each of these has the point of the pass, with
/// digits turned over by a pattern of the pixel's own, or of those that begin at the same place. The patterns at
/// x_1 are nets as well, over blocks of pixels.
class PassNumbers {
public:
    /// @param begin_at_x1  pass with which the nets at x_1 begin. It selects the net, so that the points are
    ///                     independent of all that earlier passes have learnt. The nets of positions begin with
    ///                     pass 0.
    /// @param positions  camera positions from which a pass sees some pixels. They have a net of their own, with
    ///                   as many points for each pass.
    PassNumbers(std::uint64_t seed, int pass, int begin_at_x1, int positions)
        : seed_(seed), pass_(pass), begin_at_x1_(begin_at_x1), only_{point({0, 0}, 0), point({0, 1}, 0)},
          first_turn_(static_cast<int>(Random::mix(Random::mix(seed + 2) + static_cast<std::uint64_t>(pass)) %
                                       static_cast<std::uint64_t>(positions))),
          block_key_(Random::mix(Random::mix(seed + 4) + static_cast<std::uint64_t>(begin_at_x1))),
          first_block_(block_key_ % block_size, (block_key_ >> 32) % block_size) {
        for (int i = 0; i < positions; ++i)
            several_.push_back(position(i, positions));
        for (std::size_t v = 0; v < variants; ++v)
            for (std::size_t i = 0; i < at_x1_[v].size(); ++i)
                at_x1_[v][i] = point({begin_at_x1, positions_of_nets + i}, v);
        for (std::size_t pixel = 0; pixel < of_pixels_.size(); ++pixel)
            for (std::size_t i = 0; i < of_pixels_[pixel].size(); ++i)
                of_pixels_[pixel][i] =
                    net_point(static_cast<std::uint32_t>(pixel), Random::mix(block_key_ - 1 - i));
    }

    /// In place of the number of a position: that of the pixels that the pass sees from one.
    static constexpr int only = -1;

    /// Within a pixel, uniform in [0, 1)^2.
    /// @param place     a number of those that begin there
    /// @param path      of several of a pixel; each has numbers of its own
    /// @param position  of several from which a pixel is seen; or `only`
    glm::vec2 subpixel(std::uint32_t place, int path, int position = only) const {
        return unit_square(at(position).subpixel ^ shift_of(place, path).digits(0, Draw::direction));
    }
    /// Uniform in [0, 1)^2, to be mapped to the lens.
    glm::vec2 lens(std::uint32_t place, int path, int position = only) const {
        return unit_square(at(position).lens ^ shift_of(place, path).digits(1, Draw::direction));
    }
    /// At which of several positions the base path of a pixel is shared: any is as likely, whatever the numbers
    /// are, and pixels side by side have different ones (a lattice of rank 1).
    int turn(glm::ivec2 pixel) const {
        const int count = static_cast<int>(several_.size()), row = (3 * count + 4) / 8;
        return (pixel.x + row * pixel.y + first_turn_) % count;
    }
    /// Those that a pixel's path draws. At x_1 they are points of the pass, whose digits are turned over by points
    /// of a second net, over a block of pixels in Z-order [Morton 1966]: of these aligned squares of 2x2, 4x4, 8x8
    /// and 16x16 are spread evenly in each pass, and each pixel over the passes. Of two nets taken together some
    /// effects are measured worse than by chance, and others exactly; so nets of two purposes have one of several
    /// variants in each block, which have nothing to do with each other, and another order there; and where a
    /// choice is made, and something drawn of what is chosen, rows and columns are exchanged.
    Random of_path(glm::ivec2 pixel, int path) const {
        const glm::ivec2 place = pixel + first_block_, within = place % block_size;
        const auto block = static_cast<std::uint32_t>(place.y / block_size) << 16 |
                           static_cast<std::uint32_t>(place.x / block_size);
        const std::size_t of_choices = z_order(within.x) | z_order(within.y) << 1,
                          of_others = z_order(within.y) | z_order(within.x) << 1;
        Random::Points points;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::uint64_t of_block = Random::mix(block_key_ + std::uint64_t{block} * points.size() + i);
            const std::size_t turned = (of_block >> 32) % of_pixels_.size();
            const std::size_t order = is_choice(static_cast<Draw>(i)) ? of_choices : of_others;
            points[i] = at_x1_[of_block % variants][i] ^ of_pixels_[order ^ turned][i];
        }
        return {seed_of(path), pixel_number(pixel), static_cast<std::uint32_t>(pass_),
                Random::Net{block, static_cast<std::uint32_t>(begin_at_x1_), points}};
    }

private:
    static constexpr int block_size = 16;

    static bool is_choice(Draw purpose) { return purpose == Draw::emitter || purpose == Draw::lobe; }

    /// The digits, each two places apart.
    static std::size_t z_order(int i) {
        const auto digits = static_cast<std::size_t>(i);
        return (digits & 1) | (digits & 2) << 1 | (digits & 4) << 2 | (digits & 8) << 3;
    }

    static constexpr std::size_t variants = 16, positions_of_nets = 2,
                                 nets = positions_of_nets + std::tuple_size_v<Random::Points>;

    /// Digits of points, as net_point() has them.
    struct Position {
        std::uint64_t subpixel, lens;
    };

    struct Net {
        int begin;
        std::size_t number; ///< of those that begin with the pass
    };

    std::uint64_t point(Net net, std::uint64_t variant) const {
        const std::uint64_t number = static_cast<std::uint64_t>(net.begin) * nets + net.number;
        return net_point(static_cast<std::uint32_t>(pass_ - net.begin),
                         Random::mix(Random::mix(seed_ + 1) + number) + variant);
    }

    const Position& at(int position) const { return position == only ? only_ : several_[position]; }
    Position position(int i, int count) const {
        const auto index = static_cast<std::uint32_t>(pass_ * count + i);
        const std::uint64_t key = Random::mix(seed_ + 3);
        return {net_point(index, Random::mix(key)), net_point(index, Random::mix(key + 1))};
    }

    std::uint64_t seed_of(int path) const {
        return seed_ ^ static_cast<std::uint64_t>(path) * 0x6f77'6e20'7061'7468u;
    }

    Random shift_of(std::uint32_t place, int path) const {
        return {Random::mix(seed_of(path)), place, 0xfffffffdu}; // no pass
    }

    std::uint64_t seed_;
    int pass_;
    int begin_at_x1_;
    Position only_;
    std::vector<Position> several_;
    int first_turn_;
    std::uint64_t block_key_;
    glm::ivec2 first_block_; ///< how far the grid of blocks is moved to the left, and up: another way for each net
    std::array<Random::Points, variants> at_x1_;
    std::array<Random::Points, block_size * block_size> of_pixels_; ///< patterns
};

} // namespace tessera
