#include "recon/solvers/lane_dct.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace tessera {

namespace {

/// One complex number in each lane.
struct Complex {
    Lanes re;
    Lanes im;
};

inline Complex operator+(const Complex& a, const Complex& b) {
    return {a.re + b.re, a.im + b.im};
}
inline Complex operator-(const Complex& a, const Complex& b) {
    return {a.re - b.re, a.im - b.im};
}
inline Complex operator*(float s, const Complex& a) {
    return {s * a.re, s * a.im};
}
inline Complex times_minus_i(const Complex& a) {
    return {a.im, -a.re};
}
inline Complex times(float re, float im, const Complex& a) {
    return {re * a.re - im * a.im, re * a.im + im * a.re};
}

// Discrete Fourier transforms of 2, 3, 4 and 5 points, in place.

inline void butterfly(Complex (&a)[2]) {
    const Complex difference = a[0] - a[1];
    a[0] = a[0] + a[1];
    a[1] = difference;
}

inline void butterfly(Complex (&a)[3]) {
    constexpr float sin_60 = 0.866025403784438647f;
    const Complex sum = a[1] + a[2];
    const Complex turned = sin_60 * times_minus_i(a[1] - a[2]);
    const Complex middle = a[0] - 0.5f * sum;
    a[0] = a[0] + sum;
    a[1] = middle + turned;
    a[2] = middle - turned;
}

inline void butterfly(Complex (&a)[4]) {
    const Complex even_sum = a[0] + a[2];
    const Complex even_difference = a[0] - a[2];
    const Complex odd_sum = a[1] + a[3];
    const Complex odd_difference = times_minus_i(a[1] - a[3]);
    a[0] = even_sum + odd_sum;
    a[1] = even_difference + odd_difference;
    a[2] = even_sum - odd_sum;
    a[3] = even_difference - odd_difference;
}

inline void butterfly(Complex (&a)[5]) {
    constexpr float cos_72 = 0.309016994374947424f, sin_72 = 0.951056516295153572f;
    constexpr float cos_144 = -0.809016994374947424f, sin_144 = 0.587785252292473129f;
    const Complex outer_sum = a[1] + a[4];
    const Complex inner_sum = a[2] + a[3];
    const Complex outer_difference = times_minus_i(a[1] - a[4]);
    const Complex inner_difference = times_minus_i(a[2] - a[3]);
    const Complex even_1 = a[0] + cos_72 * outer_sum + cos_144 * inner_sum;
    const Complex even_2 = a[0] + cos_144 * outer_sum + cos_72 * inner_sum;
    const Complex odd_1 = sin_72 * outer_difference + sin_144 * inner_difference;
    const Complex odd_2 = sin_144 * outer_difference - sin_72 * inner_difference;
    a[0] = a[0] + outer_sum + inner_sum;
    a[1] = even_1 + odd_1;
    a[2] = even_2 + odd_2;
    a[3] = even_2 - odd_2;
    a[4] = even_1 - odd_1;
}

/// One butterfly over a run: inputs `in_step` apart, outputs `run` apart, output j times twiddle j.
template <int radix, bool twiddled>
void run_butterflies(const float* in_re, const float* in_im, float* out_re, float* out_im, int in_step, int run,
                     const float* twiddles) {
    for (int i = 0; i < run; i += lanes) {
        Complex a[radix];
        for (int j = 0; j < radix; ++j)
            a[j] = {load(in_re + i + j * in_step), load(in_im + i + j * in_step)};
        butterfly(a);
        if constexpr (twiddled)
            for (int j = 1; j < radix; ++j)
                a[j] = times(twiddles[2 * j - 2], twiddles[2 * j - 1], a[j]);
        for (int j = 0; j < radix; ++j) {
            store(out_re + i + j * run, a[j].re);
            store(out_im + i + j * run, a[j].im);
        }
    }
}

template <int radix>
void run_stage(ComplexLanes in, ComplexLanes out, int groups, int run, const float* twiddles) {
    // The twiddles of group 0 are 1.
    const int in_step = groups * run;
    run_butterflies<radix, false>(in.re, in.im, out.re, out.im, in_step, run, nullptr);
    for (int g = 1; g < groups; ++g) {
        const float* group_twiddles = twiddles + 2 * (radix - 1) * g;
        run_butterflies<radix, true>(in.re + g * run, in.im + g * run, out.re + g * radix * run,
                                     out.im + g * radix * run, in_step, run, group_twiddles);
    }
}

int strip_factor(int size, int factor) {
    while (size % factor == 0)
        size /= factor;
    return size;
}

} // namespace

LaneFft::LaneFft(int size) : size_(size) {
    int left = size;
    int run = lanes;
    for (const int radix : {4, 5, 3, 2}) {
        for (; left % radix == 0; left /= radix) {
            const int groups = left / radix;
            stages_.push_back({radix, groups, run, static_cast<int>(twiddles_.size())});
            for (int g = 0; g < groups; ++g) {
                for (int j = 1; j < radix; ++j) {
                    const double angle = -2 * std::numbers::pi * g * j / left;
                    twiddles_.push_back(static_cast<float>(std::cos(angle)));
                    twiddles_.push_back(static_cast<float>(std::sin(angle)));
                }
            }
            run *= radix;
        }
    }
}

ComplexLanes LaneFft::transform(ComplexLanes data, ComplexLanes scratch) const {
    for (const Stage& stage : stages_) {
        const float* twiddles = twiddles_.data() + stage.first_twiddle;
        switch (stage.radix) {
        case 2:
            run_stage<2>(data, scratch, stage.groups, stage.run, twiddles);
            break;
        case 3:
            run_stage<3>(data, scratch, stage.groups, stage.run, twiddles);
            break;
        case 4:
            run_stage<4>(data, scratch, stage.groups, stage.run, twiddles);
            break;
        default:
            run_stage<5>(data, scratch, stage.groups, stage.run, twiddles);
            break;
        }
        std::swap(data, scratch);
    }
    return data;
}

bool is_smooth(int size) {
    return strip_factor(strip_factor(strip_factor(size, 2), 3), 5) == 1;
}

int next_smooth(int size) {
    while (!is_smooth(size))
        ++size;
    return size;
}

namespace {

/// Offsets of elements k and size - k of a buffer.
struct MirrorPair {
    MirrorPair(ComplexLanes b, int k, int size) : low(k * lanes), high((size - k) * lanes), buffer(b) {}

    void put(const Lanes& low_re, const Lanes& low_im, const Lanes& high_re, const Lanes& high_im) const {
        store(buffer.re + low, low_re);
        store(buffer.im + low, low_im);
        store(buffer.re + high, high_re);
        store(buffer.im + high, high_im);
    }

    int low, high;
    ComplexLanes buffer;
};

} // namespace

LaneDct::LaneDct(int size) : fft_(size) {
    for (int k = 0; k <= size / 2; ++k) {
        const double angle = std::numbers::pi * k / (2.0 * size);
        cos_.push_back(static_cast<float>(std::cos(angle)));
        sin_.push_back(static_cast<float>(std::sin(angle)));
    }
}

ComplexLanes LaneDct::forward(ComplexLanes lines, ComplexLanes scratch) const {
    const ComplexLanes f = fft_.transform(lines, scratch);
    // F = A + iB, where A and B are the transforms of the two lines: A[k] = (F[k] + conj F[size - k]) / 2.
    for (int k = 1; k <= size() / 2; ++k) {
        const MirrorPair at(f, k, size());
        const Lanes low_re = load(f.re + at.low), low_im = load(f.im + at.low);
        const Lanes high_re = load(f.re + at.high), high_im = load(f.im + at.high);
        const Lanes a_re = low_re + high_re, a_im = low_im - high_im;
        const Lanes b_re = low_im + high_im, b_im = high_re - low_re;
        const float c = 0.5f * cos_[k], s = 0.5f * sin_[k];
        at.put(c * a_re + s * a_im, c * b_re + s * b_im, s * a_re - c * a_im, s * b_re - c * b_im);
    }
    return f;
}

ComplexLanes LaneDct::inverse(ComplexLanes spectra, ComplexLanes scratch) const {
    // A[k] = conj(w) (X[k] - i X[size - k]), B[k] in the same way, and F = A + iB; the lines of A and B are real.
    const float scale = 1 / static_cast<float>(size());
    store(spectra.re, scale * load(spectra.re));
    store(spectra.im, scale * load(spectra.im));
    for (int k = 1; k <= size() / 2; ++k) {
        const MirrorPair at(spectra, k, size());
        const Lanes a_low = load(spectra.re + at.low), a_high = load(spectra.re + at.high);
        const Lanes b_low = load(spectra.im + at.low), b_high = load(spectra.im + at.high);
        const float c = scale * cos_[k], s = scale * sin_[k];
        const Lanes a_re = c * a_low + s * a_high, a_im = s * a_low - c * a_high;
        const Lanes b_re = c * b_low + s * b_high, b_im = s * b_low - c * b_high;
        at.put(a_re - b_im, a_im + b_re, a_re + b_im, b_re - a_im);
    }
    const auto exchanged = [](ComplexLanes b) { return ComplexLanes{b.im, b.re}; };
    return exchanged(fft_.transform(exchanged(spectra), exchanged(scratch)));
}

} // namespace tessera
