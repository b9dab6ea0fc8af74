#include "ui/pane_status.h"

#include "ui/theme.h"

#include <algorithm>
#include <cstdio>

#include <imgui.h>

namespace tessera {

namespace {

bool is_done(const Snapshot& snapshot, const Pace& pace) {
    return (pace.spp_limit > 0 && snapshot.spp >= pace.spp_limit) ||
           (pace.seconds_limit > 0 && snapshot.seconds >= pace.seconds_limit);
}

} // namespace

std::string status_text(const PaneState& pane, bool paused, const Pace& pace) {
    const std::string method(paper_name(pane.settings.render.method));
    if (!pane.snapshot || pane.snapshot->generation != pane.generation)
        return method + (paused ? "   paused" : "   starting");
    const Snapshot& snapshot = *pane.snapshot;
    const double rate =
        snapshot.seconds > 0 ? static_cast<double>(snapshot.counters.all_rays()) / snapshot.seconds : 0;
    char text[160];
    std::snprintf(text, sizeof text, "%s   %d spp   %.2f s   %.1f Mrays/s", method.c_str(), snapshot.spp,
                  snapshot.seconds, rate * 1e-6);
    std::string line = text;
    if (snapshot.coarse)
        line += "   first look";
    else if (snapshot.reconstruction && has_gradients(snapshot.settings.method))
        line += "   reconstruction of pass " + std::to_string(snapshot.reconstruction_spp);
    if (snapshot.counters.refused_samples > 0)
        line += "   " + std::to_string(snapshot.counters.refused_samples) + " samples refused";
    if (paused)
        line += "   paused";
    else if (is_done(snapshot, pace))
        line += "   done";
    return line;
}

std::string value_text(const Rgb& value, ColourMap map, const BufferInfo& about) {
    char text[128];
    if (map == ColourMap::false_colour)
        std::snprintf(text, sizeof text, "%.4g %s", static_cast<double>(value.r * about.unit_scale), about.unit);
    else if (map == ColourMap::direction)
        std::snprintf(text, sizeof text, "%+.3f %+.3f %+.3f", static_cast<double>(value.x),
                      static_cast<double>(value.y), static_cast<double>(value.z));
    else
        std::snprintf(text, sizeof text, "%.4g %.4g %.4g  Y %.4g", static_cast<double>(value.r),
                      static_cast<double>(value.g), static_cast<double>(value.b),
                      static_cast<double>(luminance(value)));
    return text;
}

std::string cursor_text(const ViewerState& state, const PaneImages& images, int pane) {
    if (!state.cursor)
        return "";
    const glm::vec2 place = state.cursor->place;
    const Showing showing = showing_at(state, pane, state.cursor->share);
    const std::optional<Rgb> value = value_at(showing, images, place);
    if (!value)
        return "";
    const PaneImage& image = images[static_cast<std::size_t>(showing.pane)];
    const glm::vec2 size(image.pixels().width(), image.pixels().height());
    char where[48];
    std::snprintf(where, sizeof where, "(%d, %d)  ", static_cast<int>(place.x * size.x),
                  static_cast<int>(place.y * size.y));
    return where + value_text(*value, colour_map(showing, state), info(image.buffer()));
}

void draw_status(const std::string& id, int pane, const ViewerState& state, const PaneImages& images,
                 Controls& controls) {
    const std::string status = status_text(state.panes[static_cast<std::size_t>(pane)], state.paused, state.pace);
    const std::string cursor = cursor_text(state, images, pane);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float room = std::max(ImGui::GetContentRegionAvail().x, 1.0f), height = ImGui::GetTextLineHeight();
    ImGui::PushFont(mono_font());
    const float width = cursor.empty() ? 0 : ImGui::CalcTextSize(cursor.c_str()).x;
    ImGui::PopFont();

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float left = std::max(at.x + room - width, at.x); // of the numbers
    list.PushClipRect(at, {cursor.empty() ? at.x + room : left - height * 0.5f, at.y + height * 1.3f}, true);
    list.AddText(at, colours::dim_text, status.c_str());
    list.PopClipRect();
    if (!cursor.empty())
        list.AddText(mono_font(), ImGui::GetFontSize(), {left, at.y}, colours::text, cursor.c_str());

    ImGui::Dummy({room, height});
    controls.note((id + ".status").c_str(), status.c_str()); // a narrow pane cuts it off
    if (cursor.empty())
        return;
    ImGui::SetCursorScreenPos({left, at.y});
    ImGui::Dummy({std::min(width, room), height});
    controls.note((id + ".value").c_str(),
                  "Pixel under the mouse, counted from the top left, and its value in the "
                  "buffer on show: red, green, blue and luminance (Y); radiance.");
}

} // namespace tessera
