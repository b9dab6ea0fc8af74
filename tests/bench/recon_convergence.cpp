// recon_convergence BUFFERS.exr ONE.exr [CHART.svg]: measures the excess of a reconstruction's objective over its
// minimum, by the number of steps: inner solves of L1 and mixed, conjugate gradient steps of weighted.
//
// BUFFERS is a render of n samples per pixel with its buffers, ONE the same with one sample and another seed. Cold
// starts solve BUFFERS. Warm starts solve BUFFERS first, and continue with the n + 1 samples of both.

#include "app/commands/commands.h"
#include "recon/solvers/edge_weights.h"
#include "recon/solvers/poisson_l1.h"
#include "recon/solvers/poisson_weighted.h"
#include "ui/charts/chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace {

using namespace tessera;

constexpr float alpha = 0.2f;

double length(Rgb c) {
    return glm::length(glm::dvec3(c));
}

/// Returns the sum of term(misfit, weight) over all gradients, and of primal_term(misfit) over all pixels. Without
/// `weights`, all weights are 1.
template <class Term, class PrimalTerm>
double objective(const GradientImages& g, const RgbImage& image, const EdgeWeights* weights, const Term& term,
                 const PrimalTerm& primal_term) {
    double sum = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const Rgb value = image(x, y);
            sum += primal_term(length(value - g.primal(x, y)));
            if (x + 1 < image.width())
                sum += term(length(image(x + 1, y) - value - g.dx(x, y)), weights ? weights->x(x, y) : 1);
            if (y + 1 < image.height())
                sum += term(length(image(x, y + 1) - value - g.dy(x, y)), weights ? weights->y(x, y) : 1);
        }
    return sum;
}

/// Returns the means over n + 1 samples, from those over n samples and one more.
GradientImages with_one_more(GradientImages images, const GradientImages& one, float samples) {
    for (const auto image : {&GradientImages::primal, &GradientImages::dx, &GradientImages::dy})
        for (std::size_t i = 0; i < images.primal.size(); ++i)
            (images.*image).data()[i] =
                (samples * (images.*image).data()[i] + (one.*image).data()[i]) / (samples + 1);
    return images;
}

/// A reconstruction with a norm: L1 or mixed here, weighted in the derived class.
class Case {
public:
    Case(const char* name, bool square_primal) : name_(name), square_primal_(square_primal) {}
    virtual ~Case() = default;

    const char* name() const { return name_; }

    virtual double objective_of(const GradientImages& g, const RgbImage& image) const {
        const double typical = typical_value(g.primal);
        return objective(
            g, image, nullptr, [](double misfit, double) { return misfit; },
            [&](double misfit) {
                return square_primal_ ? alpha * alpha * misfit * misfit / typical : alpha * misfit;
            });
    }

    /// Returns the image after `cold` steps on g, and then `warm` ones on `newer` if it is not null.
    virtual RgbImage solve(const GradientImages& g, int cold, const GradientImages* newer, int warm) const {
        L1Solver solver(g.primal.width(), g.primal.height());
        const L1Settings settings{
            .square_primal = square_primal_, .cold_iterations = cold, .warm_iterations = warm};
        RgbImage image;
        solver.solve({g.primal, g.dx, g.dy, alpha}, settings, image);
        if (newer)
            solver.solve({newer->primal, newer->dx, newer->dy, alpha}, settings, image);
        return image;
    }

    virtual int default_cold_steps() const { return L1Settings{}.cold_iterations; }
    virtual int converged_steps() const { return 1500; } ///< not tuned

private:
    const char* name_;
    bool square_primal_;
};

/// L2 with a weight for each gradient, as Norm::weighted.
class WeightedCase : public Case {
public:
    WeightedCase() : Case("weighted", true) {}

    double objective_of(const GradientImages& g, const RgbImage& image) const override {
        const float a = weighted_alpha(alpha, g.patch);
        const EdgeWeights weights = weights_of_gradients(g, a);
        return objective(
            g, image, &weights, [](double misfit, double weight) { return weight * misfit * misfit; },
            [a](double misfit) { return double(a * a) * misfit * misfit; });
    }

    RgbImage solve(const GradientImages& g, int cold, const GradientImages* newer, int warm) const override {
        WeightedSolver solver(g.primal.width(), g.primal.height());
        const WeightedSettings settings{.cold_iterations = cold, .warm_iterations = warm};
        RgbImage image;
        const float a = weighted_alpha(alpha, g.patch);
        solver.solve({g.primal, g.dx, g.dy, a}, weights_of_gradients(g, a), settings, image);
        if (newer)
            solver.solve({newer->primal, newer->dx, newer->dy, a}, weights_of_gradients(*newer, a), settings,
                         image);
        return image;
    }

    int default_cold_steps() const override { return WeightedSettings{}.cold_iterations; }
    int converged_steps() const override { return 150; }
};

ChartSeries measure(const Case& c, const char* start, const GradientImages& g, const GradientImages* newer,
                    std::initializer_list<int> solves) {
    const GradientImages& data = newer ? *newer : g;
    const double minimum = c.objective_of(data, c.solve(data, c.converged_steps(), nullptr, 1));
    ChartSeries series{std::string(c.name()) + ", " + start, {}};
    for (const int n : solves) {
        const RgbImage image = newer ? c.solve(g, c.default_cold_steps(), newer, n) : c.solve(g, n, nullptr, 1);
        const double excess = c.objective_of(data, image) / minimum - 1;
        std::printf("%-18s %3d steps: %8.3f %% above the minimum\n", series.label.c_str(), n, 100 * excess);
        series.points.push_back({static_cast<double>(n), 100 * excess});
    }
    return series;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3)
        return std::fputs("recon_convergence BUFFERS.exr ONE.exr [CHART.svg]\n", stderr), EXIT_FAILURE;
    try {
        const GradientInput input = read_gradients({argv[1]}, false), one = read_gradients({argv[2]}, false);
        const auto settings = nlohmann::json::parse(input.attributes.at("tessera:settings"));
        const GradientImages newer = with_one_more(input.images, one.images, settings.at("spp").get<float>());
        ChartPlot plot;
        plot.x_label = "steps";
        plot.y_label = "objective above the minimum, %";
        const Case l1("L1", false), mixed("mixed", true);
        const WeightedCase weighted;
        for (const Case* c : {&l1, &mixed, static_cast<const Case*>(&weighted)}) {
            plot.series.push_back(
                measure(*c, "cold", input.images, nullptr, {2, 4, 6, 8, 10, 15, 20, 25, 30, 40}));
            plot.series.push_back(measure(*c, "warm", input.images, &newer, {1, 2, 3, 4, 5, 7, 10}));
        }
        if (argc > 3)
            std::ofstream(argv[3]) << to_svg({"Convergence of reconstructions", {plot}});
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "recon_convergence: %s\n", error.what()), EXIT_FAILURE;
    }
}
