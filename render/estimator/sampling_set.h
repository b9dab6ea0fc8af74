#pragma once

#include "render/estimator/path_reuse.h"
#include "render/estimator/reuse_policy.h"
#include "render/estimator/tile_grid.h"
#include "render/film/film.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

class BaseBlock;
class Pass;

/// T: the pixels whose base paths take part in one balance heuristic, and what each gets of their light. All lists
/// have one entry a pixel.
struct SamplingSet {
    std::vector<glm::ivec2> pixels;
    std::vector<const BasePath*> paths; ///< what each sees from the position at hand
    std::vector<const BasePath*> base;  ///< base paths, whosever turn it is
    /// g, as how many samples a base path counts: 1, or if those whose turn it is at one position are fewer or
    /// more than at others, so many times more or less that each position has as many.
    std::vector<float> counts;
    std::vector<Rgb> radiance;
    std::vector<Rgb> albedo; ///< what radiance is divided by, at the set's place within each pixel
    std::vector<ReuseCounts> reuse;
    int positions = 1;      ///< from which the pass sees its pixels: more than one if any of them is mixed
    int position = 0;       ///< the one at hand, at which some of the base paths are shared
    int number = 0;         ///< which of the paths that a pixel takes for itself alone (Pass::camera_sample)
    float offset_rays = 0;  ///< that an offset took, in the mean, if there is one position (Counters::offset_work)
    ArrivingLight arriving; ///< if the basis has parts
    std::vector<Rgb> parts; ///< of the coefficients, part_count() a pixel, once they are expanded

    int size() const { return static_cast<int>(pixels.size()); }

    void clear() {
        pixels.clear();
        positions = 1;
        position = number = 0;
    }
    void add(int x, int y) { pixels.emplace_back(x, y); }
    /// All pixels of a rectangle, row by row, and no others.
    void assign(PixelRect rect);
    bool contains(glm::ivec2 pixel) const {
        return std::find(pixels.begin(), pixels.end(), pixel) != pixels.end();
    }

    /// Looks up what `pixels` see at the position at hand, and sets all sums to 0.
    void collect(const Pass& pass, const BaseBlock& block);
    /// What entry i got at this position, over its albedo: what primal and gradients are measured of.
    Rgb coefficient(int i) const {
        return tessera::coefficient(radiance[static_cast<std::size_t>(i)], albedo[static_cast<std::size_t>(i)]);
    }
    /// Works `counts` out, for several positions.
    void balance_turns(const Pass& pass);
    /// Works all parts out, if the film has projections.
    void expand(const Film& film);
    std::span<const Rgb> parts_of(int i) const {
        const auto count = static_cast<std::size_t>(arriving.parts());
        return {parts.data() + static_cast<std::size_t>(i) * count, count};
    }
    /// Counts how the shifts of base path k ended; none: no shift was tried.
    void count(std::span<const ShiftOutcome> outcomes, int k);
    /// Counts what the roulette on reuse decided on base path k.
    void count(const ReuseDecision& decision, int k);
};

/// What the pixels of a block get in the sampling sets of PR, G-PT and G-PR that are in it: means over all sets
/// that a pixel is in, and of gradients over those that both pixels are in, each with the weight of its pixels, as
/// so many base paths stand behind it. In a set that takes a pixel for its halo it shares like any other, so that
/// this costs nothing. A set that is seen from several positions shares a part of its base paths at each: what it
/// gets at all of them is summed. All sets of the block are to be added at the first position, 0, and then those
/// that have it at the next.
class SetMeans {
public:
    /// @param parts  of the basis; 0: none
    void begin(PixelRect area, int parts);
    /// Adds what the pixels of a set got, of those in the block. `all` is the rectangle of the set, row by row;
    /// empty: gradients are none.
    void add(const SamplingSet& set, PixelRect all);
    /// How the shifts to a pixel ended.
    const ReuseCounts& reuse(int x, int y) const { return pixels_[index(x, y)].reuse; }
    /// Whether a pixel is in any set.
    bool has(int x, int y) const { return pixels_[index(x, y)].primal.pixels > 0; }
    /// Puts the primal into a sample, with albedo and very direct light of all positions; and the gradients, 0
    /// where there is none. Parts are in memory of this until the next begin().
    void take_primal(int x, int y, PixelSample& sample) const;
    void take_gradients(int x, int y, PixelSample& sample) const;
    /// The memory that a pixel takes.
    static std::size_t bytes(int parts) {
        return sizeof(Pixel) + 3 * static_cast<std::size_t>(parts) * sizeof(Rgb);
    }

private:
    struct Mean {
        Rgb value{0};
        float pixels = 0; ///< of all sets
    };
    /// Of a pixel that is seen from several positions, means over these.
    struct Seen {
        Rgb radiance{0}, albedo{0}, very_direct{0}, albedo_squares{0}, albedo_values{0};
    };
    struct Pixel {
        Mean primal, dx, dy;
        Seen seen;
        bool is_mixed = false;
        ReuseCounts reuse{};
    };
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>((y - area_.y0) * area_.width() + x - area_.x0);
    }
    std::span<Rgb> parts_at(std::vector<Rgb>& parts, std::size_t pixel) {
        return {parts.data() + pixel * part_count_, part_count_};
    }
    std::span<const Rgb> parts_at(const std::vector<Rgb>& parts, std::size_t pixel) const {
        return {parts.data() + pixel * part_count_, part_count_};
    }
    /// Adds what entry `to` got, less what entry `from` got, if there is one.
    static void add(const SamplingSet& set, std::optional<int> from, int to, Mean& mean, std::span<Rgb> parts);
    /// Adds what entry i sees from the position at hand.
    static void see(const SamplingSet& set, int i, Pixel& pixel);

    PixelRect area_{0, 0, 0, 0};
    std::size_t part_count_ = 0;
    std::vector<Pixel> pixels_;
    std::vector<Rgb> parts_, parts_dx_, parts_dy_;
};

} // namespace tessera
