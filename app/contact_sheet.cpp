#include "app/contact_sheet.h"

#include "app/exit_codes.h"
#include "app/output_file.h"
#include "app/progress.h"
#include "recon/reconstruct.h"
#include "render/load/png.h"
#include "render/session/render.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/core.h>
#include <stb_easy_font.h>

namespace tessera {

namespace {

constexpr int label_height = 18;

struct Picture {
    std::string label;
    RgbImage image;
};

/// Draws text at the top left corner of `image`, in pixels; what does not fit is cut off.
void draw_text(RgbImage& image, int left, int top, const std::string& text) {
    struct Corner {
        float x, y, z;
        unsigned char color[4];
    };
    std::vector<Corner> corners(text.size() * 64);
    std::string copy = text; // the font's interface takes no const
    const int quads = stb_easy_font_print(0, 0, copy.data(), nullptr, corners.data(),
                                          static_cast<int>(corners.size() * sizeof(Corner)));
    for (int q = 0; q < quads; ++q) {
        const Corner* c = corners.data() + 4 * q;
        for (int y = static_cast<int>(c[0].y); y < static_cast<int>(c[2].y); ++y)
            for (int x = static_cast<int>(c[0].x); x < static_cast<int>(c[2].x); ++x)
                if (left + x < image.width() && top + y < image.height())
                    image(left + x, top + y) = Rgb(1);
    }
}

RgbImage arrange(const std::vector<Picture>& pictures, int columns) {
    const int w = pictures[0].image.width(), h = pictures[0].image.height() + label_height;
    const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
    RgbImage sheet(columns * w, rows * h, Rgb(0.02f));
    for (int i = 0; i < static_cast<int>(pictures.size()); ++i) {
        const int left = i % columns * w, top = i / columns * h;
        const RgbImage& image = pictures[static_cast<std::size_t>(i)].image;
        for (int y = 0; y < image.height(); ++y)
            std::copy_n(image.row(y), image.width(), sheet.row(top + label_height + y) + left);
        draw_text(sheet, left + 4, top + 5, pictures[static_cast<std::size_t>(i)].label);
    }
    return sheet;
}

/// A gradient as +/- about middle grey.
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
    const glm::ivec2 size = options.size.x > 0 ? options.size : usual_size(opened.scene->size());
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
    const std::vector<Picture> pictures = {
        {label(pt, "picture"), reconstruct(pt.images(), {}).image},
        {label(gpr, "reconstruction"), reconstruct(images, {}).image},
        {label(gpr, "primal"), images.primal},
        {label(gpr, "dx about grey"), around_grey(images.dx)},
    };
    write_png(options.output, arrange(pictures, 2), 0);
    fmt::print("{}: path tracing and gradient-domain path reusing after equal wall time\n",
               options.output.string());
    return exit_ok;
}

} // namespace tessera
