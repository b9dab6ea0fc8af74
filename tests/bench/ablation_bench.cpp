// ablation_bench CELLS [VARIANT...]: measures what the stages and constants of `guided` gain
// (docs/reconstruction.md, "Ablation").
//
// Each line of the file CELLS names a cell: NAME SAMPLES REFERENCE1 REFERENCE2. store_samples writes these files.
// The samples and the two references need three different seeds. A variant is
// PARAMETER=VALUE[,PARAMETER=VALUE...]. `all` switches each stage off, and halves and doubles each constant;
// numbers of levels grow by 1 instead.
//
// Prints the errors of each cell with the default parameters. For each variant it prints geometric means over the
// cells of the ratios to these errors: relMSE, relMSE without the worst 0.1 % of the pixels, and FLIP. The mean
// change of PSNR (dB) and the cell with the largest ratio follow.

#include "recon/metrics/metrics.h"
#include "recon/metrics/seen_error.h"
#include "recon/picture/reconstruct.h"
#include "render/run/thread_pool.h"
#include "tests/bench/stored_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/core.h>

namespace {

using namespace tessera;

using Value = std::variant<bool*, int*, float*, std::size_t*>;
using Parameters = std::vector<std::pair<std::string, Value>>;

Parameters parameters_of(GuidedParameters& p) {
    GuidedStages& s = p.stages;
    return {{"fireflies", &s.fireflies},
            {"edge_weights", &s.edge_weights},
            {"covariance", &s.covariance},
            {"redistribution", &s.redistribution},
            {"filter", &s.filter},
            {"regression", &s.regression},
            {"bounds", &s.bounds},
            {"firefly_fraction", &p.firefly_fraction},
            {"firefly_factor", &p.firefly_factor},
            {"firefly_own", &p.firefly_own},
            {"dark", &p.dark},
            {"local_radius", &p.local_radius},
            {"edge_noise", &p.edge_noise},
            {"alpha_scale", &p.alpha_scale},
            {"gradient_radius", &p.gradient_radius},
            {"primal_radius", &p.primal_radius},
            {"slope_prior", &p.slope_prior},
            {"feature_width", &p.feature_width},
            {"roughness_width", &p.roughness_width},
            {"least_albedo", &p.least_albedo},
            {"most_added", &p.largest_addition},
            {"around_radius", &p.around_radius},
            {"near_levels", &p.near_levels},
            {"least_local", &p.least_local},
            {"levels", &p.levels},
            {"noise_radius", &p.noise_radius},
            {"square_width", &p.square_width},
            {"ridge", &p.ridge},
            {"bound_reach", &p.bound_reach},
            {"bound_levels", &p.bound_levels},
            {"bound_lit", &p.bound_lit}};
}

struct References {
    RgbImage one, other, mean;
};

struct Cell {
    std::string name;
    GradientImages images;
    const References* references;
};

struct Errors {
    double relative_mse, trimmed, flip, psnr;
    double energy, dark_energy; ///< relative change of the mean luminance: all pixels, and the darkest quarter
};

RgbImage linear_picture(const std::string& file) {
    return reconstruct(read_samples(file), {.norm = Norm::l2}).image;
}

std::vector<Cell> read_cells(const std::string& path, std::map<std::string, References>& references) {
    std::vector<Cell> cells;
    std::ifstream list(path);
    for (std::string name, samples, one, other; list >> name >> samples >> one >> other;) {
        References& r = references[one];
        if (r.one.empty()) {
            r = {linear_picture(one), linear_picture(other), {}};
            r.mean = r.one;
            for (std::size_t i = 0; i < r.mean.size(); ++i)
                r.mean.data()[i] = 0.5f * (r.one.data()[i] + r.other.data()[i]);
        }
        cells.push_back({name, read_samples(samples), &r});
    }
    if (cells.empty())
        throw std::runtime_error(path + ": no cells");
    return cells;
}

double mean_of(const std::vector<double>& values, std::size_t count) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i)
        sum += values[i];
    return sum / static_cast<double>(count);
}

double mean_luminance(const RgbImage& image) {
    double sum = 0;
    for (Rgb c : image)
        sum += static_cast<double>(luminance(c));
    return sum / static_cast<double>(image.size());
}

Errors errors_of(const Cell& cell, const GuidedParameters& parameters) {
    Reconstructor reconstructor;
    reconstructor.set_parameters(parameters);
    const RgbImage image = reconstructor.reconstruct(cell.images, {}).image;
    const auto& [one, other, mean] = *cell.references;
    const Image<double> map = floor_free_errors(image, one, other);
    std::vector<double> values(map.begin(), map.end());
    std::ranges::sort(values);
    return {mean_of(values, values.size()),
            mean_of(values, values.size() - values.size() / 1000),
            mean_flip(image, mean),
            psnr(image, one, other),
            mean_luminance(image) / mean_luminance(mean) - 1,
            measure_energy_change(image, one, other)[0]};
}

void set(const Parameters& parameters, const std::string& assignment) {
    const std::size_t equal = assignment.find('=');
    const std::string name = assignment.substr(0, equal);
    const auto found = std::ranges::find(parameters, name, &Parameters::value_type::first);
    if (found == parameters.end() || equal == std::string::npos)
        throw std::invalid_argument(assignment + ": not PARAMETER=VALUE");
    const double value = std::stod(assignment.substr(equal + 1));
    std::visit([&](auto* p) { *p = static_cast<std::remove_pointer_t<decltype(p)>>(value); }, found->second);
}

std::vector<std::string> all_variants() {
    GuidedParameters defaults;
    std::vector<std::string> variants;
    for (const auto& [name, value] : parameters_of(defaults)) {
        if (std::holds_alternative<bool*>(value)) {
            variants.push_back(name + "=0");
            continue;
        }
        const double number = std::visit([](auto* p) { return static_cast<double>(*p); }, value);
        const bool is_whole = !std::holds_alternative<float*>(value);
        const bool is_level = std::holds_alternative<std::size_t*>(value);
        variants.push_back(fmt::format("{}={}", name, is_whole ? std::floor(number / 2) : number / 2));
        variants.push_back(fmt::format("{}={}", name, is_level ? number + 1 : 2 * number));
    }
    return variants;
}

class Ablation {
public:
    Ablation(std::vector<Cell> cells, ThreadPool& pool) : cells_(std::move(cells)), pool_(pool) {
        base_ = errors_with({});
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const Errors& e = base_[i];
            fmt::print("{:<24} relMSE {:.5f} trimmed {:.5f} FLIP {:.4f} PSNR {:.2f} energy {:+.4f} dark {:+.3f}\n",
                       cells_[i].name, e.relative_mse, e.trimmed, e.flip, e.psnr, e.energy, e.dark_energy);
        }
    }

    void print(const std::string& variant) {
        GuidedParameters parameters;
        const Parameters table = parameters_of(parameters);
        std::istringstream words(variant);
        for (std::string word; std::getline(words, word, ',');)
            set(table, word);
        const std::vector<Errors> errors = errors_with(parameters);
        double relative = 0, trimmed = 0, flip = 0, psnr = 0, worst = 0;
        std::string worst_name;
        const auto n = static_cast<double>(cells_.size());
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const double t = errors[i].trimmed / base_[i].trimmed, f = errors[i].flip / base_[i].flip;
            relative += std::log(errors[i].relative_mse / base_[i].relative_mse) / n;
            trimmed += std::log(t) / n;
            flip += std::log(f) / n;
            psnr += (errors[i].psnr - base_[i].psnr) / n;
            if (std::max(t, f) > worst)
                worst = std::max(t, f), worst_name = cells_[i].name;
        }
        fmt::print("{:<32} relMSE {:.3f} trimmed {:.3f} FLIP {:.3f} PSNR {:+.2f} worst {:.2f} ({})\n", variant,
                   std::exp(relative), std::exp(trimmed), std::exp(flip), psnr, worst, worst_name);
        std::fflush(stdout);
    }

private:
    std::vector<Errors> errors_with(const GuidedParameters& parameters) {
        std::vector<Errors> errors(cells_.size());
        pool_.parallel_for(static_cast<int>(cells_.size()),
                           [&](int i, int) { errors[i] = errors_of(cells_[i], parameters); });
        return errors;
    }

    std::vector<Cell> cells_;
    ThreadPool& pool_;
    std::vector<Errors> base_;
};

void run(int argc, char** argv) {
    ThreadPool pool(0);
    std::map<std::string, References> references;
    Ablation ablation(read_cells(argv[1], references), pool);
    for (int i = 2; i < argc; ++i)
        for (const std::string& variant :
             argv[i] == std::string("all") ? all_variants() : std::vector<std::string>{argv[i]})
            ablation.print(variant);
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2)
        return std::fputs("ablation_bench CELLS [VARIANT...]\n", stderr), EXIT_FAILURE;
    try {
        run(argc, argv);
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "ablation_bench: %s\n", error.what()), EXIT_FAILURE;
    }
}
