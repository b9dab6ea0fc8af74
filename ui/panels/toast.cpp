#include "ui/gl/theme.h"
#include "ui/panels/panels.h"

#include <cmath>

#include <imgui.h>

namespace tessera {

void draw_toast(const ScreenRect& where, Controls& controls, ViewerState& state) {
    Toast& toast = state.layout.toast;
    if (toast.text.empty())
        return;
    const double now = ImGui::GetTime();
    if (toast.since == 0)
        toast.since = now;
    if (now - toast.since > Toast::seconds) {
        toast = {};
        state.wishes.redraw = true;
        return;
    }
    const float font = ImGui::GetFontSize(), pad = std::floor(font * 0.6f);
    const float wrap_width = where.size().x - 4 * pad;
    if (wrap_width < font)
        return;
    const ImVec2 size = ImGui::CalcTextSize(toast.text.c_str(), nullptr, false, wrap_width);
    const ImVec2 min(std::floor((where.min.x + where.max.x - size.x) * 0.5f) - pad,
                     where.max.y - size.y - 4 * pad - font);
    const ImVec2 max(min.x + size.x + 2 * pad, min.y + size.y + 2 * pad);
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    list.AddRectFilled(min, max, colours::overlay, pad * 0.6f);
    list.AddRect(min, max, colours::overlay_accent, pad * 0.6f);
    list.AddText(ImGui::GetFont(), font, {min.x + pad, min.y + pad}, colours::overlay_text, toast.text.c_str(),
                 nullptr, wrap_width);
    controls.place_rect("toast", {min.x, min.y}, {max.x, max.y});
}

} // namespace tessera
