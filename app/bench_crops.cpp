#include "app/bench_crops.h"

#include "app/bench_chart.h"
#include "app/crop.h"
#include "app/html.h"
#include "render/load/exr.h"

#include <algorithm>

#include <fmt/core.h>

namespace tessera {

namespace {

struct Picture {
    std::string caption; ///< HTML
    RgbImage image;
};

/// "relMSE 0.012, 96 spp, 60.1 CPU s": of the run that made the picture.
std::string figures_of(const Result& result, std::uint64_t seed) {
    for (const Measurement& m : result.runs)
        if (m.seed == seed)
            return fmt::format("relMSE {:.3g}, {} spp, {:.3g} CPU s", m.floor_free.relative_mse, m.spp,
                               m.cpu_seconds);
    return "";
}

/// Those that are there, of this size.
std::vector<Picture> pictures_of(const Experiment& experiment, const SceneCurves& scene,
                                 const RgbImage& reference) {
    std::vector<Picture> pictures;
    for (const Curve& curve : scene.curves) {
        const Result& result = last_of(curve);
        const std::filesystem::path file = experiment.image_file(scene.name, result.point);
        if (!std::filesystem::exists(file))
            continue;
        const ExrFile exr = read_exr(file);
        const RgbImage& image = require_layer(exr, "", file);
        if (image.width() == reference.width() && image.height() == reference.height())
            pictures.push_back({fmt::format("<b>{}</b><br>{}", escaped(curve_label(experiment.options(), curve)),
                                            figures_of(result, experiment.options().settings.render.seed)),
                                image});
    }
    return pictures;
}

const ReferenceImage* reference_of(const Experiment& experiment, const SceneCurves& scene) {
    for (const MeasuredScene& measured : experiment.scenes())
        if (measured.name() == scene.name)
            return &measured.reference(last_of(scene.curves.front()).point.settings);
    return nullptr;
}

/// The whole reference with frames around the crops.
std::string overview(const RgbImage& reference, float exposure, const std::vector<PixelRect>& rects) {
    std::string html = fmt::format(R"(<div style="position:relative; width:{}px">)", reference.width());
    html += inline_image(reference, exposure, R"(alt="the reference")");
    html += fmt::format(R"(<svg style="position:absolute; left:0; top:0" width="{0}" height="{1}">)",
                        reference.width(), reference.height());
    for (PixelRect r : rects)
        html += fmt::format(
            R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#ff0" stroke-width="2"/>)", r.x0,
            r.y0, r.width(), r.height());
    return html + "</svg></div>\n";
}

std::string figure(const RgbImage& image, float exposure, const std::string& caption) {
    constexpr int shown = 200; // pixels of the page
    return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                       inline_image(image, exposure, fmt::format(R"(style="width:{0}px; height:{0}px")", shown)),
                       caption);
}

} // namespace

std::string crops_section(const Experiment& experiment, const SceneCurves& scene) {
    const ReferenceImage* reference = reference_of(experiment, scene);
    if (!reference)
        return "";
    const RgbImage& truth = reference->mean;
    const std::vector<Picture> pictures = pictures_of(experiment, scene, truth);
    if (pictures.empty())
        return "";
    std::vector<const RgbImage*> images;
    for (const Picture& picture : pictures)
        images.push_back(&picture.image);
    const int edge = std::clamp(std::min(truth.width(), truth.height()) / 3, 16, 160);
    const std::vector<PixelRect> rects = choose_crops(truth, images, edge, 2);
    const float exposure = usual_exposure(truth);
    std::string html = fmt::format(
        "<h3>At equal time</h3>\n<p class=\"note\">The two squares where the pictures below err most, all of them "
        "together. Exposure {:+.1f} stops, sRGB; seed {}.</p>\n",
        exposure, experiment.options().settings.render.seed);
    html += overview(truth, exposure, rects);
    for (PixelRect rect : rects) {
        html += "<div class=\"crops\" style=\"margin-top:14px\">\n";
        html += figure(crop(truth, rect), exposure, "<b>reference</b>");
        for (const Picture& picture : pictures)
            html += figure(crop(picture.image, rect), exposure, picture.caption);
        html += "</div>\n";
    }
    return html;
}

} // namespace tessera
