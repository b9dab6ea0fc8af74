#include "recon/lane_dct.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace tessera {

namespace {

/// The real and imaginary parts of elements k and size - k of a buffer.
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
    // A[k] = conj(w) (X[k] - i X[size - k]), likewise B, and F = A + iB; A and B are those of real lines.
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
