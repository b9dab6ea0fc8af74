#pragma once

#include "recon/lanes.h"

#include <vector>

namespace tessera {

/// Columns that are solved together.
inline constexpr int column_block = 2 * lanes;

/// Solves (mu_k + T) u = b for many columns k, each with its own mu_k > 0, where T is the second difference down a
/// column with free ends: (T u)(y) = sum over the neighbours y' of y of u(y) - u(y').
///
/// Thomas's algorithm: with c(0) = 1 / (mu + 1) and c(y) = 1 / (mu + 2 - c(y-1)), where at the last row 1 stands
/// for the 2, the sweep down z(y) = c(y) (b(y) + z(y-1)) and the sweep up u(y) = z(y) + c(y) u(y+1) give the
/// answer. c soon reaches a fixed point; only the rows before are kept. It is worked out in double: 1 - c tells
/// low frequencies apart, and is small.
class TridiagonalColumns {
public:
    /// `height` rows >= 1.
    explicit TridiagonalColumns(int height) : height_(height) {}

    /// Prepares for one mu a column; mu.size() is a multiple of column_block.
    void factor(const std::vector<double>& mu);

    int blocks() const { return static_cast<int>(blocks_.size()); }

    /// Solves columns [block * column_block, (block + 1) * column_block) of the three channels in place:
    /// values[(channel * height + y) * column_block + column].
    void solve(int block, float* values) const;

private:
    struct Block {
        std::vector<float> factors; ///< c(y), column by column, of the rows up to the fixed point
        std::vector<float> last;    ///< c of the last row
        int rows = 0;
    };

    static Block factor_block(const double* mu, int height);

    int height_;
    std::vector<Block> blocks_;
};

} // namespace tessera
