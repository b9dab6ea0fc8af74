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

/// Piecewise constant distribution of directions. Its bins form a square, which an octahedron maps to the sphere
/// [Cigolle 2014]; an alias table chooses a bin. All probabilities are multiples of one unit, so sample() and
/// pdf_w() agree exactly.
class DirectionMap {
public:
    static constexpr int edge = 16, bins = edge * edge;
    using Shares = std::array<float, bins>;

    /// @param shares  probability of each bin, at least 0; the sum is 1
    explicit DirectionMap(const Shares& shares);

    struct Sample {
        glm::vec3 direction; ///< unit, world
        float pdf_w;
    };
    /// Samples a direction. @param choice, u  uniform in [0, 1)
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
    /// Returns the pdf of a unit direction (world), per solid angle.
    float pdf_w(glm::vec3 direction) const {
        const float s = scale_to_octahedron(direction);
        return density(static_cast<unsigned>(bin_of(direction))) * s * s * s;
    }
    /// Returns the probability of a bin.
    float share(int bin) const { return static_cast<float>(slots_[bin].units) / static_cast<float>(units); }

    /// Returns the bin of a unit direction (world).
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
        std::uint8_t threshold, alias; ///< units below the threshold choose the slot's own bin, others `alias`
        std::uint16_t units;           ///< probability of the bin, in units
    };

    /// Maps the lower half of the octahedron to the corners of the square, and back.
    static glm::vec2 folded(glm::vec2 p) {
        return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
    }
    /// Returns the distance from the centre to the octahedron. Its cube converts a pdf per area of the square to
    /// one per solid angle.
    static float scale_to_octahedron(glm::vec3 direction) {
        return 1 / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
    }
    float density(unsigned bin) const { // per area of the square [-1, 1]^2
        return static_cast<float>(slots_[bin].units) * (static_cast<float>(bins) / 4 / static_cast<float>(units));
    }

    std::array<Slot, bins> slots_;
};

/// Distribution of directions at a place, theory (22).
struct DirectionGuide {
    DirectionMap map; ///< g
    float share; ///< s, the fraction of directions drawn from g; the BSDF draws the others, so no light is missed
};

/// Candidates for the share s. Quarters keep a rescaled random number below 1 in floating point.
inline constexpr std::array<float, 4> share_candidates = {0, 0.25f, 0.5f, 0.75f};
using ShareCandidates = std::array<float, share_candidates.size()>;

/// Returns v^2 p_s / p_t of one sample for each t in share_candidates, theory (23). The mean over samples
/// estimates the second moment with share t.
/// @param value   v: contribution of the sample over pdf_w
/// @param pdf_w   p_s of its direction, per solid angle; or the probability of a delta scatter
/// @param guided  g of its direction, per solid angle; 0 for a delta scatter
/// @param used    s, the share with which it was drawn
ShareCandidates second_moments(float value, float pdf_w, float guided, float used);

/// Light that a guiding path found beyond one of its vertices.
struct FoundLight {
    glm::vec3 position, normal; ///< of the vertex; unit shading normal
    glm::vec3 direction;        ///< unit, world
    float irradiance;           ///< luminance times cosine, over pdf_w and survival; 0 after a delta scatter
    float value;                ///< luminance of the radiance scattered toward the camera, over pdf_w and survival
    float pdf_w;                ///< of the direction, per solid angle; or the probability of a delta scatter
};

/// Grid over the positions of path vertices, times the six sides that a surface can face.
struct GuidingGrid {
    glm::ivec3 size{0};         ///< cells along each axis
    glm::vec3 low{0};           ///< corner, world
    float cells_per_length = 0; ///< cells per scene unit

    static constexpr int sides = 6;
    int count() const { return size.x * size.y * size.z * sides; }
    int index(glm::ivec3 cell, int side) const {
        return ((cell.z * size.y + cell.y) * size.x + cell.x) * sides + side;
    }
    /// Returns the index of a cell; positions outside the grid belong to the nearest one.
    int cell_of(glm::vec3 position, glm::vec3 normal) const {
        const glm::vec3 q = glm::clamp((position - low) * cells_per_length, glm::vec3(0), glm::vec3(size - 1));
        const glm::vec3 a = glm::abs(normal);
        const bool is_x = a.x > a.y && a.x > a.z, is_y = !is_x && a.y > a.z;
        const float along = is_x ? normal.x : is_y ? normal.y : normal.z;
        return index(glm::ivec3(q), (is_x ? 0 : is_y ? 2 : 4) + (along > 0));
    }
};

/// Path guiding [after Müller 2017]: directions from which earlier passes found light, by place. Rough vertices
/// draw a share of their directions from it, theory (22). It is constant during a pass, so base and offset paths
/// have the same pdf at the same place.
class PathGuiding {
public:
    /// @param known  index of each cell's guide; -1: none
    PathGuiding(const GuidingGrid& grid, std::vector<int> known, std::vector<DirectionGuide> guides,
                double remaining_second_moment)
        : grid_(grid), known_(std::move(known)), drawn_from_(known_), guides_(std::move(guides)),
          left_of_squares_(remaining_second_moment) {
        for (int& guide : drawn_from_)
            if (guide >= 0 && guides_[guide].share == 0)
                guide = -1;
        draws_ = std::ranges::any_of(drawn_from_, [](int guide) { return guide >= 0; });
    }

    /// Returns whether any cell has a positive share.
    bool draws() const { return draws_; }

    /// Returns the second moment with the best shares over that without a guide, in (0, 1]. It is a geometric
    /// mean over cells, weighted by their numbers of samples, so few bright samples do not decide. 1: not known.
    double remaining_second_moment() const { return left_of_squares_; }

    /// Smoother surfaces are not guided (not tuned).
    static constexpr float least_roughness = 0.11f;

    /// Returns the guide of a place, even with the share 0; null: none.
    const DirectionGuide* known_at(glm::vec3 position, glm::vec3 normal) const {
        return guide(known_, position, normal);
    }
    /// Returns the guide that directions are drawn from; null: the BSDF draws all of them.
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
    std::vector<int> drawn_from_; ///< known_, but -1 where the share is 0; saves paths a memory access
    std::vector<DirectionGuide> guides_;
    double left_of_squares_;
    bool draws_;
};

} // namespace tessera
