#include "app/experiment/speed_up.h"
#include "app/experiment/stability.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

#include <fmt/core.h>

namespace tessera {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
using Numbers = std::vector<double>;

double count_of(const Numbers& values) {
    return static_cast<double>(values.size());
}

/// Returns the significance of `excess` in standard deviations of a normal variable, by Student's t with
/// `freedom` degrees of freedom. With a standard error of 0, any positive excess is significant. With an unknown
/// one (only one piece), none is.
double significance(double excess, double error, double freedom) {
    if (!(excess > 0) || std::isnan(error))
        return 0;
    return error > 0 ? sigmas(student_tail(excess / error, freedom)) : sigmas(0);
}

constexpr double factor_level = 0.05; // probability that the interval misses the true factor

/// Accepted relative bias of the mean and of pieces. Unbiased reconstructions are allowed rounding errors; the
/// others are allowed the bias of a denoiser. Not tuned.
struct Tolerance {
    double energy, pieces;
};

Tolerance tolerance_of(const Setup& setup) {
    constexpr Tolerance linear{1e-4, 1e-4}, smoothing{0.02, 0.1};
    const bool is_linear = guarantee_of(setup.settings.reconstruction.norm).convergence == Convergence::unbiased;
    return is_linear ? linear : smoothing;
}

/// Estimates the mean squared bias of the pieces: the mean over pairs of different runs s, t of
/// (I_s - r1)(I_t - r2). All four images are independent, so noise drops out. The standard error is from the
/// differences between pieces.
Deviation squared_bias_of(const Result& result, const ReferenceNoise& reference, double tolerance) {
    const auto runs = static_cast<double>(result.runs.size());
    Numbers products;
    for (std::size_t piece = 0; piece < reference.pieces[0].size(); ++piece) {
        double sum1 = 0, sum2 = 0, own = 0;
        for (const Measurement& run : result.runs) {
            const double value = run.artefacts->pieces[piece];
            const double error1 = value - reference.pieces[0][piece], error2 = value - reference.pieces[1][piece];
            sum1 += error1;
            sum2 += error2;
            own += error1 * error2;
        }
        products.push_back((sum1 * sum2 - own) / (runs * (runs - 1)));
    }
    Deviation bias{mean_of(products), standard_error_of(products), 0};
    bias.sigmas = significance(bias.value - tolerance * tolerance, bias.error, count_of(products) - 1);
    return bias;
}

/// Measures the change of energy. It is significant only if it is so against the differences between seeds and
/// against the differences between pieces. Rare paths that all runs miss make seeds too similar; noise over many
/// pieces makes pieces too similar.
Deviation energy_of(const Result& result, const ReferenceNoise& reference, double tolerance) {
    const Numbers means = of_runs(result, [](const Measurement& m) { return m.artefacts->mean; });
    Numbers pieces;
    for (std::size_t piece = 0; piece < reference.pieces[0].size(); ++piece)
        pieces.push_back(
            mean_of(of_runs(result, [&](const Measurement& m) { return m.artefacts->pieces[piece]; })) -
            (reference.pieces[0][piece] + reference.pieces[1][piece]) / 2);
    Deviation energy{mean_of(means) - (reference.is_black ? 0 : 1),
                     std::hypot(standard_error_of(means), reference.mean_error), 0};
    const double of_seeds = significance(std::abs(energy.value) - tolerance, energy.error, count_of(means) - 1);
    const double of_pieces =
        significance(std::abs(mean_of(pieces)) - tolerance, standard_error_of(pieces), count_of(pieces) - 1);
    energy.sigmas = std::min(of_seeds, of_pieces);
    return energy;
}

void find_outliers(const Result& result, Findings& f) {
    Numbers worst;
    double squared_sum = 0;
    for (const Measurement& run : result.runs) {
        const Artefacts& a = *run.artefacts;
        worst.insert(worst.end(), a.worst.begin(), a.worst.end());
        if (!a.worst.empty() && std::sqrt(a.worst.front()) >= f.worst) {
            f.worst = std::sqrt(a.worst.front());
            f.worst_pixel = a.worst_pixel;
        }
        for (double error : a.worst)
            squared_sum += error;
    }
    std::sort(worst.begin(), worst.end(), std::greater<>());
    const glm::ivec2 size = result.setup.settings.size;
    const double pixels = static_cast<double>(size.x) * size.y * static_cast<double>(result.runs.size());
    const auto rank = static_cast<std::size_t>(1e-4 * pixels);
    f.spike = std::sqrt(worst[std::min(rank, worst.size() - 1)]);
    f.worst_fraction = f.error > 0 ? squared_sum / (f.error * pixels) : 0;
}

double cost_of_sample(const Result& result) {
    return cpu_seconds_of(result) / spp_of(result);
}

double cost_of(const Numbers& errors, const Numbers& seconds) {
    return mean_of(errors) * mean_of(seconds);
}

Numbers without(Numbers values, std::size_t i) {
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(i));
    return values;
}

/// Computes the factor and its interval. The standard error is of the factor's logarithm. It combines the
/// jackknife over seeds with the noise of the references, which all errors share.
void find_factor(const Result& result, const Result& pt, double reference_error, Findings& f) {
    const auto error = [](const Measurement& m) { return m.artefacts->error.relative_mse; };
    const auto seconds = [](const Measurement& m) { return m.cpu_seconds; };
    const Numbers e = of_runs(result, error), t = of_runs(result, seconds);
    const Numbers e_pt = of_runs(pt, error), t_pt = of_runs(pt, seconds);
    f.factor = f.low = f.high = none;
    if (e.size() != e_pt.size() || !(mean_of(e) > 2 * reference_error) || !(mean_of(e_pt) > 2 * reference_error))
        return;
    Numbers logs;
    for (std::size_t i = 0; i < e.size(); ++i)
        logs.push_back(
            std::log(cost_of(without(e, i), without(t, i)) / cost_of(without(e_pt, i), without(t_pt, i))));
    const double of_seeds = jackknife_error(logs);
    const double of_reference = reference_error * (1 / mean_of(e) - 1 / mean_of(e_pt));
    const double half_width = student_t(factor_level, count_of(logs) - 1) * std::hypot(of_seeds, of_reference);
    if (!std::isfinite(half_width))
        return;
    f.factor = cost_of(e, t) / cost_of(e_pt, t_pt);
    f.low = f.factor * std::exp(-half_width);
    f.high = f.factor * std::exp(half_width);
}

bool is_biased(const Findings& f, double level) {
    return std::max(f.energy.sigmas, f.squared_bias.sigmas) > sigmas(level);
}

/// Describes the part of the bias that is statistically significant.
std::string bias_text(const Findings& f, double level) {
    if (f.energy.sigmas > sigmas(level))
        return fmt::format("energy {} by {:.2g} % ({:.1f} sigma)", f.energy.value < 0 ? "lost" : "gained",
                           100 * std::abs(f.energy.value), f.energy.sigmas);
    return fmt::format("biased by {:.2g} % RMS ({:.1f} sigma)", 100 * std::sqrt(f.squared_bias.value),
                       f.squared_bias.sigmas);
}

/// Returns "only 31 % of the shifts succeed (main failure: kind_mismatch)"; empty if at least half succeed, or if
/// there are no shifts.
std::string shift_text(const Counters& counters) {
    const auto& shifts = counters.shifts;
    const auto all = static_cast<double>(counters.shift_attempts());
    const double arrived = static_cast<double>(shifts[static_cast<int>(ShiftOutcome::ok)]) / all;
    if (!(arrived < 0.5))
        return "";
    const auto main_failure =
        std::max_element(shifts.begin() + static_cast<int>(ShiftOutcome::ok) + 1, shifts.end());
    return fmt::format("; only {:.0f} % of the shifts succeed (main failure: {})", 100 * arrived,
                       to_string(static_cast<ShiftOutcome>(main_failure - shifts.begin())));
}

/// Splits the error at equal time into the error at equal samples and the cost of a sample.
std::string cause_of_worse(const Findings& f) {
    std::string text =
        fmt::format("{:.3g} times PT's error at equal time: {:.2g} times at equal samples, and a sample costs "
                    "{:.2g} times as much",
                    f.factor, f.factor / f.cost, f.cost);
    text += shift_text(f.counters);
    if (f.worst_fraction > 0.5)
        text += fmt::format("; {:.0f} % of the squared error is in the worst pixels", 100 * f.worst_fraction);
    return text;
}

} // namespace

Findings find(const Result& result, const Result& path_tracing, const ReferenceNoise& reference) {
    Findings f;
    Numbers errors, edges, tone_mapped, tenfold, halo_energies, halo_peaks;
    for (const Measurement& run : result.runs) {
        f.bad_pixels += run.artefacts->bad_pixels;
        f.refused += run.counters.invalid_samples;
        f.counters += run.counters;
        errors.push_back(run.artefacts->error.relative_mse);
        tone_mapped.push_back(run.artefacts->tone_mapped);
        tenfold.push_back(run.artefacts->tenfold);
        if (std::isfinite(run.artefacts->halo_peak)) {
            halo_energies.push_back(run.artefacts->halo_energy);
            halo_peaks.push_back(run.artefacts->halo_peak);
        }
        if (run.tiles)
            edges.push_back(run.tiles->edges);
    }
    const Tolerance tolerance = tolerance_of(result.setup);
    f.cost = cost_of_sample(result) / cost_of_sample(path_tracing);
    f.error = mean_of(errors);
    f.error_error = std::hypot(standard_error_of(errors), reference.squared_error_error);
    f.energy = energy_of(result, reference, tolerance.energy);
    f.squared_bias = squared_bias_of(result, reference, tolerance.pieces);
    find_outliers(result, f);
    f.tone_mapped = mean_of(tone_mapped);
    f.tenfold = mean_of(tenfold);
    f.halo_energy = halo_energies.empty() ? none : mean_of(halo_energies);
    f.halo_peak = halo_peaks.empty() ? none : mean_of(halo_peaks);
    f.tile_edges = edges.empty() ? none : mean_of(edges);
    f.tile_edges_error = edges.empty() ? none : standard_error_of(edges);
    find_factor(result, path_tracing, reference.squared_error_error, f);
    return f;
}

Verdict judge(const Findings& findings, const Findings& path_tracing, double level) {
    using Kind = Verdict::Kind;
    if (findings.bad_pixels > 0)
        return {Kind::fails, fmt::format("not finite: {} pixels", findings.bad_pixels)};
    const bool is_setup_biased = is_biased(findings, level);
    if (is_setup_biased && is_biased(path_tracing, level))
        return {Kind::undecided,
                fmt::format("{}, but PT is biased too, against its own reference: needs more samples",
                            bias_text(findings, level))};
    if (is_setup_biased)
        return {Kind::fails, bias_text(findings, level)};
    if (findings.low > 1)
        return {Kind::worse, cause_of_worse(findings)};
    return {};
}

std::string to_string(Verdict::Kind kind) {
    switch (kind) {
    case Verdict::Kind::ok:
        return "ok";
    case Verdict::Kind::worse:
        return "worse than PT";
    case Verdict::Kind::fails:
        return "fails";
    case Verdict::Kind::undecided:
        break;
    }
    return "undecided";
}

} // namespace tessera
