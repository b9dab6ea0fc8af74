// Rows of weighted normal equations, and the sums and steps of conjugate gradients, for solvers with a weight for
// each gradient.
#pragma once

#include "recon/image.h"
#include "recon/solvers/poisson_weighted.h"

#include <algorithm>
#include <array>
#include <vector>

namespace tessera {

inline constexpr int chunk_pixels = 64; // pixels processed at a time: their arrays stay in the L1 cache
inline constexpr int chunk_values = 3 * chunk_pixels;

/// One number for each channel.
using Channels = std::array<double, 3>;

inline const float* values(const RgbImage& image, int x, int y) {
    return &image(x, y).x;
}

inline float* values(RgbImage& image, int x, int y) {
    return &image(x, y).x;
}

/// Writes `count` weights three times each, once for each channel.
inline void spread(const float* weights, int count, float* out) {
    for (int i = 0; i < count; ++i)
        out[3 * i] = out[3 * i + 1] = out[3 * i + 2] = weights[i];
}

/// Writes row y of V + Dx^T w_x G_x + Dy^T w_y G_y to out. V, G_x and G_y are functions (x, y, count, to) that
/// write 3 values for each of `count` pixels from (x, y) on.
template <class V, class Gx, class Gy>
void write_row(const EdgeWeights& weights, int y, const V& v, const Gx& g_x, const Gy& g_y, float* out) {
    const int width = weights.x.width(), height = weights.x.height();
    float weight[chunk_values], flux[chunk_values];
    float to_right[3 + chunk_values] = {}; // flux from each pixel to the next; the first is into the chunk
    for (int x = 0; x < width; x += chunk_pixels) {
        const int count = std::min(chunk_pixels, width - x), right = std::min(count, width - 1 - x);
        float* sum = out + 3 * x;
        v(x, y, count, sum);
        g_x(x, y, right, to_right + 3);
        spread(weights.x.row(y) + x, right, weight);
        for (int i = 0; i < 3 * right; ++i)
            to_right[3 + i] *= weight[i];
        std::fill(to_right + 3 + 3 * right, to_right + 3 + 3 * count, 0.0f);
        for (int i = 0; i < 3 * count; ++i)
            sum[i] += to_right[i] - to_right[3 + i];
        std::copy_n(to_right + 3 * count, 3, to_right);
        if (y > 0) {
            g_y(x, y - 1, count, flux);
            spread(weights.y.row(y - 1) + x, count, weight);
            for (int i = 0; i < 3 * count; ++i)
                sum[i] += weight[i] * flux[i];
        }
        if (y + 1 < height) {
            g_y(x, y, count, flux);
            spread(weights.y.row(y) + x, count, weight);
            for (int i = 0; i < 3 * count; ++i)
                sum[i] -= weight[i] * flux[i];
        }
    }
}

inline constexpr int period = 24; // multiple of 3 channels and of the vector length

/// Returns the scalar products of `count` pixels, channel by channel.
inline Channels products(const float* a, const float* b, int count) {
    Channels sums{};
    for (int first = 0; first < 3 * count; first += chunk_values) {
        const int end = std::min(first + chunk_values, 3 * count);
        float partial[period] = {};
        int i = first;
        for (; i + period <= end; i += period)
            for (int j = 0; j < period; ++j)
                partial[j] += a[i + j] * b[i + j];
        for (int j = 0; i < end; ++i, ++j)
            partial[j] += a[i] * b[i];
        for (int j = 0; j < period; ++j)
            sums[j % 3] += partial[j];
    }
    return sums;
}

inline double total(const Channels& channels) {
    return channels[0] + channels[1] + channels[2];
}

inline Channels total(const std::vector<Channels>& rows) {
    Channels sum{};
    for (const Channels& row : rows)
        for (int c = 0; c < 3; ++c)
            sum[c] += row[c];
    return sum;
}

/// Returns G of write_row(): `gradient` minus the differences of `image`.
/// @param next  number of values from a pixel to its neighbour
inline auto misfits(const RgbImage& gradient, const RgbImage& image, int next) {
    return [&gradient, &image, next](int x, int row, int count, float* out) {
        const float *given = values(gradient, x, row), *own = values(image, x, row);
        for (int i = 0; i < 3 * count; ++i)
            out[i] = given[i] - (own[i + next] - own[i]);
    };
}

/// Returns G of write_row(): the differences of `image`.
inline auto differences(const RgbImage& image, int next) {
    return [&image, next](int x, int row, int count, float* out) {
        const float* own = values(image, x, row);
        for (int i = 0; i < 3 * count; ++i)
            out[i] = own[i + next] - own[i];
    };
}

/// The numbers of three channels, repeated for `period` values.
struct Factors {
    explicit Factors(const Channels& channels) {
        for (int i = 0; i < period; ++i)
            value[i] = static_cast<float>(channels[i % 3]);
    }

    float value[period];
};

/// Factors of the steps of conjugate gradients, channel by channel, in the form that needs all scalar products of
/// a step at once [Chronopoulos and Gear 1989]. A channel without residual has factors of 0.
class StepFactors {
public:
    /// Computes the factors of the next step from r z and w z, where w = A z.
    void take(const Channels& rz, const Channels& wz) {
        for (int c = 0; c < 3; ++c) {
            turn_[c] = step_[c] > 0 ? rz[c] / rz_[c] : 0;
            const double curvature = wz[c] - (step_[c] > 0 ? turn_[c] * rz[c] / step_[c] : 0);
            step_[c] = rz[c] > 0 && curvature > 0 ? rz[c] / curvature : 0;
        }
        rz_ = rz;
    }
    Factors turns() const { return Factors(turn_); }
    Factors steps() const { return Factors(step_); }

private:
    Channels rz_{}, turn_{}, step_{};
};

/// Takes the step in one row: p = z + turn p, s = w + turn s, c += step p, r -= step s, where w = A z and s = A p.
inline void take_step(const Factors& turn, const Factors& step, int count, const float* __restrict z,
                      const float* __restrict w, float* __restrict p, float* __restrict s,
                      float* __restrict correction, float* __restrict r) {
    const auto update = [&](int i, int j) {
        p[i] = z[i] + turn.value[j] * p[i];
        s[i] = w[i] + turn.value[j] * s[i];
        correction[i] += step.value[j] * p[i];
        r[i] -= step.value[j] * s[i];
    };
    int i = 0;
    for (; i + period <= 3 * count; i += period)
        for (int j = 0; j < period; ++j)
            update(i + j, j);
    for (int j = 0; i < 3 * count; ++i, ++j)
        update(i, j);
}

} // namespace tessera
