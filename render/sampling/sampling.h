#pragma once

#include "render/sampling/random.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

inline constexpr float pi = 3.14159265358979323846f;
inline constexpr float inv_pi = 1 / pi;

/// Orthonormal frame; `normal` is its z axis.
struct Frame {
    glm::vec3 tangent;
    glm::vec3 bitangent;
    glm::vec3 normal;

    Frame() = default;

    /// Builds a frame around a unit normal [Duff 2017].
    explicit Frame(glm::vec3 n) : normal(n) {
        const float sign = std::copysign(1.0f, n.z);
        const float a = -1.0f / (sign + n.z);
        const float b = n.x * n.y * a;
        tangent = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
        bitangent = {b, sign + n.y * n.y * a, -n.y};
    }

    /// Builds a frame around a unit normal whose tangent is the projection of `along`. The tangent is arbitrary
    /// if `along` is parallel to the normal or not finite.
    Frame(glm::vec3 n, glm::vec3 along) : Frame(n) {
        const glm::vec3 across = glm::cross(n, along);
        const float length2 = glm::dot(across, across);
        if (!(length2 > 0) || !std::isfinite(length2))
            return;
        bitangent = across * (1 / std::sqrt(length2));
        tangent = glm::cross(bitangent, n);
    }

    glm::vec3 to_local(glm::vec3 world) const {
        return {glm::dot(world, tangent), glm::dot(world, bitangent), glm::dot(world, normal)};
    }
    glm::vec3 to_world(glm::vec3 local) const {
        return local.x * tangent + local.y * bitangent + local.z * normal;
    }
};

/// Returns the coordinates, in units of a and b, of v projected onto the plane of a and b; (0, 0) if these are
/// parallel.
inline glm::vec2 coordinates_along(glm::vec3 v, glm::vec3 a, glm::vec3 b) {
    const float aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b), determinant = aa * bb - ab * ab;
    const float va = glm::dot(v, a), vb = glm::dot(v, b);
    return determinant > 0 ? glm::vec2(bb * va - ab * vb, aa * vb - ab * va) / determinant : glm::vec2(0);
}

/// Returns sine and cosine of an angle in [-pi/4, pi/4] by their Taylor series, exact to about the last bit.
inline glm::vec2 sin_cos_quarter(float angle) {
    const float a2 = angle * angle;
    const float sine =
        angle * (1 + a2 * (-1.0f / 6 + a2 * (1.0f / 120 + a2 * (-1.0f / 5040 + a2 * (1.0f / 362880)))));
    const float cosine = 1 + a2 * (-0.5f + a2 * (1.0f / 24 + a2 * (-1.0f / 720 + a2 * (1.0f / 40320))));
    return {sine, cosine};
}

/// Returns sine and cosine of 2 pi `turns`, for turns in [0, 1].
inline glm::vec2 sin_cos_of_turns(float turns) {
    const int quarter = static_cast<int>(4 * turns + 0.5f); // the nearest one
    const glm::vec2 sc = sin_cos_quarter(pi / 2 * (4 * turns - static_cast<float>(quarter)));
    const bool is_odd = quarter & 1;
    const float sine = is_odd ? sc.y : sc.x, cosine = is_odd ? sc.x : sc.y;
    return {quarter & 2 ? -sine : sine, (quarter + 1) & 2 ? -cosine : cosine};
}

/// Returns atan2(y, x) with an error of at most 3e-7; 0 if both are 0. It is faster than std::atan2 and returns
/// the same bits with every library. The series, about 0 or about pi/4, is from Moshier's Cephes.
inline float angle_of(float y, float x) {
    const float ax = std::abs(x), ay = std::abs(y);
    const float larger = std::max(ax, ay), smaller = std::min(ax, ay);
    const bool is_far = smaller > 0.41421356f * larger; // tan(pi / 8)
    const float above = is_far ? smaller - larger : smaller, below = is_far ? smaller + larger : larger;
    const float t = below > 0 ? above / below : 0.0f;
    const float t2 = t * t;
    const float series =
        t + t * t2 * (-0.333329491539f + t2 * (0.199777106478f + t2 * (-0.138776856032f + t2 * 0.0805374449538f)));
    float angle = is_far ? series + pi / 4 : series;
    angle = ay > ax ? pi / 2 - angle : angle;
    angle = x < 0 ? pi - angle : angle;
    return std::copysign(angle, y);
}

/// Samples the unit disk uniformly with the concentric map [Shirley and Chiu 1997].
inline glm::vec2 sample_disk(glm::vec2 u) {
    const float x = 2 * u.x - 1;
    const float y = 2 * u.y - 1;
    const bool wide = std::abs(x) > std::abs(y);
    const float radius = wide ? x : y;
    if (radius == 0)
        return {0, 0};
    const glm::vec2 sc = radius * sin_cos_quarter(pi / 4 * ((wide ? y : x) / radius));
    return wide ? glm::vec2(sc.y, sc.x) : sc;
}

/// Samples a direction of the hemisphere about +z with pdf_w = cos / pi.
inline glm::vec3 sample_cosine_hemisphere(glm::vec2 u) {
    const glm::vec2 d = sample_disk(u);
    return {d.x, d.y, std::sqrt(std::max(1 - d.x * d.x - d.y * d.y, 0.0f))};
}

/// Samples a triangle uniformly; returns the barycentric coordinates of its second and third corner.
inline glm::vec2 sample_triangle(glm::vec2 u) {
    const float root = std::sqrt(1 - u.x);
    return {1 - root, u.y * root};
}

/// Chooses an index with a probability in proportion to its weight, in constant time [Walker 1974, Vose 1991].
class AliasTable {
public:
    AliasTable() = default;
    /// @param weights  at least 0; if all are 0, all probabilities are 0 and choose() must not be called
    explicit AliasTable(const std::vector<double>& weights);

    bool empty() const { return entries_.empty(); }
    std::size_t size() const { return entries_.size(); }
    float probability(std::size_t i) const { return entries_[i].probability; }

    struct Choice {
        std::size_t index;
        float probability;
    };

    /// Chooses an entry with random numbers in [0, 1)^2: x chooses the slot, y decides between its two entries.
    /// One float for both would leave few bits for y in a large table.
    Choice choose(glm::vec2 u) const {
        const auto slot = static_cast<std::size_t>(u.x * static_cast<float>(entries_.size()));
        const std::size_t first = slot < entries_.size() ? slot : entries_.size() - 1;
        const Entry& entry = entries_[first];
        if (u.y < entry.threshold)
            return {first, entry.probability};
        return {entry.alias, entry.alias_probability};
    }

private:
    struct alignas(16) Entry { // so a choice reads one cache line
        float threshold;       // u.y below it chooses this entry, else `alias`
        std::uint32_t alias;
        float probability, alias_probability;
    };
    std::vector<Entry> entries_;
};

inline AliasTable::AliasTable(const std::vector<double>& weights) : entries_(weights.size()) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<double> share(weights.size()); // probability in units of a slot; their mean is 1
    std::vector<std::uint32_t> small, large;
    for (std::uint32_t i = 0; i < weights.size(); ++i) {
        share[i] = total > 0 ? weights[i] / total * static_cast<double>(weights.size()) : 0;
        entries_[i] = {1, i, 0, 0};
        (share[i] < 1 ? small : large).push_back(i);
    }
    // A slot with a share below 1 gives the rest of its place to an entry with a larger share. Entries that
    // remain in the end have a share of 1 up to rounding. Thresholds have 24 bits, as random numbers have.
    while (!small.empty() && !large.empty()) {
        const std::uint32_t s = small.back(), l = large.back();
        small.pop_back();
        const double threshold = std::ceil(share[s] * 0x1p24) * 0x1p-24;
        entries_[s].threshold = static_cast<float>(threshold);
        entries_[s].alias = l;
        share[l] -= 1 - threshold;
        if (share[l] < 1) {
            large.pop_back();
            small.push_back(l);
        }
    }
    // The exact probabilities of the table with rounded thresholds.
    std::vector<double> kept(weights.size(), 0.0);
    for (const Entry& entry : entries_) {
        kept[&entry - entries_.data()] += entry.threshold;
        kept[entry.alias] += 1 - entry.threshold;
    }
    for (std::size_t i = 0; i < entries_.size(); ++i)
        entries_[i].probability =
            total > 0 ? static_cast<float>(kept[i] / static_cast<double>(entries_.size())) : 0;
    for (Entry& entry : entries_)
        entry.alias_probability = entries_[entry.alias].probability;
}

} // namespace tessera
