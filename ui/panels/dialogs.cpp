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
            "Path tracing: slow, and free of what tiles have in common.", "Path reusing in tiles of 8 pixels.",
            "Gradients of neighbours, reconstructed by L2, or as sampled where that is nearer.",
            "Gradients of tiles of 8 pixels, reconstructed by L2, or as sampled where that is nearer: the "
            "quickest on most scenes."};
        std::vector<ChoiceItem> list;
        for (Method method : all_methods)
            list.push_back({std::string(short_name(method)), std::string(paper_name(method)),
                            helps[static_cast<std::size_t>(method)]});
        return list;
    }();
    int index = static_cast<int>(making.method);
    if (controls.choice("reference.method", "Method", methods, index, "What renders the reference."))
        making.method = all_methods[index];
}

void draw_file(Controls& controls, ViewerState& state) {
    ReferenceMaking& making = state.reference_making;
    const std::string hint = default_reference_file(state).filename().string();
    controls.label("File");
    ImGui::InputTextWithHint("##reference.file", hint.c_str(), making.file.data(), making.file.size());
    controls.place("reference.file",
                   "EXR file to write; by itself one in the current folder, named after the scene, "
                   "its size and depth, and the camera unless it is the scene's.");
}

void draw_notes(Controls& controls, ViewerState& state) {
    const glm::ivec2 size = state.request_size();
    const auto seconds = estimated_seconds(state);
    dim_text(fmt::format("{} x {} pixels, depth {}, the camera of the panes. {}", size.x, size.y,
                         state.active().settings.render.max_depth,
                         seconds ? "About " + duration_text(*seconds) +
                                       " if nothing else is rendered: the panes go first."
                                 : "How long it takes is known once a pane has a picture."));
    std::error_code ignored;
    const std::filesystem::path file = wanted_reference_file(state);
    if (std::filesystem::exists(file, ignored))
        dim_text("There is such a file already: it will be replaced.");
    if (!std::filesystem::exists(reference_checkpoint(file), ignored))
        return;
    dim_text("It was begun before, and goes on from its checkpoint.");
    controls.toggle("reference.anew", "Begin anew", state.reference_making.anew, "Forgets the checkpoint.");
}

void draw_form(Controls& controls, ViewerState& state) {
    ReferenceMaking& making = state.reference_making;
    draw_method(controls, making);
    Setting spp = spp_setting(making.spp, 2);
    spp.id = "reference.spp";
    spp.help =
        "Of two independent halves together: their difference tells how far the reference is from the truth.";
    draw_setting(controls, spp);
    draw_file(controls, state);
    draw_notes(controls, state);
}

void draw_progress(Controls& controls, const ReferenceProgress& progress) {
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, ImGui::GetColorU32(ImGuiCol_SliderGrab)); // text crosses it
    ImGui::ProgressBar(static_cast<float>(std::clamp(progress.share(), 0.0, 1.0)), {-FLT_MIN, 0},
                       fmt::format("{} of {} spp", progress.spp, progress.spp_wanted).c_str());
    ImGui::PopStyleColor();
    controls.place("reference.progress", "Samples a pixel of both halves.");
    const bool known = std::isfinite(progress.seconds_left);
    dim_text(progress.is_ending ? "Ending after this pass; the checkpoint is kept."
             : known            ? "About " + duration_text(progress.seconds_left) + " left."
                                : "Beginning ...");
    dim_text(progress.error ? fmt::format("Its own relMSE so far: {:.3g} +- {:.2g}", progress.error->relative_mse,
                                          progress.error->standard_error)
                            : "Its own error is not known yet.");
    dim_text(progress.file.string());
}

void draw_buttons(Controls& controls, ViewerState& state) {
    ReferenceMaking& making = state.reference_making;
    const float width = ImGui::GetFontSize() * 7;
    if (making.is_making()) {
        if (controls.button("reference.cancel", "Cancel", "Ends it; made again, it goes on from there.", width))
            state.wishes.stop_making = true;
    } else if (controls.button("reference.make", "Make", "Renders it in the background; the panes go first.",
                               width)) {
        state.wishes.make_reference = state.scene != nullptr;
    }
    ImGui::SameLine();
    if (controls.button("reference.close", "Close", "Closes this window; what is being made goes on (Esc).",
                        width))
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
    controls.number("sample.pass", "Pass", form.pass, 0, most_int,
                    "From 0, whether the pane has got there or not. How tiles were cut in a late one is learnt "
                    "again from all before, which may take seconds.");
    Setting seed = seed_setting(form.seed);
    seed.id = "sample.seed";
    seed.help =
        "Of the random numbers. With another one than it has, the active pane starts anew; so do the others, "
        "if all have the same settings.";
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
    if (controls.button("sample.close", "Close", "Leaves everything as it is (Esc).", width))
        form.show = false;
}

} // namespace

void draw_sample_dialog(glm::vec2 screen, Controls& controls, ViewerState& state) {
    draw_dialog("Inspect a sample", screen, 26, [&] {
        const glm::ivec2 size = state.request_size();
        draw_fields(controls, state.layout.sample_form, size);
        dim_text(fmt::format(
            "Of the active pane: {}, {} x {} pixels. That of another render is the same only if scene, "
            "camera, size, method and settings are.",
            paper_name(state.active().settings.render.method), size.x, size.y));
        ImGui::Spacing();
        draw_sample_buttons(controls, state);
    });
}

} // namespace tessera
