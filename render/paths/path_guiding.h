#pragma once

#include "render/sampling/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// A distribution of directions: a square of bins, which is the sphere by way of an octahedron [Cigolle 2014], and
/// an alias table over them. All probabilities are whole numbers of the same small unit, so that what is drawn and
/// what its pdf says are the same to the last bit.
class DirectionMap {
public:
    static constexpr int edge = 16, bins = edge * edge;
    using Shares = std::array<float, bins>;

    /// @param shares  not negative; they add up to 1
    explicit DirectionMap(const Shares& shares);

    struct Sample {
        glm::vec3 direction; ///< unit, world
        float pdf_w;
    };
    /// @param choice, u  uniform in [0, 1)
    Sample sample(float choice, glm::vec2 u) const {
        const auto bits = static_cast<unsigned>(choice * static_cast<float>(units));
        const Slot& slot = slots_[bits / units_a_slot];
        const unsigned bin = bits % units_a_slot < slot.threshold ? bits / units_a_slot : slot.alias;
        glm::vec2 p = (glm::vec2(bin % edge, bin / edge) + u) * (2.0f / edge) - 1.0f;
        const float z = 1 - std::abs(p.x) - std::abs(p.y);
        p = z < 0 ? folded(p) : p;
        const float length = std::sqrt(p.x * p.x + p.y * p.y + z * z);
        return {glm::vec3(p, z) / length, density(bin) * length * length * length};
    }
    /// Of a unit direction (world).
    float pdf_w(glm::vec3 direction) const {
        const float s = scale_to_octahedron(direction);
        return density(static_cast<unsigned>(bin_of(direction))) * s * s * s;
    }
    float share(int bin) const { return static_cast<float>(slots_[bin].units) / static_cast<float>(units); }

    static int bin_of(glm::vec3 direction) {
        const glm::vec3 d = direction * scale_to_octahedron(direction);
        const glm::vec2 p = d.z < 0 ? folded(d) : glm::vec2(d);
        const auto part = [](float a) {
            return std::clamp(static_cast<int>((a + 1) * (0.5f * edge)), 0, edge - 1);
        };
        return part(p.y) * edge + part(p.x);
    }

private:
    static constexpr unsigned units_a_slot = 256, units = units_a_slot * bins;

    struct Slot {
        std::uint8_t threshold, alias; ///< of its units, those below the threshold are the slot's own bin's
        std::uint16_t units;           ///< of the bin
    };

    /// The lower half of the octahedron lies in the corners of the square; and back.
    static glm::vec2 folded(glm::vec2 p) {
        return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
    }
    /// How far from the middle the octahedron is; its cube is what turns area of the square into solid angle.
    static float scale_to_octahedron(glm::vec3 direction) {
        return 1 / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
    }
    float density(unsigned bin) const { // per area of the square, which is 4
        return static_cast<float>(slots_[bin].units) * (static_cast<float>(bins) / 4 / static_cast<float>(units));
    }

    std::array<Slot, bins> slots_;
};

/// What directions at a place are drawn from.
struct DirectionGuide {
    DirectionMap map;
    float share; ///< of the directions; the BSDF has the others, so that no light is ever missed
};

/// The shares that are tried: multiples of a quarter, so that random numbers below 1 stay so when one is stretched
/// over its part.
inline constexpr std::array<float, 4> tried_shares = {0, 0.25f, 0.5f, 0.75f};
using TriedShares = std::array<float, tried_shares.size()>;

/// What the square of a sample would have been with each share, times how much more often it would have been
/// drawn: in the mean over all samples, the second moment with that share.
/// @param value          of the sample: what was found, over pdf_w
/// @param pdf_w, guided  of its direction: as it was drawn, with the share `used`, and by the guide alone; of a
///                       delta scatter its probability, and 0
TriedShares squares_by_share(float value, float pdf_w, float guided, float used);

/// Light that a base path found beyond one of its vertices.
struct FoundLight {
    glm::vec3 position, normal; ///< of the vertex; unit, of shading
    glm::vec3 direction;        ///< unit, world
    float irradiance;   ///< luminance times cosine, over pdf_w and the survival of the roulette; 0: a delta
                        ///< scatter's, which no guide draws, but which is drawn less often where there is one
    float value, pdf_w; ///< luminance of what the vertex sends on of it, over the same; the pdf of the direction
                        ///< as it was drawn, or a delta scatter's probability
};

/// A grid over the places that paths come to, and the side to which surfaces there look.
struct GuidingGrid {
    glm::ivec3 size{0};
    glm::vec3 low{0};
    float cells_a_length = 0;

    static constexpr int sides = 6;
    int count() const { return size.x * size.y * size.z * sides; }
    int index(glm::ivec3 cell, int side) const {
        return ((cell.z * size.y + cell.y) * size.x + cell.x) * sides + side;
    }
    /// What lies beyond the grid belongs to the nearest cell.
    int cell_of(glm::vec3 position, glm::vec3 normal) const {
        const glm::vec3 q = glm::clamp((position - low) * cells_a_length, glm::vec3(0), glm::vec3(size - 1));
        const glm::vec3 a = glm::abs(normal);
        const bool is_x = a.x > a.y && a.x > a.z, is_y = !is_x && a.y > a.z;
        const float along = is_x ? normal.x : is_y ? normal.y : normal.z;
        return index(glm::ivec3(q), (is_x ? 0 : is_y ? 2 : 4) + (along > 0));
    }
};

/// Path guiding [after Müller 2017]: where in the scene light was found to come from. Rough vertices draw a share
/// of their directions from that. Does not change while a pass goes on, so that base and offset paths meet the
/// same distribution at the same place.
class PathGuiding {
public:
    /// @param known  of each cell of the grid, which of the guides; -1: none
    PathGuiding(const GuidingGrid& grid, std::vector<int> known, std::vector<DirectionGuide> guides,
                double left_of_squares)
        : grid_(grid), known_(std::move(known)), drawn_from_(known_), guides_(std::move(guides)),
          left_of_squares_(left_of_squares) {
        for (int& guide : drawn_from_)
            if (guide >= 0 && guides_[guide].share == 0)
                guide = -1;
        draws_ = std::ranges::any_of(drawn_from_, [](int guide) { return guide >= 0; });
    }

    /// Whether anything is drawn from it, at any place.
    bool draws() const { return draws_; }

    /// What the best shares leave of the second moment without a guide, (0, 1]: the geometric mean over the cells
    /// that tell, by their numbers of samples, so that no few bright samples decide. 1: none tell yet.
    double left_of_squares() const { return left_of_squares_; }

    /// Below this roughness, the BSDF alone knows best.
    static constexpr float least_roughness = 0.11f;

    /// What is known of a place; null: nothing.
    const DirectionGuide* known_at(glm::vec3 position, glm::vec3 normal) const {
        return guide(known_, position, normal);
    }
    /// What is drawn from there; null: the BSDF has all directions.
    const DirectionGuide* at(glm::vec3 position, glm::vec3 normal) const {
        return guide(drawn_from_, position, normal);
    }

private:
    const DirectionGuide* guide(const std::vector<int>& of_cell, glm::vec3 position, glm::vec3 normal) const {
        const int guide = of_cell[grid_.cell_of(position, normal)];
        return guide < 0 ? nullptr : &guides_[guide];
    }

    GuidingGrid grid_;
    std::vector<int> known_;
    std::vector<int> drawn_from_; ///< -1 where nothing is drawn, so that no path has to look into the guide there
    std::vector<DirectionGuide> guides_;
    double left_of_squares_;
    bool draws_;
};

} // namespace tessera
