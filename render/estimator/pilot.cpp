#include "render/estimator/pilot.h"

#include "render/estimator/method_sets.h"
#include "render/estimator/set_reuse.h"
#include "render/estimator/tile_grid.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

constexpr int set_edge = 3, set_distance = 4; // pixels

/// Coefficients of the pixels of a set from one sample, with path reuse and without.
struct Trial {
    std::vector<glm::dvec3> shared, own;

    Trial(const Pass& pilot, PixelRect all, glm::ivec2 inside, Worker& worker, CellStatistics& found) {
        SamplingSet& set = worker.set;
        set.assign(all);
        worker.base.trace(pilot, worker.tracer, all, inside);
        reuse_paths(pilot, roulette_of(pilot.settings), worker);
        for (int i = 0; i < set.size(); ++i) {
            const auto at = static_cast<std::size_t>(i);
            const BasePath& path = *set.paths[at];
            if (const float l = worker.reuse.arriving_luminance(path); l >= 0)
                found.add_path(l);
            found.offset_rays += set.offset_rays;
            found.base_rays += static_cast<double>(2 * path.size());
            shared.emplace_back(set.coefficient(i));
            own.emplace_back(set.weight(i) * coefficient(path.radiance(), set.albedo[at]));
        }
    }
};

/// Sums of the lengths of the noise of a set's gradients, with path reuse and without.
struct GradientNoise {
    double shared = 0, own = 0;

    /// Adds the difference of two samples of the gradient from pixel m to n. The gradient itself cancels.
    void compare(const Trial& a, const Trial& b, std::size_t m, std::size_t n) {
        const double with = glm::length(a.shared[n] - a.shared[m] - b.shared[n] + b.shared[m]);
        const double without = glm::length(a.own[n] - a.own[m] - b.own[n] + b.own[m]);
        if (!std::isfinite(with) || !std::isfinite(without)) // invalid
            return;
        shared += with;
        own += without;
    }
};

RenderSettings settings_of_trial(RenderSettings settings, std::uint64_t trial) {
    settings.seed ^= 0x7069'6c6f'7400'0000u + trial;
    return settings;
}

} // namespace

Pilot::Pilot(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
             const LearnedReuse& learned)
    : settings_{settings_of_trial(settings, 0), settings_of_trial(settings, 1)},
      first_(scene, camera, size, settings_[0], learned, 0),
      second_(scene, camera, size, settings_[1], learned, 0) {}

CellStatistics Pilot::explore(PixelRect cell, Worker& worker) const {
    CellStatistics found;
    for_each_square(cell, set_distance, [&](PixelRect square) {
        if ((square.x0 + square.y0) / set_distance % 2 != 0)
            return; // checkerboard
        const PixelRect all =
            PixelRect{square.x0, square.y0, square.x0 + set_edge, square.y0 + set_edge}.clipped(first_.size);
        const Trial a(first_, all, {cell.x0, cell.y0}, worker, found);
        const Trial b(second_, all, {cell.x0, cell.y0}, worker, found);
        const auto width = static_cast<std::size_t>(all.width());
        GradientNoise noise;
        for (std::size_t i = 0; i < a.own.size(); ++i) {
            if ((i + 1) % width != 0)
                noise.compare(a, b, i, i + 1);
            if (i + width < a.own.size())
                noise.compare(a, b, i, i + width);
        }
        found.add_gradient_noise(noise.shared, noise.own);
    });
    return found;
}

} // namespace tessera
