#include "ui/panels.h"
#include "ui/theme.h"

#include <array>
#include <string>

#include <imgui.h>

namespace tessera {

namespace {

bool draw_method_settings(Controls& controls, RenderSettings& settings) {
    bool changed = controls.slider("tile", "Tile", settings.tile, 1, 16,
                                   "Edge of a tile, in pixels. The pixels of a tile reuse each other's paths. "
                                   "Used by PR and G-PR.");
    changed |= controls.log_slider("rr_delta", "RR delta", settings.rr_delta, 0, 10,
                                   "Reuse roulette: a path whose value (luminance, a radiance) is below delta is "
                                   "reused with probability value / delta. 0: every path is reused.");
    ImGui::BeginDisabled(settings.rr_delta == 0);
    changed |=
        controls.log_slider("q_min", "q min", settings.q_min, 0.001f, 1,
                            "Least probability with which the roulette lets a path be reused (no unit). Above "
                            "0, since a path can carry light for a neighbour where it carries none itself.");
    ImGui::EndDisabled();
    changed |= controls.slider("max_depth", "Max depth", settings.max_depth, 1, 64,
                               "Most edges of a light path. 1: only lamps seen directly; 2: and direct light.");
    return changed;
}

bool draw_reconstruction_settings(Controls& controls, ReconstructionSettings& settings) {
    static const std::array<ChoiceItem, 3> norms = {{
        {"none", "none", "The primal picture as it is."},
        {"l2", "L2", "Least squares: quick and unbiased; outliers leave blobs."},
        {"l1", "L1",
         "Least absolute differences: outliers vanish; at few samples it follows the median and darkens."},
    }};
    int index = static_cast<int>(settings.norm);
    bool changed = controls.choice("norm", "Norm", norms, index,
                                   "How the picture is made from primal and gradients (screened Poisson).");
    settings.norm = static_cast<Norm>(index);
    ImGui::BeginDisabled(settings.norm == Norm::none);
    changed |= controls.log_slider("alpha", "Alpha", settings.alpha, 0.001f, 10,
                                   "Weight of the primal against the gradients (no unit). Small: gradients alone "
                                   "decide on all but the mean.");
    ImGui::EndDisabled();
    return changed;
}

void draw_size_settings(Controls& controls, ViewerState& state) {
    static const std::array<ChoiceItem, 3> bases = {{
        {"pane", "fit the pane", "As many pixels as the pane has, in the film's proportions."},
        {"scene", "of the scene", "The film size of the scene file."},
        {"custom", "custom", "The width and height given below."},
    }};
    int base = static_cast<int>(state.size.base);
    if (controls.choice("size", "Size", bases, base, "How many pixels are rendered."))
        state.size.base = static_cast<SizeChoice::Base>(base);
    if (state.size.base == SizeChoice::Base::custom) {
        controls.number("width", "Width", state.size.custom.x, 1, most_render_pixels_an_edge, "Pixels.");
        controls.number("height", "Height", state.size.custom.y, 1, most_render_pixels_an_edge, "Pixels.");
    }
    float percent = state.size.scale * 100.0f;
    if (controls.slider("scale", "Scale", percent, 5, 200, "%.0f %%", "Of width and height. Less is quicker."))
        state.size.scale = percent / 100.0f;
    const glm::ivec2 size = state.request_size();
    ImGui::TextDisabled("%d x %d pixels a pane", size.x, size.y);
}

void draw_run_buttons(Controls& controls, ViewerState& state) {
    const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) * 0.5f;
    const std::string restart = std::string(icons().restart) + (*icons().restart ? "  " : "") + "Restart";
    const char* icon = state.paused ? icons().play : icons().pause;
    const std::string pause = std::string(icon) + (*icon ? "  " : "") + (state.paused ? "Resume" : "Pause");
    if (controls.button("restart", restart.c_str(), "Renders all panes anew from the first sample (R).", width))
        state.restart = true;
    ImGui::SameLine();
    if (controls.button("pause", pause.c_str(), "Stops and resumes the rendering (Space).", width))
        state.paused = !state.paused;
}

void draw_contents(Controls& controls, ViewerState& state) {
    draw_run_buttons(controls, state);
    controls.number("spp_limit", "Stop at spp", state.spp_limit, 0, 1 << 24,
                    "Samples a pixel after which the panes rest. 0: they never do.");

    heading("Method");
    if (controls.toggle(
            "linked", "Same for all", state.linked,
            "All panes have these settings, and differ only in method and buffer. Otherwise these are the "
            "active pane's (click one).") &&
        state.linked)
        state.share_settings();
    PaneSettings& edited = state.active().settings;
    bool changed = draw_method_settings(controls, edited.render);
    heading("Reconstruction");
    changed |= draw_reconstruction_settings(controls, edited.reconstruction);
    if (changed)
        state.share_settings();

    heading("Display");
    controls.slider("exposure", "Exposure", state.exposure, -10, 10, "%+.1f stops",
                    "Brightness on the screen: every stop doubles it. Gradients are enlarged alike.");
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
    if (ImGui::Begin("Settings", nullptr,
                     (ImGuiWindowFlags_NoDecoration ^ ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                         ImGuiWindowFlags_NoNav))
        draw_contents(controls, state);
    ImGui::End();
}

} // namespace tessera
