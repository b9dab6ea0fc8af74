#include "app/reference_run.h"

#include "app/interrupt.h"
#include "app/progress.h"
#include "app/refused_samples.h"

#include <fmt/core.h>

namespace tessera {

std::optional<ReferenceImage> render_reference(const std::filesystem::path& output, const SceneSource& source,
                                               const std::shared_ptr<const Scene>& scene,
                                               const ReferenceRecipe& recipe, ThreadPool& pool) {
    ReferenceRender render(output, {source, scene, scene->camera()}, recipe, pool);
    const int resumed = render.spp_resumed();
    if (resumed > 0)
        fmt::print(stderr, "{}: going on from {} spp\n", reference_checkpoint(output).string(), resumed);
    {
        Progress progress("reference");
        const auto tell = [&](const ReferenceRender& r) {
            if (r.spp() > resumed)
                progress.update(static_cast<double>(r.spp() - resumed) / (recipe.spp - resumed), r.seconds(),
                                fmt::format("{} of {} spp", r.spp(), recipe.spp));
            return !interrupted();
        };
        if (!render.run(tell))
            return {};
        tell(render);
    }
    for (const Render& half : render.halves())
        warn_of_refused(source, half);
    return render.finish();
}

} // namespace tessera
