#include "ui/picture_saver.h"

#include "render/load/png.h"
#include "ui/chart_file.h"
#include "ui/output_files.h"
#include "ui/screenshot.h"

#include <exception>
#include <functional>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

constexpr int frames_until_still = 3;

std::string save_window(glm::ivec2 pixels) {
    const std::filesystem::path file = dated_file(".png");
    const ScreenPixels screen = read_screen(pixels);
    write_png(file, screen.size, screen.rgb);
    return file.string();
}

/// The part of the window in which the charts are drawn large.
ScreenPixels chart_pixels(const Viewer& viewer, glm::ivec2 pixels) {
    const ControlRect rect = viewer.controls().rects().at("charts.picture");
    const glm::vec2 scale = glm::vec2(pixels) / glm::vec2(glm::max(viewer.state().window_size, glm::ivec2(1)));
    return cropped(read_screen(pixels), glm::ivec2(rect.min * scale), glm::ivec2(rect.max * scale));
}

std::string save_charts(const Viewer& viewer, glm::ivec2 pixels) {
    const std::string name = dated_file("-charts").string();
    write_text_file(name + ".csv", chart_csv(viewer.state()));
    write_text_file(name + ".svg", chart_svg(viewer.state()));
    const ScreenPixels picture = chart_pixels(viewer, pixels);
    write_png(name + ".png", picture.size, picture.rgb);
    return fmt::format("the charts to {}.csv, .svg and .png", name);
}

/// Tells how it went. `write` returns what was saved where.
void save(ViewerState& state, const std::function<std::string()>& write) {
    try {
        state.add_message(Message::Kind::note, "Saved " + write());
    } catch (const std::exception& e) {
        state.add_message(Message::Kind::error, e.what());
    }
}

} // namespace

bool PictureSaver::after_frame(Viewer& viewer, glm::ivec2 pixels) {
    ViewerState& state = viewer.state();
    age_ = state.save_picture || state.save_charts ? age_ + 1 : 0;
    if (age_ == 0)
        return false;
    if (age_ < frames_until_still)
        return true;
    age_ = 0;
    if (std::exchange(state.save_charts, false))
        save(state, [&] { return save_charts(viewer, pixels); });
    else if (std::exchange(state.save_picture, false))
        save(state, [&] { return save_window(pixels); });
    return true;
}

} // namespace tessera
