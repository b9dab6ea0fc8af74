#pragma once

#include "recon/lane_fft.h"

#include <vector>

namespace tessera {

/// Cosine transforms (DCT-II) X[k] = sum_x f[x] cos(pi k (2 x + 1) / (2 size)) of 2 * lanes real lines at a time,
/// for sizes without prime factors above 5: the lines of `re` and those of `im` of a ComplexLanes.
///
/// One complex FFT of the same size serves for two real lines [Makhoul 1980]: with v holding the even elements of
/// f forwards and then the odd ones backwards, and V its Fourier transform, X[k] = Re(w V[k]) and X[size - k] =
/// -Im(w V[k]), where w = exp(-i pi k / (2 size)).
class LaneDct {
public:
    explicit LaneDct(int size);

    int size() const { return fft_.size(); }

    /// Where element x of a line stands in a buffer of lines.
    int slot(int x) const { return x % 2 == 0 ? x / 2 : size() - 1 - x / 2; }

    /// From lines (element x at slot(x)) to their transforms (element k at k). Both buffers hold size() * lanes
    /// values in re and in im and are overwritten; the one that holds the result is returned.
    ComplexLanes forward(ComplexLanes lines, ComplexLanes scratch) const;

    /// The inverse of forward().
    ComplexLanes inverse(ComplexLanes spectra, ComplexLanes scratch) const;

private:
    LaneFft fft_;
    std::vector<float> cos_; ///< of pi k / (2 size), k <= size / 2
    std::vector<float> sin_;
};

} // namespace tessera
