#include "recon/solvers/poisson_direct.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace tessera {

TridiagonalColumns::Block TridiagonalColumns::factor_block(const double* mu, int height) {
    Block block;
    std::array<double, column_block> c{}; // of the previous row
    const auto row = [&](int y) {
        // Number of differences to the rows above and below.
        const int neighbours = (y > 0) + (y < height - 1);
        std::array<double, column_block> next;
        for (int i = 0; i < column_block; ++i)
            next[i] = 1 / (mu[i] + neighbours - c[i]);
        return next;
    };
    for (bool changed = true; block.rows < height - 1 && changed; ++block.rows) {
        const auto next = row(block.rows);
        changed = false;
        for (int i = 0; i < column_block; ++i)
            changed = changed || static_cast<float>(next[i]) != static_cast<float>(c[i]);
        c = next;
        block.factors.insert(block.factors.end(), c.begin(), c.end());
    }
    const auto last = row(height - 1);
    block.last.assign(last.begin(), last.end());
    return block;
}

void TridiagonalColumns::factor(const std::vector<double>& mu) {
    blocks_.clear();
    for (std::size_t first = 0; first < mu.size(); first += column_block)
        blocks_.push_back(factor_block(mu.data() + first, height_));
}

void TridiagonalColumns::solve(int block_index, float* values) const {
    const Block& block = blocks_[block_index];
    const auto factors = [&](int y) {
        return y == height_ - 1 ? block.last.data()
                                : block.factors.data() + std::min(y, block.rows - 1) * column_block;
    };
    constexpr int chains = 3 * column_block / lanes; // independent recurrences, channel by channel
    const auto place = [&](int y, int chain) {
        const int channel = chain / 2;
        return values + (static_cast<std::size_t>(channel) * height_ + y) * column_block + chain % 2 * lanes;
    };
    Lanes previous[chains] = {};
    for (int y = 0; y < height_; ++y) {
        const float* c = factors(y);
        const Lanes c_halves[2] = {load(c), load(c + lanes)};
        for (int i = 0; i < chains; ++i) {
            previous[i] = c_halves[i % 2] * (load(place(y, i)) + previous[i]);
            store(place(y, i), previous[i]);
        }
    }
    for (int y = height_ - 2; y >= 0; --y) {
        const float* c = factors(y);
        const Lanes c_halves[2] = {load(c), load(c + lanes)};
        for (int i = 0; i < chains; ++i) {
            previous[i] = load(place(y, i)) + c_halves[i % 2] * previous[i];
            store(place(y, i), previous[i]);
        }
    }
}

namespace {

constexpr int group_rows = 2 * lanes; // rows of one transform
constexpr int chunk_pixels = 64;      // of a row, processed at a time: the chunks of a group stay in the L1 cache

using Chunk = float[group_rows][3 * chunk_pixels];

int checked_size(int size) {
    if (size < 1)
        throw std::invalid_argument("a Poisson problem needs at least one pixel");
    return size;
}

int refinements(float alpha) {
    return alpha >= 0.1f ? 0 : alpha >= 0.02f ? 1 : 2;
}

} // namespace

/// Scratch memory of a thread for a group of rows or a block of columns.
struct PoissonSolver::Scratch {
    Scratch(int size, std::size_t column_values) : columns(column_values) {
        // Arrays that begin at equal offsets within pages would evict each other from the cache.
        constexpr std::size_t stagger = 144;
        const std::size_t step = static_cast<std::size_t>(size) * lanes + stagger;
        memory.resize(8 * step);
        for (int i = 0; i < 3; ++i)
            channels[i] = {memory.data() + 2 * i * step, memory.data() + (2 * i + 1) * step};
        spare = {memory.data() + 6 * step, memory.data() + 7 * step};
    }

    std::vector<float> memory;
    ComplexLanes channels[3];
    ComplexLanes spare;
    Chunk chunk;
    std::vector<float> columns;
};

namespace {

/// Returns the first (real) or second (imaginary) half of a group of lines.
float* half_of(ComplexLanes lines, int half) {
    return half == 0 ? lines.re : lines.im;
}

/// Transposes rows of interleaved channels, `count` pixels from x = first on, to lines in lanes.
void chunk_to_lines(const Chunk& chunk, const LaneDct& dct, int first, int count,
                    const ComplexLanes (&channels)[3]) {
    for (int value = 0; value < 3 * count; value += lanes) {
        for (int half = 0; half < 2; ++half) {
            Lanes tile[lanes];
            for (int l = 0; l < lanes; ++l)
                tile[l] = load(&chunk[half * lanes + l][value]);
            transpose(tile);
            for (int i = value; i < std::min(value + lanes, 3 * count); ++i)
                store(half_of(channels[i % 3], half) + dct.slot(first + i / 3) * lanes, tile[i - value]);
        }
    }
}

/// The inverse of chunk_to_lines.
void lines_to_chunk(const ComplexLanes (&channels)[3], const LaneDct& dct, int first, int count, Chunk& chunk) {
    for (int value = 0; value < 3 * count; value += lanes) {
        for (int half = 0; half < 2; ++half) {
            Lanes tile[lanes] = {};
            for (int i = value; i < std::min(value + lanes, 3 * count); ++i)
                tile[i - value] = load(half_of(channels[i % 3], half) + dct.slot(first + i / 3) * lanes);
            transpose(tile);
            for (int l = 0; l < lanes; ++l)
                store(&chunk[half * lanes + l][value], tile[l]);
        }
    }
}

} // namespace

PoissonSolver::PoissonSolver(int width, int height)
    : width_(checked_size(width)), height_(checked_size(height)), dct_(next_smooth(width)), columns_(height),
      border_source_(width, dct_.size(), height) {}

PoissonSolver::~PoissonSolver() = default;

std::uint64_t PoissonSolver::bytes(int width, int height, int threads) {
    const int size = next_smooth(width);
    const std::uint64_t columns = (static_cast<std::uint64_t>(size) + column_block - 1) / column_block;
    const std::uint64_t block = std::uint64_t{3} * column_block * static_cast<std::uint64_t>(height); // values
    const std::uint64_t scratch =
        std::uint64_t{8} * lanes * static_cast<std::uint64_t>(size) + (size > width ? block : 0); // values
    return sizeof(float) * (columns * block + static_cast<std::uint64_t>(threads) * scratch);
}

void PoissonSolver::solve(const PoissonProblem& problem, RgbImage& image, const ParallelFor& parallel_for) {
    prepare(problem.alpha, image);
    const RowSource right_side = [&](int y, int begin, int end, float* out) {
        poisson_right_side(problem, y, begin, end, out);
    };
    const RowSource defect = [&](int y, int begin, int end, float* out) {
        poisson_defect(problem, image, y, begin, end, out);
    };
    solve_once(right_side, Target::image, image, parallel_for);
    for (int i = 0; i < refinements(problem.alpha); ++i)
        solve_once(defect, Target::correction, image, parallel_for);
}

void PoissonSolver::solve(const RgbImage& right_side, float alpha, RgbImage& image,
                          const ParallelFor& parallel_for) {
    prepare(alpha, image);
    const RowSource source = [&](int y, int begin, int end, float* out) {
        std::copy(&right_side(begin, y).x, &right_side(begin, y).x + 3 * (end - begin), out);
    };
    solve_once(source, Target::image, image, parallel_for);
}

void PoissonSolver::prepare(float alpha, RgbImage& image) {
    if (image.width() != width_ || image.height() != height_)
        image = RgbImage(width_, height_);
    if (alpha == alpha_)
        return;
    const double alpha_squared = static_cast<double>(alpha) * alpha;
    const int blocks = (dct_.size() + column_block - 1) / column_block;
    std::vector<double> mu(static_cast<std::size_t>(blocks) * column_block, 1.0);
    for (int k = 0; k < dct_.size(); ++k) {
        const double half_sine = std::sin(std::numbers::pi * k / (2.0 * dct_.size()));
        mu[k] = alpha_squared + 4 * half_sine * half_sine;
    }
    columns_.factor(mu);
    spectrum_.resize(blocks * block_size());
    if (dct_.size() > width_) {
        border_source_.prepare(alpha);
        jump_weights_.assign(mu.size(), 0);
        source_weights_.assign(mu.size(), 0);
        for (int k = 0; k < dct_.size(); ++k) {
            jump_weights_[k] = static_cast<float>(border_source_.jump_weight(k));
            source_weights_[k] = static_cast<float>(border_source_.source_weight(k));
        }
        block_jumps_.resize(std::size_t{3} * height_ * blocks);
        jumps_.resize(std::size_t{3} * height_);
        sources_.resize(std::size_t{3} * height_);
    }
    alpha_ = alpha;
}

template <class Body>
void PoissonSolver::for_each(int count, const ParallelFor& parallel_for, const Body& body) {
    parallel_for(count, [&](int i) {
        std::unique_ptr<Scratch> scratch;
        {
            const std::lock_guard lock(scratch_mutex_);
            if (!free_scratch_.empty()) {
                scratch = std::move(free_scratch_.back());
                free_scratch_.pop_back();
            }
        }
        if (!scratch)
            scratch = std::make_unique<Scratch>(dct_.size(), dct_.size() > width_ ? block_size() : 0);
        body(i, *scratch);
        const std::lock_guard lock(scratch_mutex_);
        free_scratch_.push_back(std::move(scratch));
    });
}

void PoissonSolver::solve_once(const RowSource& source, Target target, RgbImage& image,
                               const ParallelFor& parallel_for) {
    const int groups = (height_ + group_rows - 1) / group_rows;
    for_each(groups, parallel_for, [&](int i, Scratch& scratch) { rows_to_spectrum(source, i, scratch); });
    parallel_for(columns_.blocks(), [&](int i) { columns_.solve(i, spectrum_.data() + i * block_size()); });
    if (dct_.size() > width_)
        add_border_source(parallel_for);
    for_each(groups, parallel_for, [&](int i, Scratch& scratch) { spectrum_to_rows(i, target, image, scratch); });
}

void PoissonSolver::rows_to_spectrum(const RowSource& source, int group, Scratch& scratch) {
    const int first_row = group * group_rows;
    const int rows = std::min(group_rows, height_ - first_row);
    for (int x = 0; x < width_; x += chunk_pixels) {
        const int end = std::min(x + chunk_pixels, width_);
        for (int l = 0; l < rows; ++l)
            source(first_row + l, x, end, scratch.chunk[l]);
        for (int l = rows; l < group_rows; ++l)
            std::fill(std::begin(scratch.chunk[l]), std::end(scratch.chunk[l]), 0.0f);
        chunk_to_lines(scratch.chunk, dct_, x, end - x, scratch.channels);
    }
    for (int channel = 0; channel < 3; ++channel) {
        const ComplexLanes lines = scratch.channels[channel];
        for (int x = width_; x < dct_.size(); ++x) {
            store(lines.re + dct_.slot(x) * lanes, Lanes{});
            store(lines.im + dct_.slot(x) * lanes, Lanes{});
        }
        write_spectra(dct_.forward(lines, scratch.spare), channel, group);
    }
}

void PoissonSolver::write_spectra(ComplexLanes spectra, int channel, int group) {
    const int size = dct_.size(), padded_size = columns_.blocks() * column_block;
    for (int k = 0; k < padded_size; k += lanes) { // the padding is cleared, as solves may leave NaN there
        for (int half = 0; half < 2; ++half) {
            Lanes tile[lanes] = {};
            for (int i = 0; i < std::min(lanes, size - k); ++i)
                tile[i] = load(half_of(spectra, half) + (k + i) * lanes);
            transpose(tile);
            const int y = group * group_rows + half * lanes;
            for (int l = 0; l < std::min(lanes, height_ - y); ++l)
                store(&spectrum_[place(channel, y + l, k)], tile[l]);
        }
    }
}

void PoissonSolver::read_spectra(ComplexLanes spectra, int channel, int group) const {
    const int size = dct_.size();
    for (int k = 0; k < size; k += lanes) {
        for (int half = 0; half < 2; ++half) {
            Lanes tile[lanes] = {};
            const int y = group * group_rows + half * lanes;
            for (int l = 0; l < std::min(lanes, height_ - y); ++l)
                tile[l] = load(&spectrum_[place(channel, y + l, k)]);
            transpose(tile);
            for (int i = 0; i < std::min(lanes, size - k); ++i)
                store(half_of(spectra, half) + (k + i) * lanes, tile[i]);
        }
    }
}

void PoissonSolver::spectrum_to_rows(int group, Target target, RgbImage& image, Scratch& scratch) const {
    ComplexLanes results[3];
    ComplexLanes spare = scratch.spare;
    for (int channel = 0; channel < 3; ++channel) {
        read_spectra(scratch.channels[channel], channel, group);
        results[channel] = dct_.inverse(scratch.channels[channel], spare);
        if (results[channel].re == spare.re)
            spare = scratch.channels[channel];
    }
    const int first_row = group * group_rows;
    for (int x = 0; x < width_; x += chunk_pixels) {
        const int count = std::min(chunk_pixels, width_ - x);
        lines_to_chunk(results, dct_, x, count, scratch.chunk);
        for (int l = 0; l < std::min(group_rows, height_ - first_row); ++l) {
            float* out = &image(x, first_row + l).x;
            for (int i = 0; i < 3 * count; ++i)
                out[i] = target == Target::image ? scratch.chunk[l][i] : out[i] + scratch.chunk[l][i];
        }
    }
}

void PoissonSolver::add_border_source(const ParallelFor& parallel_for) {
    const int blocks = columns_.blocks();
    const std::size_t lines = std::size_t{3} * height_;
    parallel_for(blocks, [&](int i) { measure_jumps(i); });
    std::fill(jumps_.begin(), jumps_.end(), 0.0);
    for (int i = 0; i < blocks; ++i)
        for (std::size_t line = 0; line < lines; ++line)
            jumps_[line] += block_jumps_[i * lines + line];
    border_source_.solve(jumps_.data(), sources_.data(), parallel_for);
    for_each(blocks, parallel_for, [&](int i, Scratch& scratch) { add_sources(i, scratch.columns); });
}

void PoissonSolver::measure_jumps(int block_index) {
    const float* weights = jump_weights_.data() + block_index * column_block;
    const float* values = spectrum_.data() + block_index * block_size();
    const int lines = 3 * height_;
    for (int line = 0; line < lines; ++line) {
        Lanes parts = load(weights) * load(values + line * column_block);
        parts += load(weights + lanes) * load(values + line * column_block + lanes);
        float sum = 0;
        for (int i = 0; i < lanes; ++i)
            sum += parts[i];
        block_jumps_[static_cast<std::size_t>(block_index) * lines + line] = sum;
    }
}

void PoissonSolver::add_sources(int block_index, std::vector<float>& values) {
    const float* weights = source_weights_.data() + block_index * column_block;
    for (int line = 0; line < 3 * height_; ++line)
        for (int i = 0; i < column_block; ++i)
            values[line * column_block + i] = weights[i] * sources_[line];
    columns_.solve(block_index, values.data());
    float* sum = spectrum_.data() + block_index * block_size();
    for (std::size_t i = 0; i < values.size(); ++i)
        sum[i] += values[i];
}

} // namespace tessera
