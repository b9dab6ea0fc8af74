#include "ui/chart_picture.h"

#include "ui/gl.h"
#include "ui/gui.h"
#include "ui/panels.h"
#include "ui/viewer_charts.h"

#include <algorithm>

#include <glm/common.hpp>
#include <imgui.h>

namespace tessera {

namespace {

/// In sizes of the font: so high that one plot is large, and several can be read.
glm::vec2 size_of_picture(const ViewerState& state) {
    const auto plots = static_cast<float>(viewer_chart(state).plots.size());
    const auto lines = static_cast<float>(line_colours(state).size()); // of numbers, below the plots
    const float histogram_and_text = 12;
    return {64, (plots > 0 ? std::max(24.0f, 14 * plots) : 0) + 1.5f * lines + histogram_and_text};
}

/// A frame of Dear ImGui beside the current one, with its fonts and style, current while this lives.
class SideFrame {
public:
    explicit SideFrame(glm::vec2 size) : main_(ImGui::GetCurrentContext()) {
        const ImGuiStyle style = ImGui::GetStyle();
        const ImGuiIO& look = ImGui::GetIO();
        own_ = ImGui::CreateContext(look.Fonts);
        ImGui::SetCurrentContext(own_);
        ImGui::GetStyle() = style;
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = io.LogFilename = nullptr;
        io.FontDefault = look.FontDefault;
        io.BackendFlags = look.BackendFlags; // it is drawn by the same
        io.DisplaySize = {size.x, size.y};
        ImGui::NewFrame();
    }
    ~SideFrame() {
        ImGui::SetCurrentContext(main_);
        ImGui::DestroyContext(own_);
    }
    SideFrame(const SideFrame&) = delete;
    SideFrame& operator=(const SideFrame&) = delete;

    /// Ends it, and fills the framebuffer drawn into.
    void draw() const {
        ImGui::Render();
        ImDrawData* drawn = ImGui::GetDrawData();
        ImGui::SetCurrentContext(main_); // which has the backend
        draw_over_all(*drawn);
        ImGui::SetCurrentContext(own_);
    }

private:
    ImGuiContext *main_, *own_ = nullptr;
};

} // namespace

ScreenPixels chart_picture(const ViewerState& state) {
    const glm::vec2 size = glm::ceil(ImGui::GetFontSize() * size_of_picture(state));
    const SideFrame frame(size);
    Controls untouched; // by the mouse
    draw_large_charts({glm::vec2(0), size}, untouched, state);
    Framebuffer target;
    target.resize(glm::ivec2(size));
    const DrawInto drawing(target);
    frame.draw();
    return read_screen(target.size());
}

} // namespace tessera
