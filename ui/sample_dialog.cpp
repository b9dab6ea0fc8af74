#include "ui/buffer.h"
#include "ui/dialog.h"
#include "ui/panels.h"
#include "ui/words.h"

#include <limits>

#include <fmt/core.h>

namespace tessera {

namespace {

void draw_fields(Controls& controls, SampleForm& form, glm::ivec2 size) {
    constexpr int most_int = std::numeric_limits<int>::max();
    controls.number("sample.x", "Pixel x", form.pixel.x, 0, size.x - 1,
                    "Column of the pixel, from 0 at the left.");
    controls.number("sample.y", "Pixel y", form.pixel.y, 0, size.y - 1, "Row of the pixel, from 0 at the top.");
    controls.number("sample.pass", "Pass", form.pass, 0, most_int,
                    "From 0, whether the pane has got there or not. How tiles were cut in a late one is learnt "
                    "again from all before, which may take seconds.");
    controls.number("sample.seed", "Seed", form.seed,
                    "Of the random numbers. With another one than it has, the active pane starts anew; "
                    "so do the others, if all have the same settings.");
}

void draw_buttons(Controls& controls, ViewerState& state) {
    SampleForm& form = state.sample_form;
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
        draw_fields(controls, state.sample_form, size);
        dim_text(fmt::format(
            "Of the active pane: {}, {} x {} pixels. That of another render is the same only if scene, "
            "camera, size, method and settings are.",
            paper_name(state.active().settings.render.method), size.x, size.y));
        ImGui::Spacing();
        draw_buttons(controls, state);
    });
}

} // namespace tessera
