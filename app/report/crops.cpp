#include "app/report/page.h"
#include "app/report/reports.h"
#include "recon/metrics/metrics.h"
#include "render/io/exr.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <utility>

#include <fmt/core.h>
#include <stb_easy_font.h>

namespace tessera {

namespace {

constexpr int label_height = 18;

/// Draws text with its top left corner at (left, top), in pixels. Text outside the image is cut off.
void draw_text(RgbImage& image, int left, int top, const std::string& text) {
    struct Corner {
        float x, y, z;
        unsigned char color[4];
    };
    std::vector<Corner> corners(text.size() * 64);
    std::string copy = text; // stb_easy_font takes no const
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

} // namespace

RgbImage picture_sheet(const std::vector<LabelledPicture>& pictures, int columns) {
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

namespace {

float relative_error(Rgb value, Rgb truth) {
    const float error = luminance(value) - luminance(truth);
    return std::min(1.0f, error * error / (luminance(truth) * luminance(truth) + float(relative_mse_epsilon)));
}

/// Returns the summed-area table of the errors: sums(x, y) is the sum over all pixels left of x and above y.
Image<double> summed_errors(const RgbImage& reference, const std::vector<const RgbImage*>& pictures) {
    Image<double> sums(reference.width() + 1, reference.height() + 1);
    for (int y = 0; y < reference.height(); ++y) {
        double row = 0;
        for (int x = 0; x < reference.width(); ++x) {
            for (const RgbImage* picture : pictures)
                if (is_finite((*picture)(x, y)))
                    row += relative_error((*picture)(x, y), reference(x, y));
            sums(x + 1, y + 1) = sums(x + 1, y) + row;
        }
    }
    return sums;
}

bool overlap(PixelRect a, PixelRect b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

} // namespace

std::vector<PixelRect> choose_crops(const RgbImage& reference, const std::vector<const RgbImage*>& pictures,
                                    int edge, int count) {
    const Image<double> sums = summed_errors(reference, pictures);
    edge = std::min({edge, reference.width(), reference.height()});
    constexpr int step = 4; // pixels between the squares that are tried; not tuned
    std::vector<PixelRect> chosen;
    for (int i = 0; i < count; ++i) {
        PixelRect best{0, 0, 0, 0};
        double largest_sum = -1;
        for (int y = 0; y + edge <= reference.height(); y += step)
            for (int x = 0; x + edge <= reference.width(); x += step) {
                const PixelRect rect{x, y, x + edge, y + edge};
                const double sum = sums(rect.x1, rect.y1) - sums(rect.x0, rect.y1) - sums(rect.x1, rect.y0) +
                                   sums(rect.x0, rect.y0);
                const auto is_in = [&](PixelRect other) { return overlap(rect, other); };
                if (sum > largest_sum && std::none_of(chosen.begin(), chosen.end(), is_in)) {
                    largest_sum = sum;
                    best = rect;
                }
            }
        if (!best.empty())
            chosen.push_back(best);
    }
    return chosen;
}

RgbImage crop(const RgbImage& image, PixelRect rect) {
    RgbImage part(rect.width(), rect.height());
    for (int y = 0; y < part.height(); ++y)
        std::copy_n(image.row(rect.y0 + y) + rect.x0, part.width(), part.row(y));
    return part;
}

float auto_exposure(const RgbImage& image) {
    std::vector<float> values;
    for (Rgb c : image)
        values.push_back(std::isfinite(luminance(c)) ? luminance(c) : 0.0f);
    if (values.empty())
        return 0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() - 1) * 9 / 10;
    std::nth_element(values.begin(), at, values.end());
    return *at > 0 ? std::log2(0.8f / *at) : 0.0f;
}

namespace {

/// Returns "seed 1: relMSE 0.012, FLIP 0.08<br>96 spp, 60.1 CPU s" of the run that made the picture.
std::string figures_of(const Result& result, std::uint64_t seed) {
    for (const Measurement& m : result.runs)
        if (m.seed == seed)
            return fmt::format("seed {}: relMSE {:.3g}{}<br>{} spp, {:.3g} CPU s", seed, m.floor_free.relative_mse,
                               std::isfinite(m.flip) ? fmt::format(", FLIP {:.3g}", m.flip) : "", m.spp,
                               m.cpu_seconds);
    return "";
}

/// Reads the picture of a file. Returns an empty image and prints a warning if the file cannot be read, so that a
/// damaged file does not prevent the report.
RgbImage read_picture(const std::filesystem::path& file) {
    try {
        const ExrFile exr = read_exr(file, {}, {""});
        return require_layer(exr, "", file);
    } catch (const std::exception& error) {
        fmt::print(stderr, "warning: a picture is missing from the page: {}; delete the file to render it again\n",
                   error.what());
        return {};
    }
}

} // namespace

std::vector<PagePicture> pictures_of(const Experiment& experiment, const std::vector<NamedResult>& results,
                                     const RgbImage& reference) {
    std::vector<PagePicture> pictures;
    for (const auto& [name, result] : results) {
        const std::filesystem::path file = experiment.image_file(result->scene, result->setup);
        if (!std::filesystem::exists(file))
            continue;
        RgbImage image = read_picture(file);
        if (image.width() == reference.width() && image.height() == reference.height())
            pictures.push_back(
                {name, figures_of(*result, experiment.options().settings.render.seed), std::move(image)});
    }
    return pictures;
}

namespace {

const ReferenceImage* reference_of(const Experiment& experiment, const SceneCurves& scene) {
    for (const MeasuredScene& measured : experiment.scenes())
        if (measured.name() == last_of(scene.curves.front()).scene)
            return &measured.reference(last_of(scene.curves.front()).setup.settings);
    return nullptr;
}

/// Returns HTML of the whole reference with frames around the crops.
std::string overview(const RgbImage& reference, float exposure, const std::vector<PixelRect>& rects) {
    std::string html =
        fmt::format(R"(<div style="position:relative; width:{}px; max-width:100%">)", reference.width());
    html +=
        inline_image(reference, exposure, R"(alt="the reference" style="width:100%; height:auto; display:block")");
    html += fmt::format(R"(<svg style="position:absolute; left:0; top:0; width:100%; height:100%" )"
                        R"(viewBox="0 0 {0} {1}">)",
                        reference.width(), reference.height());
    for (PixelRect r : rects)
        html += fmt::format(
            R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#ff0" stroke-width="2"/>)", r.x0,
            r.y0, r.width(), r.height());
    return html + "</svg></div>\n";
}

/// Returns HTML of an image with the name and figures of a PagePicture.
std::string captioned(const RgbImage& image, float exposure, const std::string& name, const std::string& figures) {
    constexpr int shown = 200; // pixels of the page
    return fmt::format("<figure style=\"width:{0}px\">{1}<figcaption><b>{2}</b><br>{3}</figcaption></figure>\n",
                       shown,
                       inline_image(image, exposure, fmt::format(R"(style="width:{0}px; height:{0}px")", shown)),
                       escaped(name), figures);
}

} // namespace

std::string crops_section(const Experiment& experiment, const SceneCurves& scene) {
    const ReferenceImage* reference = reference_of(experiment, scene);
    if (!reference)
        return "";
    const RgbImage& truth = reference->mean;
    std::vector<NamedResult> results;
    for (const Curve& curve : scene.curves)
        results.push_back({curve_label(experiment.options(), curve), &last_of(curve)});
    const std::vector<PagePicture> pictures = pictures_of(experiment, results, truth);
    if (pictures.empty())
        return "";
    std::vector<const RgbImage*> images;
    for (const PagePicture& picture : pictures)
        images.push_back(&picture.image);
    const int edge = std::clamp(std::min(truth.width(), truth.height()) / 3, 16, 160);
    const std::vector<PixelRect> rects = choose_crops(truth, images, edge, 2);
    const float exposure = auto_exposure(truth);
    std::string html =
        fmt::format("<h3>At equal time</h3>\n<p class=\"note\">The two squares with the largest total error of "
                    "the pictures below, each at its own exposure. Exposure of whole pictures: {:+.1f} stops, "
                    "sRGB. Pictures and their figures are of seed {}; the table has means over all seeds.</p>\n",
                    exposure, experiment.options().settings.render.seed);
    html += comparison(truth, pictures, exposure);
    html += overview(truth, exposure, rects);
    for (PixelRect rect : rects) {
        const RgbImage true_crop = crop(truth, rect);
        const float shown = std::min(exposure, auto_exposure(true_crop)); // avoids overexposed crops
        html += "<div class=\"crops\" style=\"margin-top:14px\">\n";
        html += captioned(true_crop, shown, "reference", fmt::format("exposure {:+.1f}", shown));
        for (const PagePicture& picture : pictures)
            html += captioned(crop(picture.image, rect), shown, picture.name, picture.figures);
        html += "</div>\n";
    }
    return html;
}

} // namespace tessera
