#pragma once

#include "render/sampling/random.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// Random numbers of one pass: the positions of its camera rays in the pixel and on the lens, and the numbers
/// that its paths draw. Positions and the numbers at x_1 are nets over the passes. Every pixel uses the point of
/// the pass with a digital shift, the exclusive or with a pattern. Pixels with the same position share a pattern.
/// The patterns at x_1 are nets, too, over blocks of pixels.
class PassNumbers {
public:
    /// @param begin_at_x1  pass with which the nets at x_1 begin. It selects the net, so the points are
    ///                     independent of everything learned from earlier passes. The nets of positions begin
    ///                     with pass 0.
    /// @param positions  camera positions from which a pass sees some pixels. They have a net of their own, with
    ///                   as many points for each pass.
    PassNumbers(std::uint64_t seed, int pass, int begin_at_x1, int positions)
        : seed_(seed), pass_(pass), begin_at_x1_(begin_at_x1), only_{point({0, 0}, 0), point({0, 1}, 0)},
          first_turn_(static_cast<int>(Random::mix(Random::mix(seed + 2) + static_cast<std::uint64_t>(pass)) %
                                       static_cast<std::uint64_t>(positions))),
          block_key_(Random::mix(Random::mix(seed + 4) + static_cast<std::uint64_t>(begin_at_x1))),
          first_block_(block_key_ % block_size, (block_key_ >> 32) % block_size) {
        for (int i = 0; i < positions; ++i)
            positions_.push_back(position(i, positions));
        for (std::size_t v = 0; v < variants; ++v)
            for (std::size_t i = 0; i < pass_points_[v].size(); ++i)
                pass_points_[v][i] = point({begin_at_x1, positions_of_nets + i}, v);
        for (std::size_t pixel = 0; pixel < pixel_patterns_.size(); ++pixel)
            for (std::size_t i = 0; i < pixel_patterns_[pixel].size(); ++i)
                pixel_patterns_[pixel][i] =
                    net_point(static_cast<std::uint32_t>(pixel), Random::mix(block_key_ - 1 - i));
    }

    /// Stands for the position of pixels that the pass sees from one position.
    static constexpr int only = -1;

    /// Returns a point within the pixel, uniform in [0, 1)^2.
    /// @param place     key of all pixels with the same position
    /// @param path      index among several paths of a pixel; each has its own numbers
    /// @param position  index among several positions of a pixel; or `only`
    glm::vec2 subpixel(std::uint32_t place, int path, int position = only) const {
        return unit_square(at(position).subpixel ^ shift_of(place, path).digits(0, Draw::direction));
    }
    /// Returns a point on the lens, uniform in [0, 1)^2 before the map to the disk.
    glm::vec2 lens(std::uint32_t place, int path, int position = only) const {
        return unit_square(at(position).lens ^ shift_of(place, path).digits(1, Draw::direction));
    }
    /// Returns the position at which a pixel's base path is reused. All positions have the same probability,
    /// independent of all other numbers. Adjacent pixels have different positions (rank-1 lattice).
    int turn(glm::ivec2 pixel) const {
        const int count = static_cast<int>(positions_.size()), row = (3 * count + 4) / 8;
        return (pixel.x + row * pixel.y + first_turn_) % count;
    }
    /// Returns the numbers of a pixel's path. At x_1 they are points of the pass with digital shifts from a
    /// second net, over a block of 16x16 pixels in Z-order [Morton 1966, Ahmed 2020]. So aligned squares of 2x2,
    /// 4x4, 8x8 and 16x16 pixels are stratified in each pass, and each pixel is stratified over the passes. Two
    /// nets can be correlated, which raises the variance of some integrands. So each block draws, for each
    /// purpose, one of several independent variants of the net and an order of its pixels. Choices (of a light,
    /// of a lobe) exchange rows and columns of the block relative to the numbers used for the chosen item.
    Random of_path(glm::ivec2 pixel, int path) const {
        const glm::ivec2 place = pixel + first_block_, within = place % block_size;
        const auto block = static_cast<std::uint32_t>(place.y / block_size) << 16 |
                           static_cast<std::uint32_t>(place.x / block_size);
        const std::size_t choice_order = z_order(within.x) | z_order(within.y) << 1,
                          other_order = z_order(within.y) | z_order(within.x) << 1;
        Random::Points points;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::uint64_t block_hash = Random::mix(block_key_ + std::uint64_t{block} * points.size() + i);
            const std::size_t order_shift = (block_hash >> 32) % pixel_patterns_.size();
            const std::size_t order = is_choice(static_cast<Draw>(i)) ? choice_order : other_order;
            points[i] = pass_points_[block_hash % variants][i] ^ pixel_patterns_[order ^ order_shift][i];
        }
        return {seed_of(path), pixel_number(pixel), static_cast<std::uint32_t>(pass_),
                Random::Net{block, static_cast<std::uint32_t>(begin_at_x1_), points}};
    }

private:
    static constexpr int block_size = 16;

    static bool is_choice(Draw purpose) { return purpose == Draw::emitter || purpose == Draw::lobe; }

    /// Moves the four binary digits of i two places apart.
    static std::size_t z_order(int i) {
        const auto digits = static_cast<std::size_t>(i);
        return (digits & 1) | (digits & 2) << 1 | (digits & 4) << 2 | (digits & 8) << 3;
    }

    static constexpr std::size_t variants = 16, positions_of_nets = 2,
                                 nets = positions_of_nets + std::tuple_size_v<Random::Points>;

    /// Digits of net_point().
    struct Position {
        std::uint64_t subpixel, lens;
    };

    struct Net {
        int begin;
        std::size_t number; ///< index among the nets that begin with the pass
    };

    std::uint64_t point(Net net, std::uint64_t variant) const {
        const std::uint64_t number = static_cast<std::uint64_t>(net.begin) * nets + net.number;
        return net_point(static_cast<std::uint32_t>(pass_ - net.begin),
                         Random::mix(Random::mix(seed_ + 1) + number) + variant);
    }

    const Position& at(int position) const { return position == only ? only_ : positions_[position]; }
    Position position(int i, int count) const {
        const auto index = static_cast<std::uint32_t>(pass_ * count + i);
        const std::uint64_t key = Random::mix(seed_ + 3);
        return {net_point(index, Random::mix(key)), net_point(index, Random::mix(key + 1))};
    }

    std::uint64_t seed_of(int path) const {
        return seed_ ^ static_cast<std::uint64_t>(path) * 0x6f77'6e20'7061'7468u;
    }

    Random shift_of(std::uint32_t place, int path) const {
        return {Random::mix(seed_of(path)), place, 0xfffffffdu}; // no pass has this number
    }

    std::uint64_t seed_;
    int pass_;
    int begin_at_x1_;
    Position only_;
    std::vector<Position> positions_;
    int first_turn_;
    std::uint64_t block_key_;
    glm::ivec2 first_block_; ///< offset of the grid of blocks to the left and up, pixels; random for each net
    std::array<Random::Points, variants> pass_points_;
    std::array<Random::Points, block_size * block_size> pixel_patterns_; ///< digital shifts
};

} // namespace tessera
