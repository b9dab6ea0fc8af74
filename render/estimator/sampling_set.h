#pragma once

#include "recon/image.h"
#include "render/estimator/film.h"
#include "render/estimator/path_reuse.h"
#include "render/estimator/reuse_policy.h"

#include <algorithm>
#include <span>
#include <vector>

namespace tessera {

class BaseBlock;

/// T: the pixels whose base paths take part in one balance heuristic, and what each gets of their light. All lists
/// have one entry a pixel.
struct SamplingSet {
    std::vector<glm::ivec2> pixels;
    std::vector<const BasePath*> paths;
    std::vector<Rgb> radiance;
    std::vector<ReuseCounts> reuse;

    int size() const { return static_cast<int>(pixels.size()); }

    void clear() { pixels.clear(); }
    void add(int x, int y) { pixels.emplace_back(x, y); }
    /// All pixels of a rectangle, row by row, and no others.
    void assign(PixelRect rect);
    bool contains(glm::ivec2 pixel) const {
        return std::find(pixels.begin(), pixels.end(), pixel) != pixels.end();
    }

    /// Looks the base paths of `pixels` up, and sets all sums to 0.
    void collect(const BaseBlock& base);
    /// Counts how the shifts of base path k ended; none: no shift was tried.
    void count(std::span<const ShiftOutcome> outcomes, int k);
    /// Counts what the roulette on reuse decided on base path k.
    void count(const ReuseDecision& decision, int k);
    /// What entry i got, without gradients.
    PixelSample sample(int i, const PathReuse& estimator) const;
};

} // namespace tessera
