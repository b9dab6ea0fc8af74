#include "recon/solvers/poisson_problem.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace tessera {

namespace {

const float* values(const Rgb* pixels) {
    return &pixels->x;
}

/// Row y of an image and its neighbours. At the border, the row itself replaces a missing neighbour.
struct Rows {
    Rows(const RgbImage& image, int y)
        : here(values(image.row(y))), above(values(image.row(std::max(y - 1, 0)))),
          below(values(image.row(std::min(y + 1, image.height() - 1)))) {}

    const float* here;
    const float* above;
    const float* below;
};

/// Computes value i (3 a pixel) of b - A image, or of b. `left`, `right`, `up` and `down` tell which neighbours
/// exist.
class RowEquation {
public:
    RowEquation(const PoissonProblem& problem, int y)
        : weight_(problem.alpha * problem.alpha), up_(y > 0), down_(y < problem.primal.height() - 1),
          primal_(values(problem.primal.row(y))), dx_(values(problem.dx.row(y))), dy_(problem.dy, y) {}

    template <bool left, bool right, bool up, bool down>
    float right_side(int i) const {
        float sum = weight_ * primal_[i];
        if constexpr (left)
            sum += dx_[i - 3];
        if constexpr (right)
            sum -= dx_[i];
        if constexpr (up)
            sum += dy_.above[i];
        if constexpr (down)
            sum -= dy_.here[i];
        return sum;
    }

    template <bool left, bool right, bool up, bool down>
    float defect(const Rows& image, int i) const {
        const double own = image.here[i];
        double sum = static_cast<double>(weight_) * (primal_[i] - own);
        if constexpr (left)
            sum += dx_[i - 3] - (own - image.here[i - 3]);
        if constexpr (right)
            sum -= dx_[i] - (image.here[i + 3] - own);
        if constexpr (up)
            sum += dy_.above[i] - (own - image.above[i]);
        if constexpr (down)
            sum -= dy_.here[i] - (image.below[i] - own);
        return static_cast<float>(sum);
    }

    bool up() const { return up_; }
    bool down() const { return down_; }

private:
    float weight_;
    bool up_, down_;
    const float* primal_;
    const float* dx_;
    Rows dy_;
};

struct RightSide {
    const RowEquation& equation;
    template <bool left, bool right, bool up, bool down>
    float at(int i) const {
        return equation.right_side<left, right, up, down>(i);
    }
};

struct Defect {
    const RowEquation& equation;
    const Rows& image;
    template <bool left, bool right, bool up, bool down>
    float at(int i) const {
        return equation.defect<left, right, up, down>(image, i);
    }
};

/// Writes pixels [begin, end) of a row of `width`. The first and last pixel lack a neighbour.
template <bool up, bool down, class Source>
void write_row(const Source& source, int width, int begin, int end, float* out) {
    const auto write = [&]<bool left, bool right>(int first, int last) {
        for (int i = 3 * first; i < 3 * last; ++i)
            out[i - 3 * begin] = source.template at<left, right, up, down>(i);
    };
    if (width == 1)
        return write.template operator()<false, false>(begin, end);
    if (begin == 0 && end > 0)
        write.template operator()<false, true>(0, 1);
    write.template operator()<true, true>(std::max(begin, 1), std::min(end, width - 1));
    if (end == width && begin < width)
        write.template operator()<true, false>(width - 1, width);
}

template <class Source>
void write_row(const RowEquation& equation, const Source& source, int width, int begin, int end, float* out) {
    if (equation.up() && equation.down())
        write_row<true, true>(source, width, begin, end, out);
    else if (equation.up())
        write_row<true, false>(source, width, begin, end, out);
    else if (equation.down())
        write_row<false, true>(source, width, begin, end, out);
    else
        write_row<false, false>(source, width, begin, end, out);
}

} // namespace

void poisson_right_side(const PoissonProblem& problem, int y, int begin, int end, float* out) {
    const RowEquation equation(problem, y);
    write_row(equation, RightSide{equation}, problem.primal.width(), begin, end, out);
}

void poisson_defect(const PoissonProblem& problem, const RgbImage& image, int y, int begin, int end, float* out) {
    const RowEquation equation(problem, y);
    const Rows rows(image, y);
    write_row(equation, Defect{equation, rows}, problem.primal.width(), begin, end, out);
}

double poisson_residual(const PoissonProblem& problem, const RgbImage& image, const ParallelFor& parallel_for) {
    const int width = image.width(), height = image.height();
    std::vector<double> defects(height), right_sides(height);
    parallel_for(height, [&](int y) {
        std::vector<float> row(3 * static_cast<std::size_t>(width));
        const auto squared_norm = [&] {
            double sum = 0;
            for (const float value : row)
                sum += static_cast<double>(value) * value;
            return sum;
        };
        poisson_defect(problem, image, y, 0, width, row.data());
        defects[y] = squared_norm();
        poisson_right_side(problem, y, 0, width, row.data());
        right_sides[y] = squared_norm();
    });
    double defect = 0, right_side = 0;
    for (int y = 0; y < height; ++y) {
        defect += defects[y];
        right_side += right_sides[y];
    }
    return defect == 0 ? 0 : std::sqrt(defect / right_side);
}

BorderSource::BorderSource(int width, int extended, int height)
    : width_(width), extended_(extended), height_(height), kernel_(3 * height - 1) {}

void BorderSource::prepare(double alpha) {
    const int h = height_;
    std::vector<double> ratio(h), cosine(2 * h), t(h + 1);
    for (int l = 0; l < h; ++l) {
        const double half_sine = std::sin(std::numbers::pi * l / (2.0 * h));
        const double mu = alpha * alpha + 4 * half_sine * half_sine;
        const double theta = 2 * std::asinh(std::sqrt(mu) / 2);
        ratio[l] = (std::exp(theta) + 1) * std::expm1(-2 * theta * extended_) /
                   ((1 + std::exp(-theta * (2 * (extended_ - width_) - 1))) * std::expm1(-2 * theta * width_));
    }
    for (int j = 0; j < 2 * h; ++j)
        cosine[j] = std::cos(std::numbers::pi * j / h);
    for (int j = 0; j <= h; ++j) {
        double sum = 0;
        for (int l = 1, angle = j; l < h; ++l, angle = (angle + j) % (2 * h))
            sum += ratio[l] * cosine[angle];
        t[j] = (ratio[0] + 2 * sum) / (2 * h);
    }
    for (int i = 0; i < 3 * h - 1; ++i) {
        const int j = std::abs(i - (2 * h - 1));
        kernel_[i] = t[std::min(j, 2 * h - j)];
    }
}

double BorderSource::jump_weight(int k) const {
    const double step = std::numbers::pi * k / (2.0 * extended_);
    const double difference = std::cos(step * (2 * width_ - 1)) - std::cos(step * (2 * width_ + 1));
    return (k == 0 ? 1 : 2) * difference / extended_;
}

double BorderSource::source_weight(int k) const {
    return std::cos(std::numbers::pi * k / (2.0 * extended_) * (2 * width_ + 1));
}

void BorderSource::solve(const double* jumps, float* sources, const ParallelFor& parallel_for) const {
    constexpr int chunk = 64;
    const int chunks = (height_ + chunk - 1) / chunk;
    parallel_for(3 * chunks, [&](int i) {
        const double* jump = jumps + i / chunks * height_;
        const int first = i % chunks * chunk;
        const int count = std::min(chunk, height_ - first);
        double sum[chunk] = {};
        for (int j = 0; j < 2 * height_; ++j) {
            const double value = jump[j < height_ ? j : 2 * height_ - 1 - j];
            const double* t = kernel_.data() + first - j + 2 * height_ - 1;
            for (int y = 0; y < count; ++y)
                sum[y] += value * t[y];
        }
        std::copy_n(sum, count, sources + i / chunks * height_ + first);
    });
}

int average_neighbours(const PoissonProblem& problem, int iterations, RgbImage& image,
                       const ParallelFor& parallel_for, const SolveWatch& watch) {
    constexpr float weight = 0.2f; // of each of four neighbours and the pixel itself
    const int width = problem.primal.width(), height = problem.primal.height();
    const PoissonProblem gradients{problem.primal, problem.dx, problem.dy, 0};
    image = problem.primal;
    RgbImage next(width, height);
    for (int i = 0; i < iterations; ++i) {
        if (!watch.goes_on(i, iterations))
            return 0;
        parallel_for(height, [&](int y) {
            poisson_defect(gradients, image, y, 0, width, &next.row(y)->x);
            for (int x = 0; x < width; ++x)
                next(x, y) = image(x, y) + weight * next(x, y);
        });
        std::swap(image, next);
    }
    return iterations;
}

} // namespace tessera
