#include "ui/pane_header.h"

#include "ui/theme.h"

#include <algorithm>
#include <vector>

#include <imgui.h>

namespace tessera {

namespace {

const char* help(Method method) {
    switch (method) {
    case Method::pt:
        return "Every pixel for itself: light and BSDF sampling, combined by multiple importance sampling [Veach "
               "1997].";
    case Method::pr:
        return "Each base path brings light to all pixels of its tile: less noise, alike within a tile [Bekaert "
               "2002, "
               "Bauszat 2017].";
    case Method::gpt:
        return "Each path is shifted to its pixel's neighbours, which measures gradients with little noise; the "
               "picture is reconstructed from these and the primal [Kettunen 2015].";
    case Method::gpr:
        return "Gradients as G-PT has, from the paths that a tile shares as PR does [Bauszat 2017].";
    }
    return "";
}

const std::vector<ChoiceItem>& method_items() {
    static const std::vector<ChoiceItem> items = [] {
        std::vector<ChoiceItem> list;
        for (Method method : all_methods)
            list.push_back({std::string(short_name(method)),
                            std::string(paper_name(method)) + "   " + std::string(long_name(method)),
                            help(method)});
        return list;
    }();
    return items;
}

const std::vector<ChoiceItem>& buffer_items() {
    static const std::vector<ChoiceItem> items = [] {
        std::vector<ChoiceItem> list;
        for (Buffer buffer : all_buffers)
            list.push_back({info(buffer).id, info(buffer).label, info(buffer).help});
        return list;
    }();
    return items;
}

} // namespace

void draw_pane_header(const std::string& id, Controls& controls, PaneState& pane) {
    const float font = ImGui::GetFontSize();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + font * 0.35f, corner.y + height},
                                              method_colour(pane.settings.render.method), font * 0.15f);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + font * 0.7f);

    const float room = ImGui::GetContentRegionAvail().x;
    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    const float method_width = std::max(std::min(font * 19, (room - spacing) * 0.58f), 1.0f);
    const float buffer_width = std::max(std::min(font * 11, room - spacing - method_width), 1.0f);
    int method = static_cast<int>(pane.settings.render.method);
    if (controls.bare_choice((id + ".method").c_str(),
                             method_items()[static_cast<std::size_t>(method)].label.c_str(), method_items(),
                             method, method_width, "How this pane's light paths are sampled (M)."))
        pane.settings.render.method = all_methods[method];
    ImGui::SameLine();
    int buffer = static_cast<int>(pane.settings.buffer);
    if (controls.bare_choice((id + ".buffer").c_str(),
                             buffer_items()[static_cast<std::size_t>(buffer)].label.c_str(), buffer_items(),
                             buffer, buffer_width, "What this pane shows (1 to 9, Shift+0 to 9: all panes)."))
        pane.settings.buffer = all_buffers[buffer];
}

} // namespace tessera
