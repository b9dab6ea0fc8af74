#include "render/estimator/reuse_policy.h"

#include "render/estimator/path_reuse.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace tessera {

namespace {

/// Pixels that should share where V = l = 1: of 5, 10 and 20 the best on kitchen, bathroom, living-room and
/// veach-ajar together.
constexpr double sharers = 10;

constexpr double most_paths_alone = 12;

/// So many paths that carry light, of which the picture's mean holds, a cell's rho counts with: by fewer of its
/// own it would be decided by chance. (2 changes little; with 8, cells that should be alone share.)
constexpr double paths_of_mean = 4;

double rho_of(const PlanEvidence& known) {
    return known.shared_noise / known.own_noise;
}

/// The mean of rho by the paths that tell of it, each 1 at most: in a cell that is lit evenly, it may be anything.
double mean_rho(const std::vector<PlanEvidence>& pilot) {
    double sum = 0, paths = 0;
    for (const PlanEvidence& known : pilot)
        if (known.own_noise > 0) {
            sum += known.lit * std::min(rho_of(known), 1.0);
            paths += known.lit;
        }
    return paths > 0 ? sum / paths : 1;
}

} // namespace

void PlanEvidence::add_gradient_noise(double shared, double own) {
    if (!(own > 0))
        return;
    const double root = std::sqrt(own);
    shared_noise += shared / root;
    own_noise += root;
}

PlanEvidence& PlanEvidence::operator+=(const PlanEvidence& more) {
    paths += more.paths;
    lit += more.lit;
    sum += more.sum;
    squares += more.squares;
    shared_noise += more.shared_noise;
    own_noise += more.own_noise;
    offset_rays += more.offset_rays;
    base_rays += more.base_rays;
    return *this;
}

ReusePlan::ReusePlan(glm::ivec2 size, const RenderSettings& settings)
    : tile_(settings.tile), adapts_(settings.adapt_tile),
      learns_((settings.adapt_tile && has_tiles_to_cut(settings)) || settings.path_guiding != Guiding::off),
      wants_pilot_(finds_gain_of_sharing(settings)), size_(size),
      cells_((size.x + cell_edge - 1) / cell_edge, (size.y + cell_edge - 1) / cell_edge),
      gain_(cells_.width(), cells_.height()) {}

void ReusePlan::take(const ReusePlan& next, int pass) {
    *this = next;
    first_pass_ = learns_ ? pass : 0; // whatever was learnt: when a net ends, chance must not decide either
}

void ReusePlan::learn(const Image<float>& luminance) {
    for (int y = 0; y < luminance.height(); ++y)
        for (int x = 0; x < luminance.width(); ++x)
            learn(x, y, luminance(x, y));
}

void ReusePlan::learn(int x, int y, float luminance) {
    if (adapts_ && luminance >= 0)
        cells_(x / cell_edge, y / cell_edge).add_path(luminance);
}

PixelRect ReusePlan::cell(int index) const {
    const glm::ivec2 from = glm::ivec2(index % cells_.width(), index / cells_.width()) * cell_edge;
    return PixelRect{from.x, from.y, from.x + cell_edge, from.y + cell_edge}.clipped(size_);
}

int ReusePlan::cell_of(PixelRect piece) const {
    const glm::ivec2 middle = glm::ivec2(piece.x0 + piece.x1, piece.y0 + piece.y1) / 2;
    const glm::ivec2 at = glm::clamp(middle, glm::ivec2(0), size_ - 1) / cell_edge;
    return at.y * cells_.width() + at.x;
}

/// A whole number of parts, all of nearly the same size.
int ReusePlan::cut_edge(const PlanEvidence& known) const {
    if (!(known.sum > 0))
        return tile_;
    const double relative_variance = known.squares * known.paths / (known.sum * known.sum) - 1;
    const double edge = std::sqrt(sharers * std::max(relative_variance, 0.0) * known.paths / known.lit);
    const int parts = static_cast<int>(std::ceil(tile_ / std::clamp(edge, 1.0, static_cast<double>(tile_))));
    return (tile_ + parts - 1) / parts;
}

int ReusePlan::part_edge(PixelRect piece) const {
    return adapts_ && paths_alone(piece) == 0 ? cut_edge(known_of(piece)) : tile_;
}

/// What a sample costs in samples of a path tracer. From times measured in 11 scenes, of which it tells within a
/// quarter; rays of offsets go in packets, and end at the base's vertices or at lights.
double ReusePlan::cost_of_sharing(const PlanEvidence& known) const {
    constexpr double own = 1.7, a_ray = 0.55;
    const double edge = cut_edge(known), set = (edge + 1) * (edge + 1); // with G-PR's column and row
    return own + a_ray * known.offset_rays * set * (set - 1) / (edge * edge) / std::max(known.base_rays, 1.0);
}

void ReusePlan::learn(const std::vector<PlanEvidence>& pilot) {
    constexpr double least = 1e-6; // where sharing leaves no noise at all
    const double mean = mean_rho(pilot);
    double costs = 0, sharing = 0;
    for (std::size_t i = 0; i < pilot.size(); ++i) {
        const PlanEvidence& known = cells_.data()[i] += pilot[i];
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

namespace {

/// Returns the standard deviation of the arriving luminance over the paths of a set.
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
    : reuse_(reuse), kind_(kind) {
    switch (kind) {
    case RouletteKind::relative:
        threshold_ = standard_deviation(reuse, set);
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
    return l < threshold_ ? std::max(l / threshold_, q_min) : 1;
}

} // namespace tessera
