#include "render/estimator/pre_pass.h"

#include "render/estimator/basis.h"

#include <cmath>

namespace tessera {

namespace {
constexpr int cells_along = 4; // of a pixel and of the lens, per dimension
}

int very_direct_views(const Pass& pass) {
    if (!pass.settings.edge_rays)
        return 0;
    return pass.has_lens() ? cells_along * cells_along : cells_along;
}

void show_very_direct(const Pass& pass, int view, PixelRect block, const Tracer& tracer, RgbImage& picture) {
    const PixelRect inside = block.clipped(pass.size);
    const PixelRect area{inside.x0 - (inside.x0 == 0), inside.y0 - (inside.y0 == 0),
                         inside.x1 + (inside.x1 == pass.size.x), inside.y1 + (inside.y1 == pass.size.y)};
    constexpr int n = cells_along;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            const int row = pass.has_lens() ? view / n : view; // all cells with a lens, else those of a diagonal
            const glm::vec2 cell((x + 1 + view) % n, (y + 1 + row) % n);
            const glm::vec2 in_cell = (cell + 0.5f) / static_cast<float>(n);
            const Ray ray = pass.camera_ray(x, y, {pass.filter().sample(in_cell).subpixel, sample_disk(in_cell)});
            picture(x + 1, y + 1) = tracer.very_direct_along(ray);
        }
}

void take_feature_samples(const Pass& pass, PixelRect block, Worker& worker, PixelFeatures& features) {
    for_each_square(block.clipped(pass.size), 1, [&](PixelRect p) {
        for (int more = features.wanted(p.x0, p.y0); more > 0; --more)
            if (!features.add(p.x0, p.y0,
                              pass.feature_sample(worker.tracer, p.x0, p.y0, features.count(p.x0, p.y0))))
                worker.counters.refuse({pass.index, p.y0, p.x0});
    });
}

void find_projections(const Pass& pass, PixelRect block, const Tracer& tracer, Film& film) {
    // All pixels have the same directions, so fewer are enough than in [Fang 2024, 4] (not tuned).
    constexpr int directions = 40;
    const PixelRect area = block.clipped(pass.size);
    const Basis basis = pass.settings.basis;
    Vertex seen;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) {
            float s[max_components] = {};
            for (int point = 0; point < projection_points; ++point)
                if (pass.first_vertex(tracer, x, y, point, seen))
                    project(seen, basis, directions, s);
            float squares = 0;
            for (float& number : s) {
                number /= projection_points; // points that see nothing scatter nothing
                squares += number * number;
            }
            // A pixel that sees nothing, or scatters nothing, can have any projections except all zeros.
            if (!std::isfinite(squares) || squares < 1e-6f)
                project_evenly(basis, s);
            film.set_projection(x, y, s);
        }
}

} // namespace tessera
