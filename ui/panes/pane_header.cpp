#include "render/settings/settings_table.h"
#include "ui/gl/controls.h"
#include "ui/gl/theme.h"
#include "ui/panes/pane_parts.h"
#include "ui/state/pane_labels.h"

#include <algorithm>
#include <string>
#include <vector>

#include <imgui.h>

namespace tessera {

namespace {

const std::vector<ChoiceItem>& method_items() {
    static const std::vector<ChoiceItem> items = [] {
        std::vector<ChoiceItem> list = choice_items(method_choices());
        for (std::size_t i = 0; i < list.size(); ++i)
            list[i].label = std::string(paper_name(all_methods[i])) + "   " + list[i].label;
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

/// Returns the width of the controls for tile and reconstruction.
float extras_width(const PaneSettings& settings) {
    const float font = ImGui::GetFontSize(), spacing = ImGui::GetStyle().ItemSpacing.x;
    return (reuses_paths(settings.render.method) ? font * 5.5f + spacing : 0) + font * 7 + spacing;
}

/// Draws the choices of a pane's tile and reconstruction. A choice is for this pane alone, and unlinks the panes.
void draw_extras(const std::string& id, Controls& controls, ViewerState& state, PaneState& pane) {
    static const std::vector<ChoiceItem> tiles = [] {
        std::vector<ChoiceItem> list;
        for (int edge = 1; edge <= most_tile; ++edge)
            list.push_back({std::to_string(edge), "tile " + std::to_string(edge),
                            "Edge of this pane's tiles, pixels. The pixels of a tile reuse each other's paths."});
        return list;
    }();
    static const std::vector<ChoiceItem> norms = choice_items(norm_choices());
    const float font = ImGui::GetFontSize();
    bool changed = false;
    if (reuses_paths(pane.settings.render.method)) {
        int tile = pane.settings.render.tile - 1;
        ImGui::SameLine();
        changed |= controls.bare_choice((id + ".tile").c_str(), tiles[tile].label.c_str(), tiles, tile,
                                        font * 5.5f, "Edge of this pane's tiles, pixels.");
        pane.settings.render.tile = tile + 1;
    }
    const bool solves = has_gradients(pane.settings.render.method);
    Norm& chosen = pane.settings.reconstruction.norm;
    int norm = static_cast<int>(applied(chosen, solves));
    ImGui::SameLine();
    if (controls.bare_choice((id + ".norm").c_str(), norms[norm].label.c_str(), norms, norm, font * 7,
                             "Reconstruction of this pane's picture.")) {
        chosen = applied(all_norms[norm], solves);
        changed = true;
    }
    if (changed && state.panes.size() > 1)
        state.linked = false;
}

/// Draws the button that shows whether the pane denoises, and switches it.
void draw_denoiser_button(const std::string& id, const char* label, Controls& controls, ViewerState& state,
                          int pane) {
    const bool is_denoised = denoises(applied_norm(state.panes[pane].settings));
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Button, 0u);
    ImGui::PushStyleColor(ImGuiCol_Text, is_denoised ? colours::accent : colours::dim_text);
    const bool clicked = ImGui::Button((std::string(label) + "##" + id).c_str());
    ImGui::PopStyleColor(2); // the tooltip has the usual colours
    controls.place((id + ".denoised").c_str(),
                   is_denoised ? "The picture is denoised, which biases it at few samples. Click to switch to raw "
                                 "samples (Ctrl+D for the active pane)."
                               : "The picture is made of raw samples, without a denoiser. Click to denoise it "
                                 "(Ctrl+D for the active pane).");
    if (clicked)
        toggle_denoiser(state, pane);
}

} // namespace

std::string sample_label(const PaneSettings& pane) {
    const Norm norm = applied_norm(pane);
    if (denoises(norm))
        return "denoised";
    if (norm == Norm::none)
        return "raw samples";
    return "raw samples, " + std::string(norm_choices()[static_cast<int>(norm)].label);
}

void draw_pane_header(int index, Controls& controls, ViewerState& state) {
    PaneState& pane = state.panes[index];
    const std::string id = "pane" + std::to_string(index);
    const float font = ImGui::GetFontSize();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + font * 0.35f, corner.y + height},
                                              method_colour(pane.settings.render.method), font * 0.15f);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + font * 0.7f);

    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    const float extras = extras_width(pane.settings), whole = ImGui::GetContentRegionAvail().x;
    const bool has_extras = whole > extras + font * 24;
    const auto button_width = [](const std::string& text) {
        return ImGui::CalcTextSize(text.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
    };
    std::string samples = sample_label(pane.settings);
    if (whole < button_width(samples) + font * 14)
        samples.erase(std::min(samples.find(' '), samples.size())); // a narrow pane keeps the first word
    const float room = whole - (has_extras ? extras + spacing : 0) - button_width(samples) - spacing;
    const float method_width = std::max(std::min(font * 19, (room - spacing) * 0.58f), 1.0f);
    const float buffer_width = std::max(std::min(font * 11, room - spacing - method_width), 1.0f);
    int method = static_cast<int>(pane.settings.render.method);
    const std::string label = pane_label(state, index);
    const bool has_more = label != paper_name(pane.settings.render.method);
    const std::string& shown = has_more ? label : method_items()[method].label;
    if (controls.bare_choice((id + ".method").c_str(), shown.c_str(), method_items(), method, method_width,
                             "Method of this pane (M)."))
        pane.settings.render.method = all_methods[method];
    ImGui::SameLine();
    int buffer = static_cast<int>(pane.settings.buffer);
    if (controls.bare_choice((id + ".buffer").c_str(), buffer_items()[buffer].label.c_str(), buffer_items(),
                             buffer, buffer_width, "Buffer that this pane shows (1 to 8: all panes)."))
        pane.settings.buffer = all_buffers[buffer];
    draw_denoiser_button(id, samples.c_str(), controls, state, index);
    if (has_extras)
        draw_extras(id, controls, state, pane);
}

} // namespace tessera
