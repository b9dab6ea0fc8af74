#include "render/estimator/learned_reuse.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace tessera {

namespace {

/// Size of the reuse set where V = l = 1: N = 10 V / l, in pixels.
constexpr double usual_set_size = 10;

constexpr double most_paths_alone = 12; // not tuned

/// Weight of the picture's mean rho in a cell's rho, as a number of paths with light. Without it, chance decides
/// on cells with few such paths.
constexpr double paths_of_mean = 4;

double rho_of(const CellStatistics& known) {
    return known.reuse_noise / known.own_noise;
}

/// Returns the mean of rho over cells, weighted by their paths with light. Each rho is limited to 1, because an
/// evenly lit cell can have any value.
double mean_rho(const std::vector<CellStatistics>& pilot) {
    double sum = 0, paths = 0;
    for (const CellStatistics& known : pilot)
        if (known.own_noise > 0) {
            sum += known.lit * std::min(rho_of(known), 1.0);
            paths += known.lit;
        }
    return paths > 0 ? sum / paths : 1;
}

} // namespace

void CellStatistics::add_gradient_noise(double shared, double own) {
    if (!(own > 0))
        return;
    const double root = std::sqrt(own);
    reuse_noise += shared / root;
    own_noise += root;
}

CellStatistics& CellStatistics::operator+=(const CellStatistics& more) {
    paths += more.paths;
    lit += more.lit;
    sum += more.sum;
    squares += more.squares;
    reuse_noise += more.reuse_noise;
    own_noise += more.own_noise;
    offset_rays += more.offset_rays;
    base_rays += more.base_rays;
    return *this;
}

LearnedReuse::LearnedReuse(glm::ivec2 size, const RenderSettings& settings)
    : tile_(settings.tile), adapts_(settings.adapt_tile),
      learns_((settings.adapt_tile && can_split_tiles(settings)) || settings.path_guiding != Guiding::off),
      wants_pilot_(measures_reuse_gain(settings)), size_(size),
      cells_((size.x + cell_edge - 1) / cell_edge, (size.y + cell_edge - 1) / cell_edge),
      gain_(cells_.width(), cells_.height()) {}

void LearnedReuse::take(const LearnedReuse& next, int pass) {
    *this = next;
    // The end of a net must not depend on what was learned, as that is random.
    first_pass_ = learns_ ? pass : 0;
}

void LearnedReuse::learn(const Image<float>& luminance) {
    for (int y = 0; y < luminance.height(); ++y)
        for (int x = 0; x < luminance.width(); ++x)
            learn(x, y, luminance(x, y));
}

void LearnedReuse::learn(int x, int y, float luminance) {
    if (adapts_ && luminance >= 0)
        cells_(x / cell_edge, y / cell_edge).add_path(luminance);
}

PixelRect LearnedReuse::cell(int index) const {
    const glm::ivec2 from = glm::ivec2(index % cells_.width(), index / cells_.width()) * cell_edge;
    return PixelRect{from.x, from.y, from.x + cell_edge, from.y + cell_edge}.clipped(size_);
}

int LearnedReuse::cell_of(PixelRect piece) const {
    const glm::ivec2 middle = glm::ivec2(piece.x0 + piece.x1, piece.y0 + piece.y1) / 2;
    const glm::ivec2 at = glm::clamp(middle, glm::ivec2(0), size_ - 1) / cell_edge;
    return at.y * cells_.width() + at.x;
}

/// Returns the edge of a whole number of tile splits of nearly equal size.
int LearnedReuse::best_split_edge(const CellStatistics& known) const {
    if (!(known.sum > 0))
        return tile_;
    const double relative_variance = known.squares * known.paths / (known.sum * known.sum) - 1;
    const double edge = std::sqrt(usual_set_size * std::max(relative_variance, 0.0) * known.paths / known.lit);
    const int splits = static_cast<int>(std::ceil(tile_ / std::clamp(edge, 1.0, static_cast<double>(tile_))));
    return (tile_ + splits - 1) / splits;
}

int LearnedReuse::split_edge(PixelRect piece) const {
    return adapts_ && paths_without_reuse(piece) == 0 ? best_split_edge(known_of(piece)) : tile_;
}

/// Returns the cost of a sample with path reuse, in samples of path tracing; the constants are fitted to measured
/// times. Rays of offset paths are cheaper than others: they are traced in packets, and end at vertices of the
/// base path or at lights.
double LearnedReuse::cost_of_sharing(const CellStatistics& known) const {
    constexpr double own = 1.7, a_ray = 0.55;
    const double edge = best_split_edge(known), set = (edge + 1) * (edge + 1); // with G-PR's column and row
    return own + a_ray * known.offset_rays * set * (set - 1) / (edge * edge) / std::max(known.base_rays, 1.0);
}

void LearnedReuse::learn(const std::vector<CellStatistics>& pilot) {
    constexpr double least = 1e-6; // limits the gain of cells without noise
    const double mean = mean_rho(pilot);
    double costs = 0, sharing = 0;
    for (std::size_t i = 0; i < pilot.size(); ++i) {
        const CellStatistics& known = cells_.data()[i] += pilot[i];
        const double cost = cost_of_sharing(known);
        if (known.own_noise > 0) {
            const double rho = (known.lit * rho_of(known) + paths_of_mean * mean) / (known.lit + paths_of_mean);
            gain_.data()[i] = static_cast<float>(1 / std::max(rho * rho * cost, least));
        }
        const bool shares = !is_alone(static_cast<int>(i));
        costs += shares ? cost : 0;
        sharing += shares;
    }
    if (sharing > 0)
        paths_alone_ = static_cast<int>(std::clamp(std::round(costs / sharing), 1.0, most_paths_alone));
}

} // namespace tessera
