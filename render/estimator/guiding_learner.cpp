#include "render/estimator/guiding_learner.h"

#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

namespace tessera {

namespace {

constexpr int cells_along = 12;     // of the grid's longest side
constexpr int most_paths = 1 << 20; // of a pass, that are learnt from
constexpr int halvings = 2;         // of which coarser grids are made, which tell of cells where little was found
constexpr double least_samples = 8; // of which a map is made
constexpr float prior_samples = 4;  // that the coarser cell's map, or evenness, counts as

/// A square of bins, a power of two along its edge.
struct Square {
    int x, y, edge;

    Square quarter(int q) const { return {x + q % 2 * (edge / 2), y + q / 2 * (edge / 2), edge / 2}; }
    float sum(const DirectionMap::Shares& bins) const {
        float total = 0;
        for (int j = y; j < y + edge; ++j)
            for (int i = x; i < x + edge; ++i)
                total += bins[static_cast<std::size_t>(j * DirectionMap::edge + i)];
        return total;
    }
};

/// Shares a square's mass out among its quarters, and so on: by what was found there as far as that stands on many
/// samples, and by the prior as far as on few.
struct Sharing {
    const DirectionMap::Shares &first, &second, &prior;
    DirectionMap::Shares shares{};

    void share_out(Square square, float mass) {
        if (square.edge == 1) {
            shares[static_cast<std::size_t>(square.y * DirectionMap::edge + square.x)] = mass;
            return;
        }
        const float all = square.sum(first), squares = square.sum(second), prior_all = square.sum(prior);
        const float samples = squares > 0 ? all * (all / squares) : 0;
        for (int q = 0; q < 4; ++q) {
            const Square part = square.quarter(q);
            const float found = all > 0 ? part.sum(first) / all : 0.25f;
            const float expected = prior_all > 0 ? part.sum(prior) / prior_all : 0.25f;
            share_out(part, mass * (samples * found + prior_samples * expected) / (samples + prior_samples));
        }
    }
};

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

void GuidingLearner::Sums::add(const Sums& other) {
    for (std::size_t b = 0; b < first.size(); ++b) {
        first[b] += other.first[b];
        second[b] += other.second[b];
    }
}

double GuidingLearner::Sums::samples() const {
    const double all = std::accumulate(first.begin(), first.end(), 0.0);
    const double squares = std::accumulate(second.begin(), second.end(), 0.0);
    return squares > 0 ? all * all / squares : 0;
}

float GuidingLearner::share_of_paths(int pixels, int index) {
    constexpr float most = most_paths;
    const auto passes = static_cast<float>(std::bit_floor(static_cast<unsigned>(std::max(index, 1))));
    return std::min(most / (static_cast<float>(pixels) * passes), 1.0f);
}

std::uint64_t GuidingLearner::bytes(int pixels) {
    constexpr std::uint64_t vertices = 4; // of a path that finds light, as they mostly are
    constexpr std::uint64_t cells = std::uint64_t{cells_along} * cells_along * cells_along * GuidingGrid::sides;
    const auto paths = static_cast<std::uint64_t>(std::min(pixels, most_paths));
    return paths * vertices * sizeof(FoundLight) + 2 * cells * (sizeof(Sums) + sizeof(DirectionMap));
}

/// Around nearly all places: a few may be far away, seen through a window. None: there is no grid yet.
void GuidingLearner::lay_grid(std::span<const std::vector<FoundLight>> found) {
    glm::vec3 high;
    std::vector<float> places;
    for (int axis = 0; axis < 3; ++axis) {
        places.clear();
        for (const std::vector<FoundLight>& block : found)
            for (const FoundLight& f : block)
                places.push_back(f.position[axis]);
        if (places.empty())
            return;
        std::ranges::sort(places);
        grid_.low[axis] = places[places.size() / 100];
        high[axis] = places[places.size() * 99 / 100];
    }
    const glm::vec3 extent = high - grid_.low;
    const float longest = std::max({extent.x, extent.y, extent.z, 1e-30f});
    grid_.cells_a_length = cells_along / longest;
    grid_.size = glm::clamp(glm::ivec3(extent * grid_.cells_a_length + 1.0f), 1, cells_along);
    cells_.resize(static_cast<std::size_t>(grid_.count()));
}

void GuidingLearner::learn(std::span<const std::vector<FoundLight>> found) {
    if (cells_.empty())
        lay_grid(found);
    for (const std::vector<FoundLight>& block : found)
        for (const FoundLight& f : block)
            add(f);
}

void GuidingLearner::add(const FoundLight& f) {
    std::unique_ptr<Sums>& sums = cells_[static_cast<std::size_t>(grid_.cell_of(f.position, f.normal))];
    if (!sums)
        sums = std::make_unique<Sums>();
    const auto bin = static_cast<std::size_t>(DirectionMap::bin_of(f.direction));
    sums->first[bin] += f.irradiance;
    sums->second[bin] += f.irradiance * f.irradiance;
}

GuidingGrid GuidingLearner::coarser(int times) const {
    GuidingGrid grid = grid_;
    grid.size = ((grid_.size - 1) >> times) + 1;
    grid.cells_a_length /= static_cast<float>(1 << times);
    return grid;
}

GuidingLearner::Cells GuidingLearner::merged(int times) const {
    const GuidingGrid grid = coarser(times);
    Cells cells(static_cast<std::size_t>(grid.count()));
    for_each_cell(grid_, [&](glm::ivec3 cell, int side) {
        const std::unique_ptr<Sums>& from = cells_[static_cast<std::size_t>(grid_.index(cell, side))];
        std::unique_ptr<Sums>& to = cells[static_cast<std::size_t>(grid.index(cell >> times, side))];
        if (from && !to)
            to = std::make_unique<Sums>();
        if (from)
            to->add(*from);
    });
    return cells;
}

DirectionMap GuidingLearner::map_of(const Sums& sums, const DirectionMap* prior) {
    DirectionMap::Shares expected;
    for (int b = 0; b < DirectionMap::bins; ++b)
        expected[static_cast<std::size_t>(b)] = prior ? prior->share(b) : 1.0f / DirectionMap::bins;
    Sharing sharing{sums.first, sums.second, expected};
    sharing.share_out({0, 0, DirectionMap::edge}, 1);
    return DirectionMap(sharing.shares);
}

std::shared_ptr<const PathGuiding> GuidingLearner::guiding() const {
    if (cells_.empty())
        return {};
    std::vector<DirectionMap> maps;
    std::vector<int> above; // of the coarser grid, which map a cell has
    for (int times = halvings; times >= 0; --times) {
        const GuidingGrid grid = coarser(times), coarse = coarser(times + 1);
        const Cells cells = merged(times);
        std::vector<int> map_of_cell(cells.size(), -1);
        for_each_cell(grid, [&](glm::ivec3 cell, int side) {
            const auto i = static_cast<std::size_t>(grid.index(cell, side));
            if (!above.empty())
                map_of_cell[i] = above[static_cast<std::size_t>(coarse.index(cell >> 1, side))];
            const double samples = cells[i] ? cells[i]->samples() : 0;
            if (!(samples >= least_samples)) // nor where sums have become too large for floats
                return;
            const int prior = std::exchange(map_of_cell[i], static_cast<int>(maps.size()));
            maps.push_back(map_of(*cells[i], prior < 0 ? nullptr : &maps[static_cast<std::size_t>(prior)]));
        });
        above = std::move(map_of_cell);
    }
    return std::make_shared<const PathGuiding>(grid_, std::move(above), std::move(maps));
}

} // namespace tessera
