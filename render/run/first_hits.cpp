#include "render/run/first_hits.h"

#include "render/inspect/path_differentials.h"
#include "render/paths/base_path.h"
#include "render/paths/tracer.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

constexpr int albedo_samples = 16;

/// Estimates the directional albedo: the mean of f cos / pdf of BSDF samples. Their random numbers are a
/// low-discrepancy sequence [Roberts 2018].
Rgb albedo_of(const Vertex& vertex) {
    Rgb sum(0);
    for (int i = 0; i < albedo_samples; ++i) {
        const float n = static_cast<float>(i) + 0.5f;
        const auto coordinate = [&](float step) { return std::fmod(n * step, 1.0f); };
        const auto sample = vertex.bsdf.sample(vertex.to_previous, n / albedo_samples,
                                               {coordinate(0.7548776662f), coordinate(0.5698402910f)});
        if (sample)
            sum += sample->f_cos / sample->pdf_w;
    }
    return sum / static_cast<float>(albedo_samples);
}

/// Stores the median footprints of five paths through the middle of pixel (x, y). A mean would follow the few
/// paths along surfaces, whose footprints are far wider.
void write_footprints(const Tracer& tracer, const Projection& projection, int x, int y, FirstHits& hits) {
    constexpr std::uint32_t paths = 5;
    const glm::vec2 pixel = glm::vec2(x, y) + 0.5f;
    const std::uint32_t index = pixel_number({x, y});
    std::array<std::array<float, paths>, 2> widths{};
    BasePath path;
    std::vector<Hit> found;
    Tracer recording = tracer;
    recording.hits = &found;
    Differentiation along;
    for (std::uint32_t k = 0; k < paths; ++k) {
        found.clear();
        trace_base_path(recording, projection.ray(pixel), projection.pixel_width(), Random(0, index, k), path);
        differentiate(tracer.scene, projection, pixel, glm::vec2(0), path, found, along,
                      [&](int i, const PathDerivatives& d) {
                          if (i < 2)
                              widths[i][k] = std::sqrt(footprint(d, {}).area());
                      });
    }
    for (auto& at_vertex : widths)
        std::ranges::nth_element(at_vertex, at_vertex.begin() + paths / 2);
    hits.footprint_1(x, y) = widths[0][paths / 2];
    hits.footprint_2(x, y) = widths[1][paths / 2];
}

} // namespace

FirstHits trace_first_hits(const Scene& scene, const Camera& camera, glm::ivec2 size, bool with_footprints,
                           std::stop_token stop) {
    FirstHits hits;
    hits.albedo = hits.normal = RgbImage(size.x, size.y, Rgb(0));
    hits.depth = Image<float>(size.x, size.y, 0);
    if (with_footprints)
        hits.footprint_1 = hits.footprint_2 = hits.depth;
    const Projection projection(camera, size);
    Counters counters;
    const Tracer tracer{
        scene, counters, {3, 0}}; // max_depth 3: paths keep the vertex after the last edge only if it emits
    for (int y = 0; y < size.y; ++y) {
        if (stop.stop_requested())
            return {};
        for (int x = 0; x < size.x; ++x) {
            const Ray from_camera = projection.ray(glm::vec2(x, y) + 0.5f), ray = tracer.visible_part(from_camera);
            Hit hit;
            if (!scene.intersector().closest(ray, hit))
                continue;
            Vertex vertex;
            make_vertex(scene, hit, ray, vertex);
            hits.albedo(x, y) = albedo_of(vertex);
            hits.normal(x, y) = vertex.frame.to_world({0, 0, 1});
            hits.depth(x, y) = glm::distance(from_camera.origin, ray.origin) + hit.distance;
            if (with_footprints)
                write_footprints(tracer, projection, x, y, hits);
        }
    }
    return hits;
}

float first_hit_distance(const Scene& scene, const Camera& camera, glm::vec2 place, glm::ivec2 size) {
    Hit hit;
    return scene.intersector().closest(camera.ray(place, size), hit) ? hit.distance : 0.0f;
}

} // namespace tessera
