#include "recon/guided/feature_regression.h"

#include "recon/lanes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace tessera {

namespace {

constexpr int radius = 2, edge = 2 * radius + 1;
constexpr int most_terms = feature_count + 1; // a slope for each feature, and the constant last
constexpr float rounding = 1e-5f;             // ridge relative to a feature's sum of squares, for precision

/// Window of a row, from `radius` pixels left of lane 0 on; 0 outside the picture.
class RowWindow {
public:
    RowWindow(const Plane& plane, int x, int y) : values_(plane.row(y) + x - radius) {
        const int begin = std::max(0, radius - x), end = std::min(size, plane.width() - x + radius);
        if (begin == 0 && end == size)
            return;
        std::fill_n(at_border_, size, 0.0f);
        std::copy(values_ + begin, values_ + end, at_border_ + begin);
        values_ = at_border_;
    }
    RowWindow(const RowWindow&) = delete;
    RowWindow& operator=(const RowWindow&) = delete;

    /// Returns `lanes` numbers from offset i on.
    Lanes from(int i) const { return load(values_ + i); }

private:
    static constexpr int size = lanes + 2 * radius;
    const float* values_;
    float at_border_[size];
};

/// One row of the square of each lane: weights w, and regressors f(q) - f(p) and 1 of its pixels. Whole rows are
/// accumulated at once, so that sums are loaded and stored once for each row.
struct Row {
    Lanes weights[edge], regressors[edge][most_terms];
};

/// Squares around `lanes` pixels of a row, and their fits.
struct Squares {
    int x, y, begin, end; ///< pixel of lane 0; rows of the square inside the picture
    int terms;            ///< features that vary in any of the squares (0 outside the picture), and the constant
    Row rows[edge];
    Lanes matrix[most_terms][most_terms]; ///< lower triangle of the normal equations
    Lanes solution[most_terms];
};

/// Returns whether any lane is not 0 (NaN included).
bool is_any_set(Lanes values) {
    bool is = false;
    for (int l = 0; l < lanes; ++l)
        is |= values[l] != 0;
    return is;
}

/// Writes a feature as regressor k of the rows. Returns false if it is constant in all squares and needs no term.
bool write_feature(const Plane& feature, int k, Squares& squares) {
    const Lanes middle = RowWindow(feature, squares.x, squares.y).from(radius);
    Lanes sizes{};
    for (int y = squares.begin; y < squares.end; ++y) {
        Row& row = squares.rows[y - squares.begin];
        const RowWindow values(feature, squares.x, y);
        for (int p = 0; p < edge; ++p) {
            row.regressors[p][k] = values.from(p) - middle;
            sizes += row.regressors[p][k] * row.regressors[p][k];
        }
    }
    return is_any_set(sizes);
}

void gather_regressors(const FeaturePlanes& features, const Plane& weights, Squares& squares) {
    squares.begin = std::max(0, squares.y - radius);
    squares.end = std::min(squares.y + radius + 1, weights.height());
    int terms = 0;
    for (const Plane& feature : features)
        terms += write_feature(feature, terms, squares);
    squares.terms = terms + 1;
    for (int y = squares.begin; y < squares.end; ++y) {
        Row& row = squares.rows[y - squares.begin];
        const RowWindow weight(weights, squares.x, y);
        for (int p = 0; p < edge; ++p) {
            row.weights[p] = weight.from(p);
            row.regressors[p][terms] = Lanes{} + 1;
        }
    }
}

void add_row(const Row& row, int terms, Lanes (&matrix)[most_terms][most_terms]) {
    for (int i = 0; i < terms; ++i) {
        Lanes weighted[edge];
        for (int p = 0; p < edge; ++p)
            weighted[p] = row.weights[p] * row.regressors[p][i];
        for (int j = 0; j <= i; ++j) {
            Lanes sum = matrix[i][j];
            for (int p = 0; p < edge; ++p)
                sum += weighted[p] * row.regressors[p][j];
            matrix[i][j] = sum;
        }
    }
}

void set_up(float ridge, Squares& squares) {
    auto& m = squares.matrix;
    for (auto& row : m)
        std::fill_n(row, squares.terms, Lanes{});
    for (int y = squares.begin; y < squares.end; ++y)
        add_row(squares.rows[y - squares.begin], squares.terms, m);
    Lanes& all = m[squares.terms - 1][squares.terms - 1];
    for (int k = 0; k + 1 < squares.terms; ++k)
        m[k][k] += ridge * all + rounding * m[k][k];
}

Lanes root(Lanes values) {
    for (int l = 0; l < lanes; ++l)
        values[l] = std::sqrt(values[l]);
    return values;
}

/// Solves for the last unit vector by Cholesky decomposition. This last row of the inverse gives a as a weighted
/// sum, a = sum over q of w_q (solution . regressors of q) x_q.
void solve(Squares& squares) {
    auto& m = squares.matrix;
    const int terms = squares.terms;
    for (int j = 0; j < terms; ++j) {
        for (int k = 0; k < j; ++k)
            for (int i = j; i < terms; ++i)
                m[i][j] -= m[i][k] * m[j][k];
        const Lanes scale = 1 / root(m[j][j]);
        for (int i = j; i < terms; ++i)
            m[i][j] *= scale;
    }
    for (int i = terms - 1; i >= 0; --i) {
        Lanes sum = i == terms - 1 ? 1 / m[i][i] : Lanes{};
        for (int j = i + 1; j < terms; ++j)
            sum -= m[j][i] * squares.solution[j];
        squares.solution[i] = sum / m[i][i];
    }
}

/// Writes a of each pixel. The factors of x_q sum to 1 up to rounding, so they are divided by their sum. Pixels
/// whose result is not finite keep their value.
void apply(std::span<const Plane> values, const Squares& squares, std::span<Plane> fitted) {
    const int x = squares.x;
    Lanes all{};
    Lanes own[most_regressed], sums[most_regressed];
    for (std::size_t c = 0; c < values.size(); ++c) {
        own[c] = RowWindow(values[c], x, squares.y).from(radius);
        sums[c] = Lanes{};
    }
    for (int y = squares.begin; y < squares.end; ++y) {
        const Row& row = squares.rows[y - squares.begin];
        Lanes factors[edge];
        for (int p = 0; p < edge; ++p) {
            factors[p] = Lanes{};
            for (int k = 0; k < squares.terms; ++k)
                factors[p] += squares.solution[k] * row.regressors[p][k];
            factors[p] *= row.weights[p];
            all += factors[p];
        }
        for (std::size_t c = 0; c < values.size(); ++c) {
            const RowWindow value(values[c], x, y);
            for (int p = 0; p < edge; ++p)
                sums[c] += factors[p] * value.from(p);
        }
    }
    for (std::size_t c = 0; c < values.size(); ++c) {
        sums[c] /= all;
        for (int l = 0; l < lanes && x + l < values[c].width(); ++l)
            fitted[c](x + l, squares.y) = std::isfinite(sums[c][l]) ? sums[c][l] : own[c][l];
    }
}

} // namespace

void write_regressions(std::span<const Plane> values, const FeaturePlanes& features, const Plane& weights,
                       float ridge, const ParallelFor& parallel_for, std::span<Plane> fitted) {
    if (values.size() > most_regressed || fitted.size() != values.size())
        throw std::invalid_argument("a regression takes at most six planes, and writes as many");
    parallel_for(weights.height(), [&](int y) {
        Squares squares;
        squares.y = y;
        for (squares.x = 0; squares.x < weights.width(); squares.x += lanes) {
            gather_regressors(features, weights, squares);
            set_up(ridge, squares);
            solve(squares);
            apply(values, squares, fitted);
        }
    });
}

} // namespace tessera
