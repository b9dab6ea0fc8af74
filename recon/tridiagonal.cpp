#include "recon/tridiagonal.h"

#include <algorithm>
#include <array>

namespace tessera {

TridiagonalColumns::Block TridiagonalColumns::factor_block(const double* mu, int height) {
    Block block;
    std::array<double, column_block> c{}; // of the row before
    const auto row = [&](int y) {
        // Differences to the rows above and below.
        const int neighbours = (y > 0) + (y < height - 1);
        std::array<double, column_block> next;
        for (int i = 0; i < column_block; ++i)
            next[i] = 1 / (mu[i] + neighbours - c[i]);
        return next;
    };
    for (bool changed = true; block.rows < height - 1 && changed; ++block.rows) {
        const auto next = row(block.rows);
        changed = false;
        for (int i = 0; i < column_block; ++i)
            changed = changed || static_cast<float>(next[i]) != static_cast<float>(c[i]);
        c = next;
        block.factors.insert(block.factors.end(), c.begin(), c.end());
    }
    const auto last = row(height - 1);
    block.last.assign(last.begin(), last.end());
    return block;
}

void TridiagonalColumns::factor(const std::vector<double>& mu) {
    blocks_.clear();
    for (std::size_t first = 0; first < mu.size(); first += column_block)
        blocks_.push_back(factor_block(mu.data() + first, height_));
}

void TridiagonalColumns::solve(int block_index, float* values) const {
    const Block& block = blocks_[block_index];
    const auto factors = [&](int y) {
        return y == height_ - 1 ? block.last.data()
                                : block.factors.data() + std::min(y, block.rows - 1) * column_block;
    };
    constexpr int chains = 3 * column_block / lanes; // independent recurrences, channel by channel
    const auto place = [&](int y, int chain) {
        const int channel = chain / 2;
        return values + (static_cast<std::size_t>(channel) * height_ + y) * column_block + chain % 2 * lanes;
    };
    Lanes previous[chains] = {};
    for (int y = 0; y < height_; ++y) {
        const float* c = factors(y);
        const Lanes c_halves[2] = {load(c), load(c + lanes)};
        for (int i = 0; i < chains; ++i) {
            previous[i] = c_halves[i % 2] * (load(place(y, i)) + previous[i]);
            store(place(y, i), previous[i]);
        }
    }
    for (int y = height_ - 2; y >= 0; --y) {
        const float* c = factors(y);
        const Lanes c_halves[2] = {load(c), load(c + lanes)};
        for (int i = 0; i < chains; ++i) {
            previous[i] = load(place(y, i)) + c_halves[i % 2] * previous[i];
            store(place(y, i), previous[i]);
        }
    }
}

} // namespace tessera
