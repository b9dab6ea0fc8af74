// Areas of footprints of a scene's base paths: the scalar form, and the parallelogram of two vectors, over the
// sums of all differential vectors, by vertex; and what the latter take beside tracing the paths.
#include "render/estimator/base_path.h"
#include "render/inspect/path_differentials.h"
#include "render/load/mitsuba_xml.h"

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

#include <fmt/core.h>

namespace tessera {

namespace {

constexpr glm::ivec2 size(320, 180);
constexpr int most_vertices = 4;

double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double quantile(std::vector<float>& sorted, double share) {
    return double(sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))]);
}

void measure(const Scene& scene, double samples) {
    Counters counters;
    const Tracer tracer{scene, counters, {6, 1, 0}};
    const Projection projection(scene.camera(), size);
    std::vector<float> ratios[most_vertices], reduced[most_vertices];
    double tracing = 0, differentiating = 0;
    const DeltaRule rule{samples};
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const Random random(1, i, 0);
        const glm::vec2 pixel = random.draw_2d(0, Draw::direction) * glm::vec2(size);
        BasePath path;
        const double begin = cpu_seconds();
        trace_base_path(tracer, projection.ray(pixel), projection.pixel_width(), random, path);
        const double traced = cpu_seconds();
        const PathDifferentials d = differentiate(tracer, projection, pixel, glm::vec2(0), path);
        differentiating += cpu_seconds() - traced;
        tracing += traced - begin;
        for (int v = 0; v < std::min(most_vertices, static_cast<int>(d.vertices.size())); ++v)
            if (const float full =
                    area_of_sum(differential_vectors(d, v, rule), d.vertices[static_cast<std::size_t>(v)].normal);
                full > 0) {
                ratios[v].push_back(scalar_area(d, v, rule) / full);
                reduced[v].push_back(footprint(d, v, rule).area() / full);
            }
    }
    for (int v = 0; v < most_vertices; ++v) {
        std::sort(ratios[v].begin(), ratios[v].end());
        std::sort(reduced[v].begin(), reduced[v].end());
        if (!ratios[v].empty())
            fmt::print("x{}: {} paths, scalar / full: 10 % {:.2f}, median {:.2f}, 90 % {:.2f}; parallelogram / "
                       "full: median {:.2f}\n",
                       v + 1, ratios[v].size(), quantile(ratios[v], 0.1), quantile(ratios[v], 0.5),
                       quantile(ratios[v], 0.9), quantile(reduced[v], 0.5));
    }
    fmt::print("full differentials take {:.2f} of the paths' time\n", differentiating / tracing);
}

} // namespace

} // namespace tessera

int main(int count, char** arguments) {
    if (count < 2) {
        fmt::print("usage: footprint_bench SCENE.xml [SAMPLES]\n");
        return 2;
    }
    const tessera::Scene scene(tessera::load_mitsuba_xml(arguments[1]).description);
    tessera::measure(scene, count > 2 ? std::stod(arguments[2]) : 16);
}
