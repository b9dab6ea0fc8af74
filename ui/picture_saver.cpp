#include "ui/picture_saver.h"

#include "render/load/png.h"
#include "render/load/temporary_file.h"
#include "ui/chart_file.h"
#include "ui/output_files.h"
#include "ui/screenshot.h"

#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

constexpr int frames_until_still = 3;

void save_window(Viewer& viewer, glm::ivec2 pixels) {
    viewer.save([file = dated_file(".png"), screen = read_screen(pixels)] {
        write_png(file, screen.size, screen.rgb);
        return file.string();
    });
}

/// The part of the window in which the charts are drawn large.
ScreenPixels chart_pixels(const Viewer& viewer, glm::ivec2 pixels) {
    const ControlRect rect = viewer.controls().rects().at("charts.picture");
    const glm::vec2 scale = glm::vec2(pixels) / glm::vec2(glm::max(viewer.state().window_size, glm::ivec2(1)));
    return cropped(read_screen(pixels), glm::ivec2(rect.min * scale), glm::ivec2(rect.max * scale));
}

void save_charts(Viewer& viewer, glm::ivec2 pixels) {
    viewer.save([file = dated_file("-charts.csv"), csv = chart_csv(viewer.state()),
                 svg = chart_svg(viewer.state()), picture = chart_pixels(viewer, pixels)] {
        const auto with_ending = [&](const char* ending) {
            return std::filesystem::path(file).replace_extension(ending);
        };
        write_text(file, csv);
        write_text(with_ending(".svg"), svg);
        write_png(with_ending(".png"), picture.size, picture.rgb);
        return fmt::format("the charts to {}, .svg and .png", file.string());
    });
}

} // namespace

bool PictureSaver::after_frame(Viewer& viewer, glm::ivec2 pixels) {
    ViewerState& state = viewer.state();
    const bool is_wished = state.save_picture || state.save_charts;
    age_ = is_wished && !(state.save_charts && state.histograms_due) ? age_ + 1 : 0; // their end brings a frame
    if (age_ == 0)
        return false;
    if (age_ < frames_until_still)
        return true;
    age_ = 0;
    if (std::exchange(state.save_charts, false))
        save_charts(viewer, pixels);
    else if (std::exchange(state.save_picture, false))
        save_window(viewer, pixels);
    return true;
}

} // namespace tessera
