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
    /// One pass: `groups` butterflies of `radix` points, each over a run of `run` contiguous values.
    struct Pass {
        int radix;
        int groups;
        int run;
        int first_twiddle; ///< into twiddles_: (cos, sin) for each group and each output but the first
    };

    int size_;
    std::vector<Pass> passes_;
    std::vector<float> twiddles_;
};

/// Whether a size is a product of 2, 3 and 5.
bool is_smooth(int size);

/// The smallest product of 2, 3 and 5 that is not below `size` (>= 1).
int next_smooth(int size);

} // namespace tessera
