// Cosine transforms of many lines at a time: their Fourier transform, and the cosine transform made of it.
#pragma once

#include "recon/lanes.h"

#include <vector>

namespace tessera {

/// `lanes` complex sequences side by side: element n of sequence l is at [n * lanes + l], real and imaginary parts
/// apart.
struct ComplexLanes {
    float* re;
    float* im;
};

/// Discrete Fourier transforms F[k] = sum_n f[n] exp(-2 pi i k n / size) of `lanes` sequences at a time, for sizes
/// without prime factors above 5.
///
/// The Stockham form of the mixed-radix FFT [Van Loan 1992, 1.7] reads and writes runs of contiguous elements and
/// needs no reordering. A batch of sequences is no more than a longer run, so every loop vectorises.
class LaneFft {
public:
    explicit LaneFft(int size);

    int size() const { return size_; }

    /// Transforms `data`; both arguments hold size() * lanes values and are overwritten. Returns the one of the
    /// two that holds the result. With re and im of both exchanged it is the inverse transform times size().
    ComplexLanes transform(ComplexLanes data, ComplexLanes scratch) const;

private:
    /// One stage: `groups` butterflies of `radix` points, each over a run of `run` contiguous values.
    struct Stage {
        int radix;
        int groups;
        int run;
        int first_twiddle; ///< into twiddles_: (cos, sin) for each group and each output but the first
    };

    int size_;
    std::vector<Stage> stages_;
    std::vector<float> twiddles_;
};

/// Whether a size is a product of 2, 3 and 5.
bool is_smooth(int size);

/// The smallest product of 2, 3 and 5 that is not below `size` (>= 1).
int next_smooth(int size);

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

    /// Takes lines (element x at slot(x)) to their transforms (element k at k). Both buffers hold size() * lanes
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
