#include "render/estimator/reuse_policy.h"

#include "render/estimator/path_reuse.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace tessera {

namespace {

/// Pixels that should share where V = l = 1: of 10, 20 and more the best on the Cornell box, kitchen, bathroom and
/// veach-ajar together.
constexpr double sharers = 20;

constexpr int first_edge = 2; // of G-PR's squares in the first pass

/// Of what rho times cost may be, 1.7, 2, 2.5 and 3.3 were tried on glossy, bent and rough surfaces, in glass, and
/// on edges, where true gradients make rho too large.
constexpr double most_rho_cost = 2.5;
constexpr double most_paths_alone = 12;

/// What a sample costs in paths of a path tracer, where each offset takes `offset_rays`: from times measured in
/// those scenes. Rays of offsets go in packets, and end at the base's vertices or at lights.
double cost_of_sharing(double offset_rays, double base_rays, int edge) {
    constexpr double own = 1.25, a_ray = 0.4;
    const double set = (edge + 1) * (edge + 1); // with G-PR's column and row
    return own + a_ray * offset_rays * set * (set - 1) / (edge * edge) / std::max(base_rays, 1.0);
}

} // namespace

ReusePlan::ReusePlan(glm::ivec2 size, const RenderSettings& settings)
    : tile_(settings.tile), adapts_(settings.adapt_tile), finds_gain_(adapts_ && finds_gain_of_sharing(settings)),
      size_(size), cells_((size.x + cell_edge - 1) / cell_edge, (size.y + cell_edge - 1) / cell_edge) {}

void ReusePlan::learn(const Image<PlanEvidence>& evidence) {
    if (!adapts_)
        return;
    for (int y = 0; y < evidence.height(); ++y)
        for (int x = 0; x < evidence.width(); ++x)
            learn(x, y, evidence(x, y));
}

void ReusePlan::learn(int x, int y, const PlanEvidence& evidence) {
    const double l = evidence.luminance;
    if (l < 0)
        return;
    Cell& cell = cells_(x / cell_edge, y / cell_edge);
    cell.paths += 1;
    cell.lit += l > 0;
    cell.sum += l;
    cell.squares += l * l;
    cell.shared_steps += evidence.shared_steps;
    cell.own_steps += evidence.own_steps;
    cell.offset_rays += evidence.offset_rays;
    cell.base_rays += evidence.base_rays;
}

/// A tile belongs to the cell of the pixel in its middle.
glm::ivec2 ReusePlan::cell_of(PixelRect tile) const {
    const glm::ivec2 middle = glm::ivec2(tile.x0 + tile.x1, tile.y0 + tile.y1) / 2;
    return glm::clamp(middle, glm::ivec2(0), size_ - 1) / cell_edge;
}

PixelRect ReusePlan::evidence(PixelRect tile) const {
    const glm::ivec2 from = cell_of(tile) * cell_edge;
    return PixelRect{from.x, from.y, from.x + cell_edge, from.y + cell_edge}.clipped(size_);
}

const ReusePlan::Cell& ReusePlan::cell(PixelRect tile) const {
    const glm::ivec2 at = cell_of(tile);
    return cells_(at.x, at.y);
}

/// A whole number of parts, all of nearly the same size.
int ReusePlan::cut_edge(const Cell& cell) const {
    if (!(cell.sum > 0))
        return tile_;
    const double relative_variance = cell.squares * cell.paths / (cell.sum * cell.sum) - 1;
    const double edge = std::sqrt(sharers * std::max(relative_variance, 0.0) * cell.paths / cell.lit);
    const int parts = static_cast<int>(std::ceil(tile_ / std::clamp(edge, 1.0, static_cast<double>(tile_))));
    return (tile_ + parts - 1) / parts;
}

int ReusePlan::part_edge(PixelRect tile) const {
    if (!adapts_ || paths_alone(tile) > 0)
        return tile_;
    if (finds_gain_ && cell(tile).paths == 0)
        return std::min(first_edge, tile_);
    return cut_edge(cell(tile));
}

int ReusePlan::paths_alone(PixelRect tile) const {
    const Cell& c = cell(tile);
    if (!finds_gain_ || !(c.own_steps > 0))
        return 0;
    const double cost = cost_of_sharing(c.offset_rays, c.base_rays, tile_);
    if (c.shared_steps / c.own_steps * cost <= most_rho_cost)
        return 0;
    return static_cast<int>(std::clamp(std::round(cost), 1.0, most_paths_alone));
}

namespace {

/// How much the light that the paths share, as it arrives, differs from path to path.
float standard_deviation(const PathReuse& reuse, std::span<const BasePath* const> set) {
    double sum = 0, squares = 0; // the squares of a float may be beyond floats
    for (const BasePath* path : set) {
        const double l = std::max(reuse.arriving_luminance(*path), 0.0f);
        sum += l;
        squares += l * l;
    }
    const double count = static_cast<double>(set.size()), mean = sum / count;
    return static_cast<float>(std::sqrt(std::max(squares / count - mean * mean, 0.0)));
}

} // namespace

ReuseRoulette::ReuseRoulette(RouletteKind kind, const RenderSettings& settings, const PathReuse& reuse,
                             std::span<const BasePath* const> set)
    : reuse_(reuse), kind_(kind), q_min_(settings.q_min) {
    switch (kind) {
    case RouletteKind::relative:
        threshold_ = settings.rr_scale * standard_deviation(reuse, set);
        break;
    case RouletteKind::absolute:
        threshold_ = settings.rr_delta;
        break;
    case RouletteKind::none:
        break;
    }
}

float ReuseRoulette::survival(const BasePath& path) const {
    const float l =
        kind_ == RouletteKind::absolute ? luminance(reuse_.shared_light(path)) : reuse_.arriving_luminance(path);
    return l < threshold_ ? std::max(l / threshold_, q_min_) : 1;
}

} // namespace tessera
