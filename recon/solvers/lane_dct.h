// Fourier and cosine transforms of many lines at a time.
#pragma once

#include "recon/lanes.h"

#include <vector>

namespace tessera {

/// `lanes` complex sequences in vector lanes: element n of sequence l is at [n * lanes + l], with separate arrays
/// of real and imaginary parts.
struct ComplexLanes {
    float* re;
    float* im;
};

/// Discrete Fourier transforms F[k] = sum_n f[n] exp(-2 pi i k n / size) of `lanes` sequences at a time, for sizes
/// without prime factors above 5.
///
/// The Stockham form of the mixed-radix FFT [Van Loan 1992, 1.7] reads and writes runs of contiguous elements and
/// needs no reordering. A batch of sequences only makes the runs longer, so that every loop vectorises.
class LaneFft {
public:
    explicit LaneFft(int size);

    int size() const { return size_; }

    /// Transforms `data`. Both arguments hold size() * lanes values and are overwritten. Returns the one that
    /// holds the result. With re and im of both exchanged, it is the inverse transform times size().
    ComplexLanes transform(ComplexLanes data, ComplexLanes scratch) const;

private:
    /// One stage: `groups` butterflies of `radix` points, each over a run of `run` contiguous values.
    struct Stage {
        int radix;
        int groups;
        int run;
        int first_twiddle; ///< index into twiddles_: (cos, sin) for each group and each output except the first
    };

    int size_;
    std::vector<Stage> stages_;
    std::vector<float> twiddles_;
};

/// Returns whether a size is a product of powers of 2, 3 and 5.
bool is_smooth(int size);

/// Returns the smallest product of powers of 2, 3 and 5 that is not below `size` (>= 1).
int next_smooth(int size);

/// Cosine transforms (DCT-II) X[k] = sum_x f[x] cos(pi k (2 x + 1) / (2 size)) of 2 * lanes real lines at a time,
/// for sizes without prime factors above 5: the lines of `re` and those of `im` of a ComplexLanes.
///
/// One complex FFT of the same size transforms two real lines [Makhoul 1980]. Let v hold the even elements of f
/// forwards and then the odd ones backwards, and V be its Fourier transform. Then X[k] = Re(w V[k]) and X[size -
/// k] = -Im(w V[k]), where w = exp(-i pi k / (2 size)).
class LaneDct {
public:
    explicit LaneDct(int size);

    int size() const { return fft_.size(); }

    /// Returns the index of element x of a line in a buffer of lines.
    int slot(int x) const { return x % 2 == 0 ? x / 2 : size() - 1 - x / 2; }

    /// Transforms lines (element x at slot(x)) to spectra (element k at k). Both buffers hold size() * lanes
    /// values in re and in im and are overwritten. Returns the one that holds the result.
    ComplexLanes forward(ComplexLanes lines, ComplexLanes scratch) const;

    /// Inverse of forward().
    ComplexLanes inverse(ComplexLanes spectra, ComplexLanes scratch) const;

private:
    LaneFft fft_;
    std::vector<float> cos_; ///< of pi k / (2 size), k <= size / 2
    std::vector<float> sin_;
};

} // namespace tessera
