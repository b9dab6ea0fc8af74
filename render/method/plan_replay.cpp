#include "render/method/plan_replay.h"

#include "render/method/pass.h"

namespace tessera {

ReusePlan replay_plan(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
                      int pass, glm::ivec2 pixel, std::stop_token stop) {
    ReusePlan plan(size, settings);
    if (!settings.adapt_tile || !has_tiles_to_cut(settings) || settings.tile == 1)
        return plan;
    const PixelRect seen = plan.evidence(TileGrid(size, settings, plan, pass).tile_at(pixel));
    Worker worker(scene, settings);
    for (int i = 0; i < pass && !stop.stop_requested(); ++i) {
        const Pass earlier(scene, camera, size, settings, plan, i); // no base path depends on the plan
        for (int y = seen.y0; y < seen.y1; ++y)
            for (int x = seen.x0; x < seen.x1; ++x) {
                trace_pixel(earlier, worker.tracer, x, y, worker.path);
                plan.learn(x, y, worker.reuse.shared_luminance(worker.path));
            }
    }
    return plan;
}

} // namespace tessera
