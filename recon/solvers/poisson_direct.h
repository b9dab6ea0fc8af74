#pragma once

#include "recon/solvers/lane_dct.h"
#include "recon/solvers/poisson_problem.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace tessera {

/// Number of columns that are solved together.
inline constexpr int column_block = 2 * lanes;

/// Solves (mu_k + T) u = b for many columns k, each with its own mu_k > 0, where T is the second difference along
/// a column with free ends: (T u)(y) = sum over the neighbours y' of y of u(y) - u(y').
///
/// Thomas's algorithm: let c(0) = 1 / (mu + 1) and c(y) = 1 / (mu + 2 - c(y-1)), with 1 in place of 2 in the last
/// row. The forward sweep z(y) = c(y) (b(y) + z(y-1)) and the backward sweep u(y) = z(y) + c(y) u(y+1) give the
/// solution. c soon reaches a fixed point; only the rows before it are kept. c is computed in double, since the
/// small 1 - c distinguishes low frequencies.
class TridiagonalColumns {
public:
    /// @param height  number of rows, >= 1
    explicit TridiagonalColumns(int height) : height_(height) {}

    /// Prepares for one mu for each column; mu.size() is a multiple of column_block.
    void factor(const std::vector<double>& mu);

    int blocks() const { return static_cast<int>(blocks_.size()); }

    /// Solves columns [block * column_block, (block + 1) * column_block) of the three channels in place:
    /// values[(channel * height + y) * column_block + column].
    void solve(int block, float* values) const;

private:
    struct Block {
        std::vector<float> factors; ///< c(y) of the rows up to the fixed point, row by row
        std::vector<float> last;    ///< c of the last row
        int rows = 0;
    };

    static Block factor_block(const double* mu, int height);

    int height_;
    std::vector<Block> blocks_;
};

/// Solves screened Poisson problems of one size directly, reconstruction (33).
///
/// The matrix of the normal equations is A = alpha^2 + Dx^T Dx + Dy^T Dy. Dx^T Dx of a row is the second
/// difference with free ends. Its eigenvectors are the cosine waves c_k(x) = cos(pi k (2x + 1) / (2 width)), with
/// eigenvalues lambda_k = 4 sin^2(pi k / (2 width)). With I and b as matrices [y, x] and C the cosine transform
/// (DCT-II) of rows,
///     (alpha^2 + Dy^T Dy) I + I Dx^T Dx = b   becomes, for the columns u_k of I C and b_k of b C,
///     (alpha^2 + lambda_k + Dy^T Dy) u_k = b_k :
/// one tridiagonal system for each k. The solver transforms the rows, solves along the columns, and transforms
/// back. Vector lanes hold different rows during transforms, and different columns during solves.
///
/// Transforms need widths that are products of 2, 3 and 5. Any other width is solved on the next such width, with
/// a source that compensates for the additional columns (BorderSource).
///
/// Rounding errors of low frequencies are amplified by 1 / alpha^2. For small alpha the solution is refined once
/// or twice by solving for the defect, A u = b - A I.
class PoissonSolver {
public:
    /// @param width, height  >= 1
    PoissonSolver(int width, int height);
    ~PoissonSolver();

    /// Returns the bytes of a solver for images of that size, used by so many threads.
    static std::uint64_t bytes(int width, int height, int threads);

    int width() const { return width_; }
    int height() const { return height_; }

    /// Writes the solution to `image`, which is resized and must not be an image of the problem. The result has
    /// the same bits for any parallel_for. Allocates in the first call and when alpha changes. One call at a time.
    void solve(const PoissonProblem& problem, RgbImage& image, const ParallelFor& parallel_for = serial_for);

    /// Writes the solution for a given right side b, without refinement: for alpha >= 0.1.
    void solve(const RgbImage& right_side, float alpha, RgbImage& image,
               const ParallelFor& parallel_for = serial_for);

private:
    struct Scratch;
    enum class Target { image, correction };
    /// Writes pixels [begin, end) of row y of a right side to `out`, 3 values a pixel.
    using RowSource = std::function<void(int y, int begin, int end, float* out)>;

    void prepare(float alpha, RgbImage& image);
    void solve_once(const RowSource& source, Target target, RgbImage& image, const ParallelFor& parallel_for);
    void rows_to_spectrum(const RowSource& source, int group, Scratch& scratch);
    void write_spectra(ComplexLanes spectra, int channel, int group);
    void read_spectra(ComplexLanes spectra, int channel, int group) const;
    void spectrum_to_rows(int group, Target target, RgbImage& image, Scratch& scratch) const;
    void add_border_source(const ParallelFor& parallel_for);
    void measure_jumps(int block_index);
    void add_sources(int block_index, std::vector<float>& values);

    std::size_t block_size() const { return std::size_t{3} * column_block * height_; }
    std::size_t place(int channel, int y, int k) const {
        return k / column_block * block_size() + (std::size_t(channel) * height_ + y) * column_block +
               k % column_block;
    }

    /// Calls body(i, scratch) for i in [0, count).
    template <class Body>
    void for_each(int count, const ParallelFor& parallel_for, const Body& body);

    int width_;
    int height_;
    LaneDct dct_;
    TridiagonalColumns columns_;
    BorderSource border_source_; ///< used if the transform is longer than the image is wide
    float alpha_ = 0;            ///< alpha that columns_ and border_source_ are prepared for; 0: none

    std::vector<float> spectrum_;     ///< wave k of row y of a channel, at place(channel, y, k)
    std::vector<float> jump_weights_; ///< weights of BorderSource, for each k
    std::vector<float> source_weights_;
    std::vector<float> block_jumps_; ///< contribution of each block of columns to jumps_
    std::vector<double> jumps_;      ///< channel by channel, row by row, as sources_
    std::vector<float> sources_;

    std::mutex scratch_mutex_;
    std::vector<std::unique_ptr<Scratch>> free_scratch_; ///< one for each thread that worked at the same time
};

} // namespace tessera
