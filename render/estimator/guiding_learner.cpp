#include "render/estimator/guiding_learner.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace tessera {

DirectionMap::DirectionMap(const Shares& shares) {
    // Differences of rounded sums are whole numbers that add up to `units`.
    std::array<unsigned, bins> left;
    double sum = 0;
    unsigned before = 0;
    for (unsigned b = 0; b < bins; ++b) {
        sum += static_cast<double>(shares[b]);
        const double rounded = std::floor(sum * units + 0.5);
        const unsigned now = b + 1 == bins ? units : static_cast<unsigned>(std::clamp(rounded, 0.0, 1.0 * units));
        left[b] = now - before;
        before = now;
    }
    // A bin with all units would overflow Slot::units, so the next bin gets one.
    for (unsigned b = 0; b < bins; ++b)
        if (left[b] == units)
            --left[b], ++left[(b + 1) % bins];
    for (unsigned b = 0; b < bins; ++b)
        slots_[b] = {units_a_slot - 1, static_cast<std::uint8_t>(b), static_cast<std::uint16_t>(left[b])};
    // The same method as AliasTable, in whole units.
    std::array<unsigned, bins> small, large;
    std::size_t smalls = 0, larges = 0;
    for (unsigned b = 0; b < bins; ++b)
        (left[b] < units_a_slot ? small[smalls++] : large[larges++]) = b;
    while (smalls > 0 && larges > 0) {
        const unsigned s = small[--smalls], l = large[larges - 1];
        slots_[s].threshold = static_cast<std::uint8_t>(left[s]);
        slots_[s].alias = static_cast<std::uint8_t>(l);
        left[l] -= units_a_slot - left[s];
        if (left[l] < units_a_slot) {
            --larges;
            small[smalls++] = l;
        }
    }
}

ShareCandidates second_moments(float value, float pdf_w, float guided, float used) {
    const float own = std::max(pdf_w - used * guided, 0.0f) / (1 - used); // p_BSDF, theory (22)
    ShareCandidates squares;
    for (std::size_t i = 0; i < squares.size(); ++i)
        squares[i] = value * value * (pdf_w / ((1 - share_candidates[i]) * own + share_candidates[i] * guided));
    return squares;
}

namespace {

// docs/decisions.md justifies prior_share, least_gain and max_remaining; the other constants are not tuned.
constexpr int cells_along = 12; // along the longest side of the grid
// Guiding paths: in pass 0; in all passes from 2^n to 2^(n+1) - 1; at least in each pass; and the fraction of
// these while no direction is drawn from guides (fraction_of_paths).
constexpr int first_paths = 1 << 16, most_paths = 1 << 18, least_paths = 1 << 10;
constexpr float idle_fraction = 0.25f;
constexpr int halvings = 2;         // number of coarser grids, whose cells are priors
constexpr double least_samples = 8; // effective number of samples for a guide, and for a share
constexpr float prior_samples = 4;  // weight of the prior, in samples

// Share of a guide without samples that estimate it; and the least relative reduction of the second moment,
// because guided paths cost more.
constexpr float prior_share = 0.25f, least_gain = 0.1f;
// With Guiding::automatic, the largest remaining_second_moment() of a guided scene.
constexpr double max_remaining = 0.85;

/// A value for the square of bins, for its quarters, and so on down to single bins.
class Quadtree {
public:
    static constexpr int levels = std::bit_width(unsigned{DirectionMap::edge});

    float& at(int level, int x, int y) { return numbers_[place(level, x, y)]; }
    float at(int level, int x, int y) const { return numbers_[place(level, x, y)]; }
    float* bins() { return &at(levels - 1, 0, 0); } ///< row by row

    static Quadtree sums_of(const DirectionMap::Shares& bins) {
        Quadtree sums;
        std::ranges::copy(bins, sums.bins());
        for (int level = levels - 2; level >= 0; --level)
            for (int y = 0; y < 1 << level; ++y)
                for (int x = 0; x < 1 << level; ++x)
                    sums.at(level, x, y) =
                        sums.at(level + 1, 2 * x, 2 * y) + sums.at(level + 1, 2 * x + 1, 2 * y) +
                        sums.at(level + 1, 2 * x, 2 * y + 1) + sums.at(level + 1, 2 * x + 1, 2 * y + 1);
        return sums;
    }

private:
    static constexpr std::size_t place(int level, int x, int y) {
        return static_cast<std::size_t>(((1 << 2 * level) - 1) / 3 + (y << level) + x);
    }

    std::array<float, ((1 << 2 * levels) - 1) / 3> numbers_;
};

/// Returns the probabilities of bins. It divides 1 among the quarters of the square, and on down to bins, in
/// proportion to the mean of the found irradiance, weighted by its effective number of samples, and the prior,
/// weighted by prior_samples.
/// @param first, second  sums of irradiance and of its square
DirectionMap::Shares distribute(const Quadtree& first, const Quadtree& second, const Quadtree& prior) {
    Quadtree shares;
    shares.at(0, 0, 0) = 1;
    for (int level = 0; level + 1 < Quadtree::levels; ++level)
        for (int i = 0; i < 1 << 2 * level; ++i) {
            const int x = i & ((1 << level) - 1), y = i >> level;
            const float all = first.at(level, x, y), squares = second.at(level, x, y),
                        prior_all = prior.at(level, x, y), mass = shares.at(level, x, y);
            const float samples = squares > 0 ? all * (all / squares) : 0;
            for (int q = 0; q < 4; ++q) {
                const int at_x = 2 * x + q % 2, at_y = 2 * y + q / 2;
                const float found = all > 0 ? first.at(level + 1, at_x, at_y) / all : 0.25f;
                const float expected = prior_all > 0 ? prior.at(level + 1, at_x, at_y) / prior_all : 0.25f;
                shares.at(level + 1, at_x, at_y) =
                    mass * (samples * found + prior_samples * expected) / (samples + prior_samples);
            }
        }
    DirectionMap::Shares bins;
    std::copy_n(shares.bins(), bins.size(), bins.begin());
    return bins;
}

/// Calls visit(cell, side) in the order of a grid's indices.
template <class Visit>
void for_each_cell(const GuidingGrid& grid, Visit&& visit) {
    for (int z = 0; z < grid.size.z; ++z)
        for (int y = 0; y < grid.size.y; ++y)
            for (int x = 0; x < grid.size.x; ++x)
                for (int side = 0; side < GuidingGrid::sides; ++side)
                    visit(glm::ivec3(x, y, z), side);
}

} // namespace

void GuidingLearner::Sums::add(const FoundLight& f, const DirectionGuide* known) {
    const auto bin = static_cast<std::size_t>(DirectionMap::bin_of(f.direction));
    first[bin] += f.irradiance;
    second[bin] += f.irradiance * f.irradiance;
    if (!known)
        return;
    const float guided = f.irradiance > 0 ? known->map.pdf_w(f.direction) : 0;
    const ShareCandidates tried = second_moments(f.value, f.pdf_w, guided, known->share);
    if (!std::ranges::all_of(tried, [](float s) { return std::isfinite(s); }))
        return;
    for (std::size_t i = 0; i < squares.size(); ++i)
        squares[i] += static_cast<double>(tried[i]);
    fourth += static_cast<double>(tried[0]) * static_cast<double>(tried[0]);
}

void GuidingLearner::Sums::add(const Sums& other) {
    for (std::size_t b = 0; b < first.size(); ++b) {
        first[b] += other.first[b];
        second[b] += other.second[b];
    }
    for (std::size_t i = 0; i < squares.size(); ++i)
        squares[i] += other.squares[i];
    fourth += other.fourth;
}

double GuidingLearner::Sums::samples() const {
    const double all = std::accumulate(first.begin(), first.end(), 0.0);
    const double all_squares = std::accumulate(second.begin(), second.end(), 0.0);
    return all_squares > 0 ? all * all / all_squares : 0;
}

double GuidingLearner::Sums::share_samples() const {
    const double samples = fourth > 0 ? squares[0] * squares[0] / fourth : 0;
    return samples >= least_samples ? samples : 0;
}

std::size_t GuidingLearner::Sums::best_share() const {
    const auto best = std::ranges::min_element(squares);
    const bool pays = *best < (1 - least_gain) * squares[0];
    return pays ? static_cast<std::size_t>(best - squares.begin()) : 0;
}

float GuidingLearner::fraction_of_paths(int pixels, int index, bool draws) {
    const auto share = [pixels](int paths) {
        return std::min(1.0f, static_cast<float>(paths) / static_cast<float>(pixels));
    };
    if (index == 0)
        return share(first_paths);
    const auto passes = static_cast<float>(std::bit_floor(static_cast<unsigned>(index)));
    return std::max(share(most_paths) / passes, share(least_paths)) * (draws ? 1 : idle_fraction);
}

std::uint64_t GuidingLearner::bytes_of_found(int pixels) {
    constexpr std::uint64_t vertices = 4; // usual for a path that finds light
    return static_cast<std::uint64_t>(std::min(pixels, most_paths)) * vertices * sizeof(FoundLight);
}

std::uint64_t GuidingLearner::bytes_of_learnt() {
    // Twice, for the coarser grids and for the guides in use. Few cells contain surfaces, which leaves room for
    // the two halves of the first pass.
    constexpr std::uint64_t cells = std::uint64_t{cells_along} * cells_along * cells_along * GuidingGrid::sides;
    return 2 * cells * (sizeof(Sums) + sizeof(DirectionGuide));
}

/// Sets the grid to percentiles 1 to 99 of the positions, because some can be far away, as behind a window.
/// Without samples, it sets none.
void GuidingLearner::lay_grid(std::span<const std::vector<FoundLight>> found) {
    glm::vec3 high;
    std::vector<float> places;
    const auto rank = [&places](std::size_t hundredths) {
        const auto at = places.begin() + static_cast<std::ptrdiff_t>(places.size() * hundredths / 100);
        std::ranges::nth_element(places, at);
        return *at;
    };
    for (int axis = 0; axis < 3; ++axis) {
        places.clear();
        for (const std::vector<FoundLight>& block : found)
            for (const FoundLight& f : block)
                places.push_back(f.position[axis]);
        if (places.empty())
            return;
        grid_.low[axis] = rank(1);
        high[axis] = rank(99);
    }
    const glm::vec3 extent = high - grid_.low;
    const float longest = std::max({extent.x, extent.y, extent.z, 1e-30f});
    grid_.cells_per_length = cells_along / longest;
    grid_.size = glm::clamp(glm::ivec3(extent * grid_.cells_per_length + 1.0f), 1, cells_along);
    cells_.resize(static_cast<std::size_t>(grid_.count()));
}

void GuidingLearner::learn(std::span<const std::vector<FoundLight>> found) {
    if (cells_.empty()) {
        lay_grid(found);
        return learn_by_halves(found);
    }
    for (const std::vector<FoundLight>& block : found)
        for (const FoundLight& f : block)
            add(f, guiding_.get());
}

/// Learns from the first pass. Guides made from the same samples that evaluate them would seem to pay everywhere,
/// so each half of the samples evaluates the guides of the other half.
void GuidingLearner::learn_by_halves(std::span<const std::vector<FoundLight>> found) {
    constexpr std::size_t run = 64; // consecutive samples of one half: most paths stay in one half
    const auto for_each = [&](const auto& visit) {
        std::size_t i = 0;
        for (const std::vector<FoundLight>& block : found)
            for (const FoundLight& f : block)
                visit(f, i++ / run % 2);
    };
    std::array<GuidingLearner, 2> halves;
    for (GuidingLearner& half : halves) {
        half.grid_ = grid_;
        half.cells_.resize(cells_.size());
    }
    for_each([&](const FoundLight& f, std::size_t half) { halves[half].add(f, nullptr); });
    for (GuidingLearner& half : halves)
        half.make_guiding(Guiding::off);
    for_each([&](const FoundLight& f, std::size_t half) { add(f, halves[1 - half].guiding_.get()); });
}

void GuidingLearner::add(const FoundLight& f, const PathGuiding* drawn_with) {
    std::unique_ptr<Sums>& sums = cells_[grid_.cell_of(f.position, f.normal)];
    if (!sums)
        sums = std::make_unique<Sums>();
    sums->add(f, drawn_with ? drawn_with->known_at(f.position, f.normal) : nullptr);
}

GuidingGrid GuidingLearner::coarser(int times) const {
    GuidingGrid grid = grid_;
    grid.size = ((grid_.size - 1) >> times) + 1;
    grid.cells_per_length /= static_cast<float>(1 << times);
    return grid;
}

GuidingLearner::Cells GuidingLearner::merged(int times) const {
    const GuidingGrid grid = coarser(times);
    Cells cells(static_cast<std::size_t>(grid.count()));
    for_each_cell(grid_, [&](glm::ivec3 cell, int side) {
        const std::unique_ptr<Sums>& from = cells_[grid_.index(cell, side)];
        std::unique_ptr<Sums>& to = cells[grid.index(cell >> times, side)];
        if (from && !to)
            to = std::make_unique<Sums>();
        if (from)
            to->add(*from);
    });
    return cells;
}

DirectionGuide GuidingLearner::guide_of(const Sums& sums, const DirectionGuide* prior) {
    DirectionMap::Shares expected;
    for (int b = 0; b < DirectionMap::bins; ++b)
        expected[b] = prior ? prior->map.share(b) : 1.0f / DirectionMap::bins;
    const DirectionMap::Shares shares =
        distribute(Quadtree::sums_of(sums.first), Quadtree::sums_of(sums.second), Quadtree::sums_of(expected));
    const float unknown = prior ? prior->share : prior_share;
    return {DirectionMap(shares), sums.share_samples() > 0 ? share_candidates[sums.best_share()] : unknown};
}

double GuidingLearner::remaining_second_moment() const {
    double logs = 0, all = 0;
    for (const std::unique_ptr<Sums>& sums : cells_)
        if (const double share_samples = sums ? sums->share_samples() : 0; share_samples > 0) {
            logs += share_samples * std::log(sums->squares[sums->best_share()] / sums->squares[0]);
            all += share_samples;
        }
    return all > 0 ? std::exp(logs / all) : 1;
}

std::shared_ptr<const PathGuiding> GuidingLearner::make_guiding(Guiding when) {
    if (cells_.empty())
        return {};
    std::vector<DirectionGuide> guides;
    std::vector<int> above; // index of the guide of each cell of the coarser grid; -1: none
    for (int times = halvings; times >= 0; --times) {
        const GuidingGrid grid = coarser(times), coarse = coarser(times + 1);
        const Cells cells = merged(times);
        std::vector<int> guide_of_cell(cells.size(), -1);
        for_each_cell(grid, [&](glm::ivec3 cell, int side) {
            const auto i = static_cast<std::size_t>(grid.index(cell, side));
            if (!above.empty())
                guide_of_cell[i] = above[coarse.index(cell >> 1, side)];
            const double samples = cells[i] ? cells[i]->samples() : 0;
            if (!(samples >= least_samples)) // true for NaN, of sums that overflow
                return;
            const int prior = std::exchange(guide_of_cell[i], static_cast<int>(guides.size()));
            guides.push_back(guide_of(*cells[i], prior < 0 ? nullptr : &guides[prior]));
        });
        above = std::move(guide_of_cell);
    }
    const double left = remaining_second_moment();
    if (when == Guiding::off || (when == Guiding::automatic && left >= max_remaining))
        for (DirectionGuide& guide : guides)
            guide.share = 0;
    guiding_ = std::make_shared<const PathGuiding>(grid_, std::move(above), std::move(guides), left);
    return guiding_;
}

} // namespace tessera
