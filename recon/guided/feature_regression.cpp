#include "recon/guided/feature_regression.h"

#include "recon/lanes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace tessera {

namespace {

constexpr int radius = 2, edge = 2 * radius + 1;
constexpr int most_terms = feature_count + 1; // the slope in each feature, and then the constant
constexpr float rounding = 1e-5f; // ridge relative to a feature's own sum of squares, which floats resolve

/// A part of a row of the picture, from `radius` to the left of lane 0 on; 0 beyond the picture.
class Stretch {
public:
    Stretch(const Plane& plane, int x, int y) : values_(plane.row(y) + x - radius) {
        const int begin = std::max(0, radius - x), end = std::min(size, plane.width() - x + radius);
        if (begin == 0 && end == size)
            return;
        std::fill_n(at_border_, size, 0.0f);
        std::copy(values_ + begin, values_ + end, at_border_ + begin);
        values_ = at_border_;
    }
    Stretch(const Stretch&) = delete;
    Stretch& operator=(const Stretch&) = delete;

    /// From i of its numbers on.
    Lanes from(int i) const { return load(values_ + i); }

private:
    static constexpr int size = lanes + 2 * radius;
    const float* values_;
    float at_border_[size];
};

/// A row of each square: the weights of its pixels, and what they bring: features less those of the middle pixel,
/// and 1. Rows are taken as a whole, as each sum would else be fetched and put back for each pixel.
struct Row {
    Lanes weights[edge], brings[edge][most_terms];
};

/// Squares around pixels of a row, and their fits.
struct Squares {
    int x, y, begin, end; ///< of lane 0; and the rows that are in the picture
    int terms; ///< features that vary in any of the squares, beyond the picture counting as 0, and the constant
    Row rows[edge];
    Lanes matrix[most_terms][most_terms]; ///< of the normal equations: the lower triangle of a symmetric matrix
    Lanes solution[most_terms];
};

/// Is any of the lanes a number but 0, or none?
bool is_any_set(Lanes values) {
    bool is = false;
    for (int l = 0; l < lanes; ++l)
        is |= values[l] != 0;
    return is;
}

/// Writes a feature as term k of the rows. False: it is the same in all of these squares, and has no term.
bool write_feature(const Plane& feature, int k, Squares& squares) {
    const Lanes middle = Stretch(feature, squares.x, squares.y).from(radius);
    Lanes sizes{};
    for (int y = squares.begin; y < squares.end; ++y) {
        Row& row = squares.rows[y - squares.begin];
        const Stretch values(feature, squares.x, y);
        for (int p = 0; p < edge; ++p) {
            row.brings[p][k] = values.from(p) - middle;
            sizes += row.brings[p][k] * row.brings[p][k];
        }
    }
    return is_any_set(sizes);
}

void look_at(const FeaturePlanes& features, const Plane& weights, Squares& squares) {
    squares.begin = std::max(0, squares.y - radius);
    squares.end = std::min(squares.y + radius + 1, weights.height());
    int terms = 0;
    for (const Plane& feature : features)
        terms += write_feature(feature, terms, squares);
    squares.terms = terms + 1;
    for (int y = squares.begin; y < squares.end; ++y) {
        Row& row = squares.rows[y - squares.begin];
        const Stretch weight(weights, squares.x, y);
        for (int p = 0; p < edge; ++p) {
            row.weights[p] = weight.from(p);
            row.brings[p][terms] = Lanes{} + 1;
        }
    }
}

void add_row(const Row& row, int terms, Lanes (&matrix)[most_terms][most_terms]) {
    for (int i = 0; i < terms; ++i) {
        Lanes weighted[edge];
        for (int p = 0; p < edge; ++p)
            weighted[p] = row.weights[p] * row.brings[p][i];
        for (int j = 0; j <= i; ++j) {
            Lanes sum = matrix[i][j];
            for (int p = 0; p < edge; ++p)
                sum += weighted[p] * row.brings[p][j];
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

/// By Cholesky's decomposition, for the last unit vector: the last row of the inverse says what a is of the
/// values, sum over q of w_q (solution . what q brings) x_q.
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

/// Shares sum to 1 but for rounding, which is made up for. Where features are too large to be squared, a pixel
/// stays what it is.
void apply(std::span<const Plane> values, const Squares& squares, std::span<Plane> fitted) {
    const int x = squares.x;
    Lanes all{};
    Lanes own[most_regressed], sums[most_regressed];
    for (std::size_t c = 0; c < values.size(); ++c) {
        own[c] = Stretch(values[c], x, squares.y).from(radius);
        sums[c] = Lanes{};
    }
    for (int y = squares.begin; y < squares.end; ++y) {
        const Row& row = squares.rows[y - squares.begin];
        Lanes shares[edge];
        for (int p = 0; p < edge; ++p) {
            shares[p] = Lanes{};
            for (int k = 0; k < squares.terms; ++k)
                shares[p] += squares.solution[k] * row.brings[p][k];
            shares[p] *= row.weights[p];
            all += shares[p];
        }
        for (std::size_t c = 0; c < values.size(); ++c) {
            const Stretch value(values[c], x, y);
            for (int p = 0; p < edge; ++p)
                sums[c] += shares[p] * value.from(p);
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
        throw std::invalid_argument("a regression is of six planes at the most, and has as many answers");
    parallel_for(weights.height(), [&](int y) {
        Squares squares;
        squares.y = y;
        for (squares.x = 0; squares.x < weights.width(); squares.x += lanes) {
            look_at(features, weights, squares);
            set_up(ridge, squares);
            solve(squares);
            apply(values, squares, fitted);
        }
    });
}

} // namespace tessera
