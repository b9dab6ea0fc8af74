#include "recon/enumeration.h"
#include "render/scene/scene.h"
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

#include <fmt/core.h>
#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

namespace {

/// Whether the setting is in the section Method; all others are in the section Expert.
bool is_essential(const Setting& setting) {
    static constexpr std::string_view ids[] = {"tile", "roulette", "rr_delta", "norm", "alpha", "max_depth"};
    return std::find(std::begin(ids), std::end(ids), setting.id) != std::end(ids);
}

/// Draws a setting. Marks it if it differs from the preset's value; a right click then resets it. Returns whether
/// the setting changed.
/// @param usual  the preset's value; empty: none
bool draw_marked(Controls& controls, Setting setting, const std::optional<std::string>& usual,
                 const Preset& preset) {
    if (!usual || *usual == setting.text())
        return draw_setting(controls, setting);
    const bool is_default = &preset == &presets().front();
    const std::string help = std::string(setting.help) + "\n\n" +
                             (is_default ? "Default" : std::string(preset.label)) + ": " + *usual +
                             ". Right-click to reset.";
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

/// Returns the preset's value of a setting; empty: the preset does not set it.
std::optional<std::string> usual_value(const Setting& setting, const ViewerState& state, const Preset& preset) {
    PaneSettings usual = state.active().settings;
    apply(preset, usual);
    for (const Setting& other : shared_settings_of(usual))
        if (other.id == setting.id)
            return other.text();
    return {};
}

/// Draws the essential settings, or the others. Leaves out settings without effect, except alpha, so that the
/// controls below it stay in place when the reconstruction changes. Returns whether a setting changed.
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

/// Draws the heading of a section, which collapses it. Returns whether the section is open.
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

/// Returns the render settings of the active pane. For linked panes a setting matters if it does for any method.
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

/// Draws the list of the scene's sensors, if there are several.
void draw_sensors(Controls& controls, ViewerState& state) {
    if (!state.scene || state.scene->description().sensors.size() < 2)
        return;
    const std::vector<Sensor>& sensors = state.scene->description().sensors;
    std::vector<ChoiceItem> items;
    int chosen = static_cast<int>(state.scene_info.sensor.value_or(0));
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const std::string number = std::to_string(i);
        items.push_back({number, sensors[i].id.empty() ? number : number + ", " + sensors[i].id,
                         fmt::format("A film of {} x {} pixels.", sensors[i].size.x, sensors[i].size.y)});
        if (!state.scene_info.sensor && sensors[i].camera == state.scene->camera())
            chosen = static_cast<int>(i);
    }
    if (controls.choice("sensor", "Sensor", items, chosen,
                        "Sensor of the scene file from which the camera starts."))
        state.show_sensor(static_cast<std::size_t>(chosen));
}

void draw_size_settings(Controls& controls, ViewerState& state) {
    draw_sensors(controls, state);
    draw_setting(controls, size_base_setting(state.rendering.size.base));
    if (state.rendering.size.base == SizeChoice::Base::custom)
        draw_setting(controls, custom_size_setting(state.rendering.size.custom));
    float percent = state.rendering.size.scale * 100.0f;
    if (controls.slider("scale", "Scale", percent, 100 * ranges::scale.low(), 100 * ranges::scale.high(),
                        "%.0f %%", "Scale of the rendered width and height. Smaller is faster."))
        state.rendering.size.scale = percent / 100.0f;
    const glm::ivec2 size = state.request_size(), fitting = state.fitting_size();
    ImGui::TextDisabled("%d x %d pixels per pane", size.x, size.y);
    controls.place("pixels",
                   "Rendered size. If the panels or the window change, the samples stay and the pictures "
                   "are scaled. A restart uses the new size.");
    if (size != fitting) {
        ImGui::TextDisabled("%d x %d after restart", fitting.x, fitting.y);
        controls.place(
            "fitting_pixels",
            "Size that fits the panes. It is used when the camera moves or the panes are restarted (R).");
    }
    if (const Camera& camera = state.camera.camera(); state.scene && !camera.is_orthographic) {
        float fov = camera.fov;
        if (controls.slider("fov", "Field of view", fov, 5, 120, "%.1f°",
                            "Field of view, degrees, along the axis that the scene file states. Home resets it."))
            state.camera.set_fov(fov);
    }
    const std::string reset = std::string(icons().camera) + (*icons().camera ? "  " : "") + "Reset camera";
    if (controls.button("reset_camera", reset.c_str(), "Returns to the camera of the scene file (Home)."))
        state.camera.go_home();
}

void draw_run_buttons(Controls& controls, ViewerState& state) {
    const float width = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
    const std::string restart = std::string(icons().restart) + (*icons().restart ? "  " : "") + "Restart";
    const char* icon = state.rendering.paused ? icons().play : icons().pause;
    const std::string pause =
        std::string(icon) + (*icon ? "  " : "") + (state.rendering.paused ? "Resume" : "Pause");
    if (controls.button("restart", restart.c_str(), "Restarts all panes from the first sample (R).", width))
        state.wishes.restart = true;
    ImGui::SameLine();
    if (controls.button("pause", pause.c_str(), "Stops or resumes rendering (Space).", width))
        state.rendering.paused = !state.rendering.paused;
    ImGui::SameLine();
    if (controls.button("step", "Step", "Pauses, and adds one sample per pixel in every pane (.).", width)) {
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
        others.push_back({std::to_string(i + 1), pane + std::string(paper_name(other.settings.render.method)),
                          pane + std::string(long_name(other.settings.render.method)) + ", with its buffer."});
    }
    if (with == the_reference)
        chosen = static_cast<int>(panes.size());
    panes.push_back(the_reference);
    others.push_back({"reference", "the reference", "The image that errors are measured against."});
    if (controls.choice("compare_with", "With", others, chosen,
                        "Picture that the active pane is compared with. The pane shows it while B is held."))
        state.active().settings.comparison.with = panes[chosen];
}

void draw_reference_settings(Controls& controls, ViewerState& state) {
    const Reference* reference = state.companions.reference.get();
    std::string file = reference ? short_path(reference->name) : "";
    if (controls.text(
            "reference", "File", file, "an EXR file",
            "EXR file with the image that errors are measured against (buffers 7 and 8). Type its name, or "
            "drop it on the window."))
        state.wishes.open_reference = file;
    if (controls.button("reference_open", "Open ...", "Chooses an EXR file."))
        state.layout.choosing = FilePurpose::reference;
    ImGui::SameLine();
    if (controls.button("reference_make", "Make ...", "Renders a reference for the view of the panes."))
        state.reference_making.show = true;
    if (!reference)
        return;
    const glm::ivec2 size(reference->image.width(), reference->image.height());
    if (size != state.request_size() &&
        controls.button("reference_size", "Render at its size", "Renders at the size of the reference."))
        state.rendering.size = {SizeChoice::Base::custom, 1, size};
}

void draw_display_settings(Controls& controls, ViewerState& state) {
    for (const Setting& setting : settings_of(state.display.tone))
        if (setting.matters && setting.id != "exposure")
            draw_setting(controls, setting);
    controls.toggle("mark_negative", "Mark negative", state.display.mark_negative,
                    "Shows pixels with a negative component in blue (U). NaN is always magenta, infinity cyan.");
    controls.toggle("magnifier", "Magnifier", state.display.magnifier,
                    "Enlarges the pixels around the mouse, in all panes (L).");
    controls.toggle("tiles", "Tiles", state.display.show_tiles,
                    "Draws the reuse sets of the newest pass (X). Lines appear once they are at least 4 screen "
                    "units apart: zoom in with Ctrl + wheel.");
}

void draw_preset(Controls& controls, ViewerState& state) {
    static const std::vector<ChoiceItem> items = [] {
        std::vector<ChoiceItem> list;
        for (const Preset& preset : presets())
            list.push_back({std::string(preset.id), std::string(preset.label), std::string(preset.help)});
        return list;
    }();
    const Preset& preset = presets()[state.preset];
    const bool is_unchanged = preset_of(state.active().settings) == state.preset;
    const std::string shown = std::string(preset.label) + (is_unchanged ? "" : ", changed");
    int index = is_unchanged ? state.preset : -1; // -1: choosing a changed preset again resets it
    controls.label("Preset");
    if (controls.bare_choice("preset", shown.c_str(), items, index, -FLT_MIN,
                             "Group of settings for the active pane, or for all panes if they are linked. A "
                             "dot marks settings that differ from it. Right-click, or choose the preset again, "
                             "to reset all changes.") ||
        (!is_unchanged && ImGui::IsItemClicked(ImGuiMouseButton_Right))) {
        state.preset = index >= 0 ? index : state.preset;
        apply(presets()[state.preset], state.active().settings);
        state.share_settings();
    }
}

void draw_method_section(Controls& controls, ViewerState& state) {
    draw_preset(controls, state);
    if (controls.toggle("linked", "Link panes", state.linked,
                        "All panes share these settings, and differ only in method, buffer and comparison. "
                        "Otherwise the settings apply to the active pane; click a pane to make it active.") &&
        state.linked)
        state.share_settings();
    bool changed = draw_settings(controls, state, render_settings(state), true);
    std::vector<Setting> reconstruction = settings_of(state.active().settings.reconstruction);
    std::string norm_help; // the setting refers to it
    for (Setting& setting : reconstruction)
        if (setting.id == "norm")
            setting.help = norm_help =
                std::string(setting.help) +
                "\n\nPT and PR measure no gradients: they show raw samples unless smoothed or "
                "OIDN is chosen.";
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
    if (begin_section(controls, state, Section::method, "section.method", "Method",
                      "The most used settings of the method."))
        draw_method_section(controls, state);
    if (begin_section(controls, state, Section::display, "section.display", "Display", "Display of the pictures."))
        draw_display_settings(controls, state);
    if (state.compared_with(state.active_pane) != state.active_pane &&
        begin_section(controls, state, Section::compare, "section.compare", "Compare",
                      "Comparison of the active pane with another one or the reference."))
        draw_comparison_settings(controls, state);
    if (begin_section(controls, state, Section::reference, "section.reference", "Reference",
                      "Image that errors are measured against."))
        draw_reference_settings(controls, state);
    if (begin_section(controls, state, Section::size, "section.size", "Size and camera",
                      "Rendered size and camera."))
        draw_size_settings(controls, state);
    if (begin_section(controls, state, Section::limits, "section.limits", "Limits",
                      "When panes stop, and how they share the processor cores."))
        for (const Setting& setting : settings_of(state.rendering.pace))
            if (setting.matters) // hides the limit that does not apply
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
