#include "render/estimator/settings_table.h"
#include "ui/gl/theme.h"
#include "ui/panels/panels.h"
#include "ui/state/words.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <imgui.h>

namespace tessera {

namespace {

bool draw_choice(Controls& controls, const Setting& setting, const Setting::OneOf& one, RenderSettings& settings) {
    std::vector<ChoiceItem> items;
    for (const SettingChoice& c : one.choices)
        items.push_back({std::string(c.id), std::string(c.label), std::string(c.help)});
    int index = one.get(settings);
    const bool changed = controls.choice(std::string(setting.id).c_str(), std::string(setting.label).c_str(),
                                         items, index, std::string(setting.help).c_str());
    if (changed)
        one.set(settings, index);
    return changed;
}

bool draw_setting(Controls& controls, const Setting& setting, RenderSettings& settings) {
    const std::string id(setting.id), label(setting.label), help(setting.help);
    if (const auto* whole = std::get_if<Setting::Whole>(&setting.kind))
        return controls.slider(id.c_str(), label.c_str(), settings.*whole->member, whole->least, whole->most,
                               help.c_str());
    if (const auto* real = std::get_if<Setting::Real>(&setting.kind))
        return controls.log_slider(id.c_str(), label.c_str(), settings.*real->member, real->low, real->high,
                                   help.c_str());
    if (const auto* on = std::get_if<Setting::Switch>(&setting.kind))
        return controls.toggle(id.c_str(), label.c_str(), settings.*on->member, help.c_str());
    return draw_choice(controls, setting, std::get<Setting::OneOf>(setting.kind), settings);
}

/// Whether a setting makes a difference in a pane that has the settings at hand.
bool matters(const Setting& setting, const ViewerState& state) {
    const auto in = [&](const PaneState& pane) { return setting.matters(pane.settings.render); };
    return state.linked ? std::any_of(state.panes.begin(), state.panes.end(), in)
                        : in(state.panes[static_cast<std::size_t>(state.active_pane)]);
}

/// What makes no difference with the others as they are is not there.
bool draw_method_settings(Controls& controls, const ViewerState& state, bool rare, RenderSettings& settings) {
    bool changed = false;
    for (const Setting& setting : all_settings()) {
        if (setting.is_rare == rare && matters(setting, state))
            changed |= draw_setting(controls, setting, settings);
    }
    return changed;
}

bool draw_reconstruction_settings(Controls& controls, ReconstructionSettings& settings) {
    static const std::array<ChoiceItem, 6> norms = {{
        {"none", "none", "The primal picture as it is."},
        {"l2", "L2", "Least squares: quick and unbiased; outliers leave blobs."},
        {"l1", "L1",
         "Least absolute differences: outliers vanish; at few samples it follows the median and darkens."},
        {"mixed", "mixed",
         "Least absolute differences of the gradients, least squares of the primal: few outliers, and as bright "
         "as the primal."},
        {"uniform", "uniform",
         "Fifty times the mean of a pixel and its neighbours with the gradients added (uniform control "
         "variates)."},
        {"weighted", "weighted",
         "Least squares, where gradients count the less the noisier they are (control variates weighted by "
         "variances): few outliers, and as bright as the primal."},
    }};
    int index = static_cast<int>(settings.norm);
    bool changed = controls.choice("norm", "Norm", norms, index,
                                   "How the picture is made from primal and gradients (screened Poisson).");
    settings.norm = static_cast<Norm>(index);
    ImGui::BeginDisabled(settings.norm == Norm::none || settings.norm == Norm::uniform);
    changed |= controls.log_slider("alpha", "Alpha", settings.alpha, ranges::alpha_slider.low(),
                                   ranges::alpha_slider.high(),
                                   "Weight of the primal against the gradients (no unit). Small: gradients alone "
                                   "decide on all but the mean, as far as they are trusted.");
    ImGui::EndDisabled();
    if (settings.norm == Norm::l1 || settings.norm == Norm::mixed)
        changed |= controls.toggle("joint_colour", "Joint colour", settings.joint_colour,
                                   "On: misfits are lengths of colours, and the channels agree on what is an "
                                   "outlier. Off: each channel is on its own.");
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
    const glm::ivec2 size = state.request_size(), fitting = state.fitting_size();
    ImGui::TextDisabled("%d x %d pixels a pane", size.x, size.y);
    controls.note("pixels",
                  "What is rendered now. A panel or a window of another size throws no samples away: the "
                  "pictures are scaled, until the panes start anew.");
    if (size != fitting) {
        ImGui::TextDisabled("%d x %d when they start anew", fitting.x, fitting.y);
        controls.note("fitting_pixels",
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

void draw_pace(Controls& controls, Pace& pace) {
    static const std::array<ChoiceItem, 2> shares = {{
        {"time", "same time", "Passes go to the pane that has rendered for the shortest time."},
        {"spp", "same spp", "Passes go to the pane with the fewest samples a pixel."},
    }};
    int share = static_cast<int>(pace.equal);
    if (controls.choice("equal", "Panes have", shares, share, "How the panes share the cores."))
        pace.equal = static_cast<Pace::Equal>(share);
    controls.number("spp_limit", "Stop at spp", pace.spp_limit, 0, ranges::most_spp,
                    "Samples a pixel after which the panes rest. 0: they never do.");
    controls.number("seconds_limit", "Stop at seconds", pace.seconds_limit, 0, ranges::most_seconds,
                    "Seconds (wall time) of a pane's own passes after which it rests. 0: it never does.");
}

void draw_comparison_settings(Controls& controls, ViewerState& state) {
    static const std::array<ChoiceItem, 3> kinds = {{
        {"off", "off", "The pane shows its own picture."},
        {"wipe", "wipe", "Its own picture to the left of a line, another pane's to the right. Drag the line (V)."},
        {"difference", "difference", "Its own picture minus another pane's: orange above zero, blue below (N)."},
    }};
    Comparison& comparison = state.active().settings.comparison;
    int kind = static_cast<int>(comparison.kind);
    if (controls.choice("compare", "Active pane", kinds, kind, "How the active pane shows another one's picture."))
        comparison.kind = static_cast<Comparison::Kind>(kind);
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
        comparison.with = panes[static_cast<std::size_t>(chosen)];
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
    controls.slider("exposure", "Exposure", state.tone.exposure, ranges::exposure.low(), ranges::exposure.high(),
                    "%+.1f stops",
                    "Brightness on the screen: every stop doubles it. Gradients are enlarged alike.");
    static const std::array<ChoiceItem, 3> curves = {{
        {"srgb", "sRGB", "The display's own curve: linear radiance up to 1, the rest is cut."},
        {"gamma", "gamma", "Radiance to the power of 1/gamma."},
        {"filmic", "filmic", "Highlights are compressed instead of cut [Narkowicz 2015], then sRGB."},
    }};
    int curve = static_cast<int>(state.tone.curve);
    if (controls.choice("tone", "Tone curve", curves, curve, "How radiance becomes brightness on the screen (Y)."))
        state.tone.curve = static_cast<Tone::Curve>(curve);
    if (state.tone.curve == Tone::Curve::gamma)
        controls.slider("gamma", "Gamma", state.tone.gamma, 1, 4, "%.2f", "The exponent's inverse (no unit).");
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
    draw_pace(controls, state.pace);

    heading("Method");
    if (controls.toggle(
            "linked", "Same for all", state.linked,
            "All panes have these settings, and differ only in method and buffer. Otherwise these are the "
            "active pane's (click one).") &&
        state.linked)
        state.share_settings();
    PaneSettings& edited = state.active().settings;
    bool changed = draw_method_settings(controls, state, false, edited.render);
    const bool more = ImGui::TreeNodeEx("More", ImGuiTreeNodeFlags_NoTreePushOnOpen);
    controls.note("more", "What is seldom changed.");
    if (more)
        changed |= draw_method_settings(controls, state, true, edited.render);
    heading("Reconstruction");
    changed |= draw_reconstruction_settings(controls, edited.reconstruction);
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
