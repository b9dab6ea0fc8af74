#include "recon/enumeration.h"
#include "render/settings/settings_table.h"
#include "ui/gl/controls.h"
#include "ui/gl/theme.h"
#include "ui/panels/panels.h"
#include "ui/settings/settings_file.h"
#include "ui/state/words.h"

#include <cstddef>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

namespace {

/// Draws the settings that are rare, or those that are not. What makes no difference as the others are is left
/// out.
bool draw_settings(Controls& controls, const std::vector<Setting>& settings, bool rare = false) {
    bool changed = false;
    for (const Setting& setting : settings)
        if (setting.is_rare == rare && setting.matters)
            changed |= draw_setting(controls, setting);
    return changed;
}

/// The render settings of the active pane. When all panes have them, each matters that does for one of the
/// methods.
std::vector<Setting> render_settings(ViewerState& state) {
    std::vector<Setting> settings = settings_of(state.active().settings.render);
    for (const PaneState& pane : state.panes) {
        RenderSettings theirs = pane.settings.render;
        const std::vector<Setting> others = settings_of(theirs);
        for (std::size_t i = 0; state.linked && i < settings.size(); ++i)
            settings[i].matters = settings[i].matters || others[i].matters;
    }
    return settings;
}

bool draw_reconstruction_settings(Controls& controls, ReconstructionSettings& settings) {
    bool changed = false;
    for (const Setting& setting : settings_of(settings)) {
        const bool stays = setting.id == "alpha"; // so that what follows does not jump between norms
        if (!setting.matters && !stays)
            continue;
        ImGui::BeginDisabled(!setting.matters);
        changed |= draw_setting(controls, setting);
        ImGui::EndDisabled();
    }
    return changed;
}

void draw_size_settings(Controls& controls, ViewerState& state) {
    draw_setting(controls, size_base_setting(state.size.base));
    if (state.size.base == SizeChoice::Base::custom)
        draw_setting(controls, custom_size_setting(state.size.custom));
    float percent = state.size.scale * 100.0f;
    if (controls.slider("scale", "Scale", percent, 100 * ranges::scale.low(), 100 * ranges::scale.high(),
                        "%.0f %%", "Of width and height. Less is quicker."))
        state.size.scale = percent / 100.0f;
    const glm::ivec2 size = state.request_size(), fitting = state.fitting_size();
    ImGui::TextDisabled("%d x %d pixels a pane", size.x, size.y);
    controls.place("pixels",
                   "What is rendered now. A panel or a window of another size throws no samples away: the "
                   "pictures are scaled, until the panes start anew.");
    if (size != fitting) {
        ImGui::TextDisabled("%d x %d when they start anew", fitting.x, fitting.y);
        controls.place("fitting_pixels",
                       "What fits the panes as they are: taken when the camera moves, or all of them "
                       "are restarted (R).");
    }
}

void draw_run_buttons(Controls& controls, ViewerState& state) {
    const float width = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
    const std::string restart = std::string(icons().restart) + (*icons().restart ? "  " : "") + "Restart";
    const char* icon = state.paused ? icons().play : icons().pause;
    const std::string pause = std::string(icon) + (*icon ? "  " : "") + (state.paused ? "Resume" : "Pause");
    if (controls.button("restart", restart.c_str(), "Renders all panes anew from the first sample (R).", width))
        state.wishes.restart = true;
    ImGui::SameLine();
    if (controls.button("pause", pause.c_str(), "Stops and resumes the rendering (Space).", width))
        state.paused = !state.paused;
    ImGui::SameLine();
    if (controls.button("step", "Step", "Pauses, and adds one sample a pixel in every pane (.).", width)) {
        state.paused = true;
        ++state.wishes.steps;
    }
}

void draw_comparison_settings(Controls& controls, ViewerState& state) {
    Setting comparison = comparison_setting(state.active().settings.comparison.kind);
    comparison.id = "compare";
    draw_setting(controls, comparison);
    std::vector<ChoiceItem> others;
    std::vector<int> panes;
    const int with = state.compared_with(state.active_pane);
    int chosen = 0;
    for (int i = 0; i < static_cast<int>(state.panes.size()); ++i) {
        if (i == state.active_pane)
            continue;
        if (i == with)
            chosen = static_cast<int>(panes.size());
        panes.push_back(i);
        const PaneState& other = state.panes[static_cast<std::size_t>(i)];
        const std::string pane = "pane " + std::to_string(i + 1) + ", ";
        others.push_back(
            {std::to_string(i + 1), pane + std::string(paper_name(other.settings.render.method)),
             pane + std::string(long_name(other.settings.render.method)) + ", with the buffer that it shows."});
    }
    if (with == the_reference)
        chosen = static_cast<int>(panes.size());
    panes.push_back(the_reference);
    others.push_back({"reference", "the reference", "The picture that errors are measured against."});
    if (controls.choice("compare_with", "With", others, chosen,
                        "What is compared with the active pane, and what that shows while B is held."))
        state.active().settings.comparison.with = panes[static_cast<std::size_t>(chosen)];
}

void draw_reference_settings(Controls& controls, ViewerState& state) {
    const Reference* reference = state.companions.reference.get();
    std::string file = reference ? reference->name : "";
    if (controls.text(
            "reference", "File", file, "an EXR file",
            "EXR file with the image to measure errors against (7, 8, 9): type its name, or drop it on the "
            "window."))
        state.wishes.open_reference = file;
    if (controls.button("reference_open", "Open ...", "Chooses an EXR file."))
        state.layout.choosing = FilePurpose::reference;
    ImGui::SameLine();
    if (controls.button("reference_make", "Make ...", "Renders a reference of what the panes show."))
        state.reference_making.show = true;
    if (!reference)
        return;
    const glm::ivec2 size(reference->image.width(), reference->image.height());
    if (size != state.request_size() &&
        controls.button("reference_size", "Render its size", "Renders as many pixels as the reference has."))
        state.size = {SizeChoice::Base::custom, 1, size};
}

void draw_display_settings(Controls& controls, ViewerState& state) {
    draw_settings(controls, settings_of(state.tone));
    controls.toggle(
        "mark_negative", "Mark negative", state.mark_negative,
        "Pixels with a negative red, green or blue are blue (U). NaN is always magenta, infinity cyan.");
    controls.toggle("magnifier", "Magnifier", state.magnifier,
                    "Enlarges the pixels around the mouse, in all panes (L).");
    controls.toggle(
        "tiles", "Tiles", state.show_tiles,
        "Which pixels share their paths in the newest pass (X). Lines closer than 4 units are left out: "
        "zoom in with Ctrl + wheel.");
}

void draw_contents(Controls& controls, ViewerState& state) {
    draw_run_buttons(controls, state);
    draw_settings(controls, settings_of(state.pace));

    heading("Method");
    if (controls.toggle(
            "linked", "Same for all", state.linked,
            "All panes have these settings, and differ only in method and buffer. Otherwise these are the "
            "active pane's (click one).") &&
        state.linked)
        state.share_settings();
    bool changed = draw_settings(controls, render_settings(state));
    const bool more = ImGui::TreeNodeEx("More", ImGuiTreeNodeFlags_NoTreePushOnOpen);
    controls.place("more", "What is seldom changed.");
    if (more)
        changed |= draw_settings(controls, render_settings(state), true);
    heading("Reconstruction");
    changed |= draw_reconstruction_settings(controls, state.active().settings.reconstruction);
    if (changed)
        state.share_settings();

    heading("Display");
    draw_display_settings(controls, state);
    if (state.compared_with(state.active_pane) != state.active_pane) {
        heading("Compare");
        draw_comparison_settings(controls, state);
    }
    heading("Reference");
    draw_reference_settings(controls, state);
    heading("Size");
    draw_size_settings(controls, state);
    heading("Camera");
    const std::string reset = std::string(icons().camera) + (*icons().camera ? "  " : "") + "Reset camera";
    if (controls.button("reset_camera", reset.c_str(), "Back to the camera of the scene file (Home)."))
        state.camera.go_home();
}

} // namespace

void draw_settings_panel(const ScreenRect& where, Controls& controls, ViewerState& state) {
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    if (ImGui::Begin("Settings", nullptr, side_panel_flags))
        draw_contents(controls, state);
    ImGui::End();
}

} // namespace tessera
