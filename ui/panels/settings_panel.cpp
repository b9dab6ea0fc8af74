#include "recon/enumeration.h"
#include "render/settings/settings_table.h"
#include "ui/gl/controls.h"
#include "ui/gl/theme.h"
#include "ui/panels/panels.h"
#include "ui/settings/presets.h"
#include "ui/settings/settings_file.h"
#include "ui/state/file_names.h"
#include "ui/state/words.h"

#include <algorithm>
#include <cfloat>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

namespace {

/// What the panel begins with; all else is for experts.
bool is_essential(const Setting& setting) {
    static constexpr std::string_view ids[] = {"tile", "roulette", "rr_delta", "norm", "alpha", "max_depth"};
    return std::find(std::begin(ids), std::end(ids), setting.id) != std::end(ids);
}

/// Draws a setting, with a mark where it is not as `usual`: a right click brings that back. Of what has no
/// `usual`, draws the setting alone.
bool draw_marked(Controls& controls, Setting setting, const std::optional<std::string>& usual,
                 const Preset& preset) {
    if (!usual || *usual == setting.text())
        return draw_setting(controls, setting);
    const std::string help = std::string(setting.help) + "\n\n" + std::string(preset.label) + " has " + *usual +
                             ": a right click brings that back.";
    setting.help = help;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float font = ImGui::GetFontSize();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x - font * 0.19f, at.y + ImGui::GetFrameHeight() * 0.5f},
                                                font * 0.15f, colours::accent);
    const bool changed = draw_setting(controls, setting);
    if (!ImGui::IsItemHovered() || !ImGui::IsMouseClicked(ImGuiMouseButton_Right))
        return changed;
    setting.set_text(*usual);
    return true;
}

/// The value that the preset has for a setting; empty: it has none of its own.
std::optional<std::string> usual_value(const Setting& setting, const ViewerState& state, const Preset& preset) {
    PaneSettings usual = state.active().settings;
    apply(preset, usual);
    for (const Setting& other : shared_settings_of(usual))
        if (other.id == setting.id)
            return other.text();
    return {};
}

/// Draws the essential settings, or the others. What makes no difference as the others are is left out, but for
/// alpha, so that what follows does not jump between norms.
bool draw_settings(Controls& controls, const ViewerState& state, const std::vector<Setting>& settings,
                   bool essential) {
    const Preset& preset = presets()[state.preset];
    bool changed = false;
    for (const Setting& setting : settings) {
        if (is_essential(setting) != essential || (!setting.matters && setting.id != "alpha"))
            continue;
        ImGui::BeginDisabled(!setting.matters);
        changed |= draw_marked(controls, setting, usual_value(setting, state, preset), preset);
        ImGui::EndDisabled();
    }
    return changed;
}

/// A heading that folds its section away. True: it is open.
bool begin_section(Controls& controls, ViewerState& state, PanelSection section, const char* id, const char* title,
                   const char* help) {
    ImGui::Spacing();
    ImGui::PushFont(bold_font());
    ImGui::SetNextItemOpen(state.layout.is_open(section));
    const bool open =
        ImGui::TreeNodeEx(title, ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_SpanAvailWidth);
    ImGui::PopFont();
    controls.place(id, help);
    if (open != state.layout.is_open(section))
        state.layout.fold(section);
    return open;
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

void draw_size_settings(Controls& controls, ViewerState& state) {
    draw_setting(controls, size_base_setting(state.rendering.size.base));
    if (state.rendering.size.base == SizeChoice::Base::custom)
        draw_setting(controls, custom_size_setting(state.rendering.size.custom));
    float percent = state.rendering.size.scale * 100.0f;
    if (controls.slider("scale", "Scale", percent, 100 * ranges::scale.low(), 100 * ranges::scale.high(),
                        "%.0f %%", "Of width and height. Less is quicker."))
        state.rendering.size.scale = percent / 100.0f;
    const glm::ivec2 size = state.request_size(), fitting = state.fitting_size();
    ImGui::TextDisabled("%d x %d pixels a pane", size.x, size.y);
    controls.place(
        "pixels",
        "What is rendered now. No panel throws samples away, nor does a window of another size, once there "
        "are some: the pictures are scaled, until the panes start anew.");
    if (size != fitting) {
        ImGui::TextDisabled("%d x %d when they start anew", fitting.x, fitting.y);
        controls.place("fitting_pixels",
                       "What fits the panes as they are: taken when the camera moves, or all of them "
                       "are restarted (R).");
    }
    if (const Camera& camera = state.camera.camera(); state.scene && !camera.is_orthographic) {
        float fov = camera.fov;
        if (controls.slider("fov", "Field of view", fov, 5, 120, "%.1f°",
                            "Degrees that the camera sees across; Home is the scene's."))
            state.camera.set_fov(fov);
    }
    const std::string reset = std::string(icons().camera) + (*icons().camera ? "  " : "") + "Reset camera";
    if (controls.button("reset_camera", reset.c_str(), "Back to the camera of the scene file (Home)."))
        state.camera.go_home();
}

void draw_run_buttons(Controls& controls, ViewerState& state) {
    const float width = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
    const std::string restart = std::string(icons().restart) + (*icons().restart ? "  " : "") + "Restart";
    const char* icon = state.rendering.paused ? icons().play : icons().pause;
    const std::string pause =
        std::string(icon) + (*icon ? "  " : "") + (state.rendering.paused ? "Resume" : "Pause");
    if (controls.button("restart", restart.c_str(), "Renders all panes anew from the first sample (R).", width))
        state.wishes.restart = true;
    ImGui::SameLine();
    if (controls.button("pause", pause.c_str(), "Stops and resumes the rendering (Space).", width))
        state.rendering.paused = !state.rendering.paused;
    ImGui::SameLine();
    if (controls.button("step", "Step", "Pauses, and adds one sample a pixel in every pane (.).", width)) {
        state.rendering.paused = true;
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
        const PaneState& other = state.panes[i];
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
        state.active().settings.comparison.with = panes[chosen];
}

void draw_reference_settings(Controls& controls, ViewerState& state) {
    const Reference* reference = state.companions.reference.get();
    std::string file = reference ? short_path(reference->name) : "";
    if (controls.text("reference", "File", file, "an EXR file",
                      "EXR file with the image to measure errors against (7, 8): type its name, or drop it on the "
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
        state.rendering.size = {SizeChoice::Base::custom, 1, size};
}

void draw_display_settings(Controls& controls, ViewerState& state) {
    for (const Setting& setting : settings_of(state.display.tone))
        if (setting.matters && setting.id != "exposure")
            draw_setting(controls, setting);
    controls.toggle(
        "mark_negative", "Mark negative", state.display.mark_negative,
        "Pixels with a negative red, green or blue are blue (U). NaN is always magenta, infinity cyan.");
    controls.toggle("magnifier", "Magnifier", state.display.magnifier,
                    "Enlarges the pixels around the mouse, in all panes (L).");
    controls.toggle(
        "tiles", "Tiles", state.display.show_tiles,
        "Which pixels share their paths in the newest pass (X). Lines closer than 4 units are left out: "
        "zoom in with Ctrl + wheel.");
}

void draw_preset(Controls& controls, ViewerState& state) {
    static const std::vector<ChoiceItem> items = [] {
        std::vector<ChoiceItem> list;
        for (const Preset& preset : presets())
            list.push_back({std::string(preset.id), std::string(preset.label), std::string(preset.help)});
        return list;
    }();
    const Preset& held_against = presets()[state.preset];
    const bool is_pure = preset_of(state.active().settings) == state.preset;
    const std::string shown = std::string(held_against.label) + (is_pure ? "" : ", changed");
    int index = is_pure ? state.preset : -1; // what has changed can be chosen anew
    controls.label("Preset");
    if (controls.bare_choice(
            "preset", shown.c_str(), items, index, -FLT_MIN,
            "Settings that belong together, for the active pane, or for all that have the same. Marked "
            "is what differs from them. A right click here takes all changes back, as choosing it anew does.") ||
        (!is_pure && ImGui::IsItemClicked(ImGuiMouseButton_Right))) {
        state.preset = index >= 0 ? index : state.preset;
        apply(presets()[state.preset], state.active().settings);
        state.share_settings();
    }
}

void draw_method_section(Controls& controls, ViewerState& state) {
    draw_preset(controls, state);
    if (controls.toggle(
            "linked", "Same for all", state.linked,
            "All panes have these settings, and differ only in method and buffer. Otherwise these are the "
            "active pane's (click one).") &&
        state.linked)
        state.share_settings();
    bool changed = draw_settings(controls, state, render_settings(state), true);
    std::vector<Setting> reconstruction = settings_of(state.active().settings.reconstruction);
    std::string norm_help; // lives as long as the setting that refers to it
    for (Setting& setting : reconstruction)
        if (setting.id == "norm")
            setting.help = norm_help = std::string(setting.help) +
                                       "\n\nPT and PR, which measure no gradients, show raw samples unless it is "
                                       "smoothed or OIDN.";
    changed |= draw_settings(controls, state, reconstruction, true);
    for (const Setting& setting : settings_of(state.display.tone))
        if (setting.id == "exposure")
            draw_setting(controls, setting);
    if (changed)
        state.share_settings();
}

void draw_expert_section(Controls& controls, ViewerState& state) {
    bool changed = draw_settings(controls, state, render_settings(state), false);
    changed |= draw_settings(controls, state, settings_of(state.active().settings.reconstruction), false);
    if (changed)
        state.share_settings();
}

void draw_contents(Controls& controls, ViewerState& state) {
    using Section = PanelSection;
    draw_run_buttons(controls, state);
    if (begin_section(controls, state, Section::method, "section.method", "Method", "What is seldom left alone."))
        draw_method_section(controls, state);
    if (begin_section(controls, state, Section::display, "section.display", "Display", "How pictures are seen."))
        draw_display_settings(controls, state);
    if (state.compared_with(state.active_pane) != state.active_pane &&
        begin_section(controls, state, Section::compare, "section.compare", "Compare",
                      "One pane against another."))
        draw_comparison_settings(controls, state);
    if (begin_section(controls, state, Section::reference, "section.reference", "Reference",
                      "What errors are measured against."))
        draw_reference_settings(controls, state);
    if (begin_section(controls, state, Section::size, "section.size", "Size and camera",
                      "How many pixels are rendered, and from where."))
        draw_size_settings(controls, state);
    if (begin_section(controls, state, Section::limits, "section.limits", "Limits",
                      "When panes rest, and how they share the cores."))
        for (const Setting& setting : settings_of(state.rendering.pace))
            if (setting.matters) // one limit: of what panes have alike
                draw_setting(controls, setting);
    if (begin_section(controls, state, Section::expert, "more", "Expert", "All other settings of the method."))
        draw_expert_section(controls, state);
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
