// guiding_bench SCENE.xml [METHOD [SEEDS [SPP [auto]]]]: measures the effect of path guiding on noise and cost.
//
// Renders 320x180 pixels without and with guiding in turn, seed by seed. For 8, 32, ... samples per pixel up to
// SPP it prints CPU seconds, and the mean over the pixels of the primal's relative variance across seeds. It also
// prints the ratio of variance x CPU time without and with guiding, of all pixels and without the worst 0.1 %. The
// last figure is the fraction of the second moment that guiding leaves, as the learning passes estimate it
// (theory (23)). "auto" measures --path-guiding auto instead of on.
#include "render/load/mitsuba_xml.h"
#include "render/run/render.h"
#include "render/run/thread_pool.h"
#include "render/scene/scene.h"
#include "render/settings/settings_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/core.h>

namespace tessera {

namespace {

constexpr glm::ivec2 size(320, 180);

struct Measured {
    std::vector<RgbImage> pictures;     ///< one per seed
    double cpu_seconds = 0;             ///< of all seeds
    double remaining_second_moment = 0; ///< PathGuiding::remaining_second_moment(), summed over the seeds
};
using ByGuiding = std::array<Measured, 2>; ///< off, on

double value(const RgbImage& picture, int pixel) {
    return double(luminance(picture.data()[pixel]));
}

/// Returns each pixel's squared mean over all pictures, plus 0.02 of the image's squared mean for dark pixels.
std::vector<double> squared_means(const ByGuiding& all) {
    std::vector<double> means(std::size_t(size.x * size.y));
    for (const Measured& m : all)
        for (const RgbImage& picture : m.pictures)
            for (std::size_t i = 0; i < means.size(); ++i)
                means[i] += value(picture, int(i)) / double(2 * m.pictures.size());
    const double mean = std::accumulate(means.begin(), means.end(), 0.0) / double(means.size());
    for (double& m : means)
        m = m * m + 0.02 * mean * mean;
    return means;
}

/// Returns the mean relative variance of all pixels, and that of all but the worst 0.1 %.
std::array<double, 2> variance(const Measured& m, const std::vector<double>& squared) {
    std::vector<double> pixels;
    const double n = double(m.pictures.size());
    for (std::size_t i = 0; i < squared.size(); ++i) {
        double sum = 0, squares = 0;
        for (const RgbImage& picture : m.pictures) {
            sum += value(picture, int(i));
            squares += value(picture, int(i)) * value(picture, int(i));
        }
        pixels.push_back(std::max(squares - sum * sum / n, 0.0) / (n - 1) / squared[i]);
    }
    std::ranges::sort(pixels);
    const auto mean_of = [&](std::size_t count) {
        return std::accumulate(pixels.begin(), pixels.begin() + std::ptrdiff_t(count), 0.0) / double(count);
    };
    return {mean_of(pixels.size()), mean_of(pixels.size() - pixels.size() / 1000)};
}

/// @param settings  `path_guiding` is the mode to compare with `off`
void measure(const std::shared_ptr<const Scene>& scene, RenderSettings settings, int seeds, int spp) {
    const Guiding guided = settings.path_guiding;
    std::map<int, ByGuiding> found; // by samples a pixel
    ThreadPool pool(1);
    double first_left = 0; // estimated by the first pass
    for (int i = 0; i < 2 * seeds; ++i) {
        settings.path_guiding = i % 2 == 1 ? guided : Guiding::off;
        settings.seed = std::uint64_t(i / 2);
        Render render(scene, scene->camera(), size, settings);
        const auto left = [&] {
            const PathGuiding* of_last_pass = render.newest_learned()->guiding();
            return of_last_pass ? of_last_pass->remaining_second_moment() : 1.0;
        };
        render.pass(pool);
        render.pass(pool); // the first pass that can be guided; the pass before it has learnt the guides
        if (i % 2 == 1)
            first_left += left() / seeds;
        for (int samples = 8; samples <= spp; samples *= 4) {
            while (render.spp() < samples)
                render.pass(pool);
            Measured& m = found[samples][std::size_t(i % 2)];
            m.pictures.push_back(render.images().primal);
            m.cpu_seconds += render.cpu_seconds();
            m.remaining_second_moment += left();
        }
    }
    fmt::print("second moment that guiding leaves, estimated by the first pass: {:.2f}\n", first_left);
    const std::vector<double> squared = squared_means(found.rbegin()->second);
    for (const auto& [samples, by] : found) {
        const auto off = variance(by[0], squared), on = variance(by[1], squared);
        const double cost = by[1].cpu_seconds / by[0].cpu_seconds;
        fmt::print("{:4} spp: CPU {:.2f} s, x{:.2f} guided; variance {:.4f} -> {:.4f}; gain in variance x time "
                   "{:.2f}, without the worst pixels {:.2f}; second moment left {:.2f}\n",
                   samples, by[0].cpu_seconds / seeds, cost, off[0], on[0], off[0] / (on[0] * cost),
                   off[1] / (on[1] * cost), by[1].remaining_second_moment / seeds);
    }
}

} // namespace

} // namespace tessera

int main(int count, char** arguments) {
    if (count < 2) {
        fmt::print("usage: guiding_bench SCENE.xml [METHOD [SEEDS [SPP [auto]]]]\n");
        return 2;
    }
    tessera::RenderSettings settings;
    tessera::method_setting(settings.method).set_text(count > 2 ? arguments[2] : "pt");
    settings.path_guiding =
        count > 5 && std::string(arguments[5]) == "auto" ? tessera::Guiding::automatic : tessera::Guiding::on;
    const auto scene = std::make_shared<const tessera::Scene>(tessera::load_mitsuba_xml(arguments[1]).description);
    tessera::measure(scene, settings, count > 3 ? std::stoi(arguments[3]) : 3,
                     count > 4 ? std::stoi(arguments[4]) : 128);
}
