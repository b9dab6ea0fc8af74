#include "recon/border_source.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera {

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

} // namespace tessera
