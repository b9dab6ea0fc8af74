#include "recon/solvers/weighted_multigrid.h"

#include "recon/solvers/poisson_weighted.h"
#include "recon/solvers/weighted_rows.h"

#include <algorithm>

namespace tessera {

namespace {

// Chosen by trials on five scenes, with 3 and 14 samples a pixel.
constexpr float stiffness = 0.75f; // weight of an edge, relative to the sum of the finer edges
constexpr float damping = 0.9f;

constexpr int band_rows = 16; // rows processed at a time, which stay in the L2 cache

/// Calls body(first, end) for bands of rows.
template <class Body>
void for_bands(int height, const ParallelFor& parallel_for, const Body& body) {
    parallel_for((height + band_rows - 1) / band_rows,
                 [&](int i) { body(i * band_rows, std::min((i + 1) * band_rows, height)); });
}

/// Rows of a band, and one row above and below inside the image, 3 values a pixel.
class Band {
public:
    /// @param make  make(y, row) writes row y
    template <class Make>
    Band(int first, int end, glm::ivec2 size, const Make& make)
        : first_(std::max(first - 1, 0)), stride_(3 * size.x) {
        const int last = std::min(end, size.y - 1);
        values_.resize(static_cast<std::size_t>(last - first_ + 1) * static_cast<std::size_t>(stride_));
        for (int y = first_; y <= last; ++y)
            make(y, row(y));
    }

    float* row(int y) { return values_.data() + place(y); }
    const float* row(int y) const { return values_.data() + place(y); }

private:
    std::size_t place(int y) const {
        return static_cast<std::size_t>(y - first_) * static_cast<std::size_t>(stride_);
    }

    int first_, stride_;
    PixelVector<float> values_;
};

/// Calls combine(number, value, out) for the values of a row, with the number of their pixel.
template <class Combine>
void for_values(const float* numbers, const float* in, int width, float* out, const Combine& combine) {
    float spread_numbers[chunk_values];
    for (int x = 0; x < width; x += chunk_pixels) {
        const int count = std::min(chunk_pixels, width - x);
        spread(numbers + x, count, spread_numbers);
        for (int i = 0; i < 3 * count; ++i)
            combine(spread_numbers[i], in[3 * x + i], out[3 * x + i]);
    }
}

/// Prolongation: adds to each pixel of a row the value of its cell of the next level.
void add_cells(const float* cells, int width, float* row) {
    for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
            row[3 * x + c] += cells[3 * (x / 2) + c];
}

/// Restriction: adds each pixel of a row to its cell of the next level.
void add_to_cells(const float* row, int width, float* cells) {
    for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
            cells[3 * (x / 2) + c] += row[3 * x + c];
}

} // namespace

/// The matrix of one level, and its right side and solution.
struct WeightedMultigrid::Level {
    Level(int width, int height) : screening(width, height), step(width, height) {}

    glm::ivec2 size() const { return {step.width(), step.height()}; }
    void find_steps(const ParallelFor& parallel_for);
    void coarsen(const Level& finer, const ParallelFor& parallel_for);
    void write_misfit(const RgbImage& b, const Band& x, int y, float* out) const;
    void restrict_residual(const RgbImage& b, Level& coarser, const ParallelFor& parallel_for) const;
    void prolong_correction(const RgbImage& b, const Level& coarser, RgbImage& answer,
                            const ParallelFor& parallel_for) const;

    const EdgeWeights* weights = nullptr;
    Image<float> screening, step; ///< alpha^2 of each cell, and the Jacobi step s
    // Empty in the first level.
    EdgeWeights own;
    RgbImage right_side, solved;
};

WeightedMultigrid::WeightedMultigrid(int width, int height) {
    levels_.emplace_back(width, height);
    while (width > 1 || height > 1) {
        width = (width + 1) / 2;
        height = (height + 1) / 2;
        Level& level = levels_.emplace_back(width, height);
        level.own = {Image<float>(width, height), Image<float>(width, height)};
        level.right_side = level.solved = RgbImage(width, height);
    }
}

WeightedMultigrid::~WeightedMultigrid() = default;

std::uint64_t WeightedMultigrid::bytes(int width, int height, int threads) {
    const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    constexpr std::uint64_t first = 2 * sizeof(float), others = 4 * sizeof(float) + 2 * sizeof(Rgb);
    const auto bands = static_cast<std::uint64_t>(std::min(threads, height / band_rows + 1));
    return first * pixels + others * (pixels / 3 + static_cast<std::uint64_t>(width + height) + 2) +
           bands * (band_rows + 3) * sizeof(Rgb) * static_cast<std::uint64_t>(width);
}

void WeightedMultigrid::Level::find_steps(const ParallelFor& parallel_for) {
    parallel_for(step.height(), [&](int y) {
        for (int x = 0; x < step.width(); ++x) {
            const float left = x > 0 ? weights->x(x - 1, y) : 0, above = y > 0 ? weights->y(x, y - 1) : 0;
            step(x, y) = damping / (screening(x, y) + left + weights->x(x, y) + above + weights->y(x, y));
        }
    });
}

void WeightedMultigrid::Level::coarsen(const Level& finer, const ParallelFor& parallel_for) {
    const auto [width, height] = std::pair(finer.step.width(), finer.step.height());
    const EdgeWeights& fine = *finer.weights;
    weights = &own;
    parallel_for(step.height(), [&](int y) {
        const int rows = std::min(2, height - 2 * y);
        for (int x = 0; x < step.width(); ++x) {
            const int columns = std::min(2, width - 2 * x);
            float sum = 0, right = 0, below = 0;
            for (int j = 2 * y; j < 2 * y + rows; ++j) {
                for (int i = 2 * x; i < 2 * x + columns; ++i)
                    sum += finer.screening(i, j);
                right += fine.x(2 * x + columns - 1, j); // 0 in the last column
            }
            for (int i = 2 * x; i < 2 * x + columns; ++i)
                below += fine.y(i, 2 * y + rows - 1);
            screening(x, y) = sum;
            own.x(x, y) = stiffness * right;
            own.y(x, y) = stiffness * below;
        }
    });
}

/// Writes row y of b - A x.
void WeightedMultigrid::Level::write_misfit(const RgbImage& b, const Band& x, int y, float* out) const {
    const auto screened = [&](int first, int row, int count, float* to) {
        float spread_screening[chunk_values];
        spread(screening.row(row) + first, count, spread_screening);
        const float *given = values(b, first, row), *here = x.row(row) + 3 * first;
        for (int i = 0; i < 3 * count; ++i)
            to[i] = given[i] - spread_screening[i] * here[i];
    };
    const auto from_right = [&](int first, int row, int count, float* to) {
        const float* here = x.row(row) + 3 * first;
        for (int i = 0; i < 3 * count; ++i)
            to[i] = here[i] - here[i + 3];
    };
    const auto from_below = [&](int first, int row, int count, float* to) {
        const float *here = x.row(row) + 3 * first, *below = x.row(row + 1) + 3 * first;
        for (int i = 0; i < 3 * count; ++i)
            to[i] = here[i] - below[i];
    };
    write_row(*weights, y, screened, from_right, from_below, out);
}

/// Writes the right side of the next level: the residual after a Jacobi step from 0, summed over its cells.
void WeightedMultigrid::Level::restrict_residual(const RgbImage& b, Level& coarser,
                                                 const ParallelFor& parallel_for) const {
    const int width = step.width();
    for_bands(step.height(), parallel_for, [&](int first, int end) {
        const Band x(first, end, size(), [&](int y, float* row) {
            for_values(step.row(y), values(b, 0, y), width, row, [](float s, float r, float& to) { to = s * r; });
        });
        PixelVector<float> misfit(3 * static_cast<std::size_t>(width));
        for (int y = first; y < end; ++y) {
            write_misfit(b, x, y, misfit.data());
            float* cells = values(coarser.right_side, 0, y / 2);
            if (y % 2 == 0)
                std::fill_n(cells, 3 * coarser.step.width(), 0.0f);
            add_to_cells(misfit.data(), width, cells);
        }
    });
}

/// Repeats that step, adds the correction of the next level, and takes another step.
void WeightedMultigrid::Level::prolong_correction(const RgbImage& b, const Level& coarser, RgbImage& answer,
                                                  const ParallelFor& parallel_for) const {
    const int width = step.width();
    for_bands(step.height(), parallel_for, [&](int first, int end) {
        const Band x(first, end, size(), [&](int y, float* row) {
            for_values(step.row(y), values(b, 0, y), width, row, [](float s, float r, float& to) { to = s * r; });
            add_cells(values(coarser.solved, 0, y / 2), width, row);
        });
        for (int y = first; y < end; ++y) {
            float* to = values(answer, 0, y);
            write_misfit(b, x, y, to);
            const float* old_row = x.row(y);
            for_values(step.row(y), old_row, width, to, [](float s, float old, float& r) { r = old + s * r; });
        }
    });
}

void WeightedMultigrid::prepare(const EdgeWeights& weights, float alpha, const ParallelFor& parallel_for) {
    std::fill(levels_[0].screening.begin(), levels_[0].screening.end(), alpha * alpha);
    levels_[0].weights = &weights;
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        if (l > 0)
            levels_[l].coarsen(levels_[l - 1], parallel_for);
        levels_[l].find_steps(parallel_for);
    }
}

void WeightedMultigrid::apply(const RgbImage& r, RgbImage& z, const ParallelFor& parallel_for) {
    const std::size_t last = levels_.size() - 1;
    const auto right_side = [&](std::size_t l) -> const RgbImage& { return l == 0 ? r : levels_[l].right_side; };
    const auto answer = [&](std::size_t l) -> RgbImage& { return l == 0 ? z : levels_[l].solved; };
    for (std::size_t l = 0; l < last; ++l)
        levels_[l].restrict_residual(right_side(l), levels_[l + 1], parallel_for);
    answer(last)(0, 0) = right_side(last)(0, 0) / levels_[last].screening(0, 0);
    for (std::size_t l = last; l-- > 0;)
        levels_[l].prolong_correction(right_side(l), levels_[l + 1], answer(l), parallel_for);
}

} // namespace tessera
