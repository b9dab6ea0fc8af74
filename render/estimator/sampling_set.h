#pragma once

#include "render/estimator/path_reuse.h"
#include "render/estimator/reuse_roulette.h"
#include "render/film/film.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// Sampling set T: the pixels whose base paths take part in one balance heuristic, and the radiance that each
/// receives from these paths. All vectors have one entry per pixel.
struct SamplingSet {
    std::vector<glm::ivec2> pixels;
    std::vector<const BasePath*> paths; ///< that the pixels see from the current position
    std::vector<const BasePath*> base;  ///< base paths, for any position
    /// g of theory (20), the number of samples for which a base path counts: 1 with one position. With several,
    /// all positions count for the same number of samples, even if they have different numbers of paths.
    std::vector<float> counts;
    std::vector<Rgb> radiance; ///< along the camera rays, without filter weights
    std::vector<Rgb> albedo;   ///< by which radiance is divided, at the current position
    std::vector<ReuseCounts> reuse;
    int positions = 1;      ///< from which the pass sees the pixels: several if any of them is mixed
    int position = 0;       ///< current one; base paths whose turn it is are reused
    int number = 0;         ///< index among several paths of a pixel without reuse (Pass::camera_sample)
    float offset_rays = 0;  ///< mean number of rays per offset path, for one position (Counters::offset_work)
    ArrivingLight arriving; ///< if the basis has components
    std::vector<Rgb>
        components; ///< basis components of the coefficients, component_count() per pixel, after expand()

    int size() const { return static_cast<int>(pixels.size()); }

    void clear() {
        pixels.clear();
        positions = 1;
        position = number = 0;
    }
    void add(int x, int y) { pixels.emplace_back(x, y); }
    /// Replaces the pixels by those of a rectangle, row by row.
    void assign(PixelRect rect);
    bool contains(glm::ivec2 pixel) const {
        return std::find(pixels.begin(), pixels.end(), pixel) != pixels.end();
    }

    /// Returns the filter weight of entry i at the current position.
    float weight(int i) const { return paths[i]->weight; }
    /// Returns the demodulated radiance e of entry i at the current position, theory (27), with its filter weight.
    Rgb coefficient(int i) const { return weight(i) * tessera::coefficient(radiance[i], albedo[i]); }
    /// Computes all basis components, theory (31), if the basis has any.
    void expand(const Film& film);
    std::span<const Rgb> components_of(int i) const {
        const auto count = static_cast<std::size_t>(arriving.components());
        return {components.data() + static_cast<std::size_t>(i) * count, count};
    }
    /// Counts the outcomes of the shifts of base path k; empty: no shift was tried.
    void count(std::span<const ShiftOutcome> outcomes, int k);
    /// Counts the decision of Russian roulette on the reuse of base path k.
    void count(const ReuseDecision& decision, int k);
};

/// Primal and gradients, theory (13), of the pixels of a block: means over all sampling sets that contain the
/// pixel, or both pixels of the gradient. Each set weighs its number of pixels, the number of base paths in its
/// estimate. This includes the sets that contain a pixel as their border, at no extra cost. A set with several
/// positions reuses some of its base paths at each position; its result is the sum over positions, theory (19).
/// The caller must add all sets of the block at position 0, and then the sets with several positions at each
/// further position.
class SetMeans {
public:
    /// @param parts  number of basis components
    void begin(PixelRect area, int components);
    /// Adds the results of a set for its pixels in the block.
    /// @param all  rectangle of the set's pixels, row by row; empty: the set has no gradients
    void add(const SamplingSet& set, PixelRect all);
    /// Returns the outcomes of the shifts to a pixel.
    const ReuseCounts& reuse(int x, int y) const { return pixels_[index(x, y)].reuse; }
    /// Returns whether a pixel is in any set.
    bool has(int x, int y) const { return pixels_[index(x, y)].primal.pixels > 0; }
    /// Stores the primal in a sample, with albedo and directly visible emission as means over all positions; and
    /// the gradients, 0 without any. The memory of components is valid until the next begin().
    void take_primal(int x, int y, PixelSample& sample) const;
    void take_gradients(int x, int y, PixelSample& sample) const;
    /// Returns the memory per pixel.
    static std::size_t bytes(int components) {
        return sizeof(Pixel) + 3 * static_cast<std::size_t>(components) * sizeof(Rgb);
    }

private:
    struct Mean {
        Rgb value{0};
        float pixels = 0; ///< summed over sets
    };
    /// Means over the positions of a mixed pixel.
    struct Seen {
        Rgb very_direct{0};
        AlbedoMoments<Rgb> moments; ///< of albedo and radiance
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
    std::span<Rgb> components_at(std::vector<Rgb>& components, std::size_t pixel) {
        return {components.data() + pixel * component_count_, component_count_};
    }
    std::span<const Rgb> components_at(const std::vector<Rgb>& components, std::size_t pixel) const {
        return {components.data() + pixel * component_count_, component_count_};
    }
    /// Adds the coefficient of pixel `to` of the set (an index into it) to a mean: for primal values without
    /// `from`, and as a gradient, to - from, with it. `components` are the means of the basis components.
    static void add(const SamplingSet& set, std::optional<int> from, int to, Mean& mean,
                    std::span<Rgb> components);
    /// Adds what entry i sees from the current position.
    static void see(const SamplingSet& set, int i, Pixel& pixel);

    PixelRect area_{0, 0, 0, 0};
    std::size_t component_count_ = 0;
    std::vector<Pixel> pixels_;
    std::vector<Rgb> components_, components_dx_, components_dy_;
};

} // namespace tessera
