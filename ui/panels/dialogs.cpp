#include "render/run/reference_render.h"
#include "render/settings/settings_table.h"
#include "ui/gl/controls.h"
#include "ui/panels/panels.h"
#include "ui/state/buffer.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/core.h>

namespace tessera {

namespace {

void draw_method(Controls& controls, ReferenceMaking& making) {
    static const std::vector<ChoiceItem> methods = [] {
        constexpr const char* helps[] = {
            "Path tracing: slow, with independent errors in each pixel.", "Path reusing in tiles of 8 pixels.",
            "Gradients between neighbours; L2 reconstruction, or raw samples if their error is smaller.",
            "Gradients in tiles of 8 pixels; L2 reconstruction, or raw samples if their error is smaller. "
            "Fastest on most scenes."};
        std::vector<ChoiceItem> list;
        for (Method method : all_methods)
            list.push_back({std::string(short_name(method)), std::string(paper_name(method)),
                            helps[static_cast<std::size_t>(method)]});
        return list;
    }();
    int index = static_cast<int>(making.method);
    if (controls.choice("reference.method", "Method", methods, index, "Method that renders the reference."))
        making.method = all_methods[index];
}

void draw_file(Controls& controls, ViewerState& state) {
    ReferenceMaking& making = state.reference_making;
    const std::string hint = default_reference_file(state).filename().string();
    controls.label("File");
    ImGui::InputTextWithHint("##reference.file", hint.c_str(), making.file.data(), making.file.size());
    controls.place(
        "reference.file",
        "EXR file to write. Default: a file in the current folder, named after scene, size, depth, and the "
        "camera unless it is the scene's.");
}

void draw_notes(Controls& controls, ViewerState& state) {
    const glm::ivec2 size = state.request_size();
    const auto seconds = estimated_seconds(state);
    dim_text(fmt::format("{} x {} pixels, depth {}, camera of the panes. {}", size.x, size.y,
                         state.active().settings.render.max_depth,
                         seconds ? "About " + duration_text(*seconds) +
                                       " if nothing else is rendered. The panes have priority."
                                 : "The time is unknown until a pane has a picture."));
    std::error_code ignored;
    const std::filesystem::path file = wanted_reference_file(state);
    if (std::filesystem::exists(file, ignored))
        dim_text("The file exists and will be replaced.");
    if (!std::filesystem::exists(reference_checkpoint(file), ignored))
        return;
    dim_text("There is a checkpoint of this reference. Rendering continues from it.");
    controls.toggle("reference.anew", "Start over", state.reference_making.anew, "Ignores the checkpoint.");
}

void draw_form(Controls& controls, ViewerState& state) {
    ReferenceMaking& making = state.reference_making;
    draw_method(controls, making);
    Setting spp = spp_setting(making.spp, 2);
    spp.id = "reference.spp";
    spp.help = "Samples per pixel of both halves together. The difference of these independent renders gives "
               "the reference's error.";
    draw_setting(controls, spp);
    draw_file(controls, state);
    draw_notes(controls, state);
}

void draw_progress(Controls& controls, const ReferenceProgress& progress) {
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram,
                          ImGui::GetColorU32(ImGuiCol_SliderGrab)); // readable under the text
    ImGui::ProgressBar(static_cast<float>(std::clamp(progress.share(), 0.0, 1.0)), {-FLT_MIN, 0},
                       fmt::format("{} of {} spp", progress.spp, progress.spp_wanted).c_str());
    ImGui::PopStyleColor();
    controls.place("reference.progress", "Samples per pixel of both halves together.");
    const bool known = std::isfinite(progress.seconds_left);
    dim_text(progress.is_ending ? "Stops after this pass. The checkpoint is kept."
             : known            ? "About " + duration_text(progress.seconds_left) + " left."
                                : "Starting ...");
    dim_text(progress.error ? fmt::format("relMSE of the reference so far: {:.3g} +- {:.2g}",
                                          progress.error->relative_mse, progress.error->standard_error)
                            : "The error of the reference is not known yet.");
    dim_text(progress.file.string());
}

void draw_buttons(Controls& controls, ViewerState& state) {
    ReferenceMaking& making = state.reference_making;
    const float width = ImGui::GetFontSize() * 7;
    if (making.is_making()) {
        if (controls.button("reference.cancel", "Cancel",
                            "Stops rendering the reference. It can continue from its checkpoint.", width))
            state.wishes.stop_making = true;
    } else if (controls.button("reference.make", "Make",
                               "Renders the reference in the background. The panes have priority.", width)) {
        state.wishes.make_reference = state.scene != nullptr;
    }
    ImGui::SameLine();
    if (controls.button("reference.close", "Close", "Closes this dialog (Esc). Rendering continues.", width))
        making.show = false;
}

} // namespace

void draw_reference_dialog(glm::vec2 screen, Controls& controls, ViewerState& state) {
    draw_dialog("Make a reference", screen, 30, [&] {
        if (const auto& progress = state.reference_making.progress)
            draw_progress(controls, *progress);
        else
            draw_form(controls, state);
        ImGui::Spacing();
        draw_buttons(controls, state);
    });
}

namespace {

void draw_fields(Controls& controls, SampleForm& form, glm::ivec2 size) {
    constexpr int most_int = std::numeric_limits<int>::max();
    controls.number("sample.x", "Pixel x", form.pixel.x, 0, size.x - 1,
                    "Column of the pixel, from 0 at the left.");
    controls.number("sample.y", "Pixel y", form.pixel.y, 0, size.y - 1, "Row of the pixel, from 0 at the top.");
    controls.number(
        "sample.pass", "Pass", form.pass, 0, most_int,
        "Index of the pass, from 0; the pane need not have reached it. Adaptive tile splitting of a late "
        "pass is learned again from all passes before it, which can take seconds.");
    Setting seed = seed_setting(form.seed);
    seed.id = "sample.seed";
    seed.help =
        "Seed of the random numbers. Another seed restarts the active pane, and all panes if they are linked.";
    draw_setting(controls, seed);
}

void draw_sample_buttons(Controls& controls, ViewerState& state) {
    SampleForm& form = state.layout.sample_form;
    const float width = ImGui::GetFontSize() * 7;
    if (controls.button("sample.inspect", "Inspect", "Opens the sample in the path inspector.", width)) {
        state.inspect(form.pixel, form.pass, form.seed);
        form.show = false;
    }
    ImGui::SameLine();
    if (controls.button("sample.close", "Close", "Closes this dialog without a change (Esc).", width))
        form.show = false;
}

} // namespace

void draw_sample_dialog(glm::vec2 screen, Controls& controls, ViewerState& state) {
    draw_dialog("Inspect a sample", screen, 26, [&] {
        const glm::ivec2 size = state.request_size();
        draw_fields(controls, state.layout.sample_form, size);
        dim_text(fmt::format("A sample of the active pane: {}, {} x {} pixels. A sample of another render is "
                             "the same only if scene, camera, size, method and settings are the same.",
                             paper_name(state.active().settings.render.method), size.x, size.y));
        ImGui::Spacing();
        draw_sample_buttons(controls, state);
    });
}

} // namespace tessera
