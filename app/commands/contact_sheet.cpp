#include "app/cli/opened_scene.h"
#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "app/report/reports.h"
#include "recon/picture/reconstruct.h"
#include "render/io/plain_images.h"
#include "render/run/render.h"
#include "render/scene/scene.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/common.hpp>

namespace tessera {

namespace {

/// Maps a gradient to colours around middle grey, 0.2.
RgbImage around_grey(const RgbImage& gradient) {
    RgbImage image = gradient;
    for (Rgb& c : image)
        c = glm::clamp(Rgb(0.2f) + c, 0.0f, 1.0f);
    return image;
}

glm::ivec2 usual_size(glm::ivec2 scene) {
    const double pixels = static_cast<double>(scene.x) * scene.y;
    const double scale = std::min(1.0, std::sqrt(640.0 * 360.0 / pixels));
    return glm::max(glm::ivec2(glm::dvec2(scene) * scale + 0.5), 1);
}

Render render_for(const ContactSheetOptions& options, const OpenedScene& opened, Method method, ThreadPool& pool) {
    RenderSettings settings;
    settings.method = method;
    settings.max_depth = std::min(settings.max_depth, opened.scene->max_depth());
    const glm::ivec2 size =
        options.size.x > 0 ? opened.scene->size(options.size) : usual_size(opened.scene->size());
    Render render(opened.scene, opened.scene->camera(), size, settings);
    Progress progress{std::string(long_name(method))};
    do {
        render.pass(pool);
        progress.update(render.seconds() / options.seconds, render.seconds(), fmt::format("{} spp", render.spp()));
    } while (render.seconds() < options.seconds);
    return render;
}

std::string label(const Render& r, const char* what) {
    return fmt::format("{}, {}: {} spp, {:.1f} CPU s", long_name(r.settings().method), what, r.spp(),
                       r.cpu_seconds());
}

} // namespace

int run_contact_sheet(const ContactSheetOptions& options) {
    check_writable(options.output);
    ThreadPool pool(options.threads);
    const OpenedScene opened = open_scene(options.scene, pool);
    const Render pt = render_for(options, opened, Method::pt, pool);
    const Render gpr = render_for(options, opened, Method::gpr, pool);
    const GradientImages images = gpr.images();
    const std::vector<LabelledPicture> pictures = {
        {label(pt, "picture"), reconstruct(pt.images(), {}).image},
        {label(gpr, "reconstruction"), reconstruct(images, {}).image},
        {label(gpr, "primal"), images.radiance()},
        {label(gpr, "dx around grey"), around_grey(images.dx)},
    };
    write_png(options.output, picture_sheet(pictures, 2), 0);
    fmt::print("{}: path tracing and gradient-domain path reusing after equal wall time\n",
               options.output.string());
    return exit_ok;
}

} // namespace tessera
