#include "ui/pane_view.h"

#include "ui/imgui_version.h"
#include "ui/legend.h"
#include "ui/mouse.h"
#include "ui/theme.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <imgui.h>

namespace tessera {

namespace {

const std::vector<ChoiceItem>& method_items() {
    static const std::vector<ChoiceItem> items = [] {
        std::vector<ChoiceItem> list;
        for (Method method : all_methods)
            list.push_back({std::string(short_name(method)),
                            std::string(paper_name(method)) + "   " + std::string(long_name(method)), ""});
        return list;
    }();
    return items;
}

const std::vector<ChoiceItem>& buffer_items() {
    static const std::vector<ChoiceItem> items = {
        {"reconstruction", "Reconstruction", "The picture made from primal and gradients."},
        {"primal", "Primal", "The picture as measured, before any reconstruction."},
        {"dx", "Gradient dx",
         "Right neighbour minus pixel, luminance: orange above zero, blue below. Measured by G-PT and G-PR."},
        {"dy", "Gradient dy",
         "Pixel below minus pixel, luminance: orange above zero, blue below. Measured by G-PT and G-PR."},
        {"reused", "Reuse count",
         "How many base paths of other pixels brought light to a pixel, the mean of all passes. Not for PT."},
        {"failed", "Failed shifts",
         "Which share of the base paths that were shifted to a pixel brought it no light. Not for PT."},
    };
    return items;
}

constexpr ImGuiWindowFlags pane_flags =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav |
    ImGuiWindowFlags_NoBackground; // Gui clears the screen in the panels' colour

PaneMouse read_mouse(ImVec2 pane_min, float pixels_a_unit) {
    const ImGuiIO& io = ImGui::GetIO();
    PaneMouse mouse;
    const auto in_pane = [&](ImVec2 p) { return glm::vec2(p.x - pane_min.x, p.y - pane_min.y) * pixels_a_unit; };
    mouse.position = in_pane(io.MousePos);
    mouse.previous = in_pane({io.MousePos.x - io.MouseDelta.x, io.MousePos.y - io.MouseDelta.y});
    const bool active = ImGui::IsItemActive();
    mouse.left = active && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    mouse.middle = active && ImGui::IsMouseDown(ImGuiMouseButton_Middle);
    mouse.right = active && ImGui::IsMouseDown(ImGuiMouseButton_Right);
    mouse.wheel = ImGui::IsItemHovered() ? io.MouseWheel : 0.0f;
    mouse.ctrl = io.KeyCtrl;
    mouse.shift = io.KeyShift;
    return mouse;
}

// Words in the middle of a pane that has no picture.
void draw_notice(ImVec2 min, ImVec2 max, const char* text) {
    const ImVec2 size = ImGui::CalcTextSize(text);
    ImGui::GetWindowDrawList()->AddText({(min.x + max.x - size.x) * 0.5f, (min.y + max.y - size.y) * 0.5f},
                                        colours::dim_text, text);
}

std::string notice(const PaneState& pane) {
    const Method method = pane.settings.render.method;
    const ColourMap map = colour_map(pane.settings.buffer);
    if (map == ColourMap::signed_difference && !has_gradients(method))
        return std::string(paper_name(method)) + " measures no gradients";
    if (map == ColourMap::false_colour && method == Method::pt)
        return std::string(paper_name(method)) + " shares no paths between pixels";
    return "";
}

} // namespace

void PaneView::upload(const PaneState& pane) {
    static const RgbImage no_picture;
    const Buffer buffer = pane.settings.buffer;
    std::shared_ptr<const void> source = pane.snapshot ? picture_source(*pane.snapshot, buffer) : nullptr;
    if (source == shown_ && buffer == shown_buffer_)
        return;
    shown_ = std::move(source);
    shown_buffer_ = buffer;
    const RgbImage& image = pane.snapshot ? picture(*pane.snapshot, buffer, scratch_) : no_picture;
    canvas_.show(image);
    top_ = colour_map(buffer) == ColourMap::false_colour ? top_value(buffer, image) : 1;
    ++uploads_;
}

void PaneView::draw_header(const std::string& id, Controls& controls, PaneState& pane) {
    const float font = ImGui::GetFontSize();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + font * 0.35f, corner.y + height},
                                              method_colour(pane.settings.render.method), font * 0.15f);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + font * 0.7f);

    const float room = ImGui::GetContentRegionAvail().x;
    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    const float method_width = std::max(std::min(font * 19, (room - spacing) * 0.58f), 1.0f);
    const float buffer_width = std::max(std::min(font * 11, room - spacing - method_width), 1.0f);
    int method = static_cast<int>(pane.settings.render.method);
    if (controls.bare_choice((id + ".method").c_str(),
                             method_items()[static_cast<std::size_t>(method)].label.c_str(), method_items(),
                             method, method_width, "How this pane's light paths are sampled (M)."))
        pane.settings.render.method = all_methods[method];
    ImGui::SameLine();
    int buffer = static_cast<int>(pane.settings.buffer);
    if (controls.bare_choice((id + ".buffer").c_str(),
                             buffer_items()[static_cast<std::size_t>(buffer)].label.c_str(), buffer_items(),
                             buffer, buffer_width, "What this pane shows (1 to 6: all panes)."))
        pane.settings.buffer = all_buffers[buffer];
}

void PaneView::draw_picture(int index, const std::string& id, const CanvasShader& shader, Controls& controls,
                            ViewerState& state) {
    PaneState& pane = state.panes[static_cast<std::size_t>(index)];
    const float pixels_a_unit = ImGui::GetIO().DisplayFramebufferScale.x;
    const ImVec2 min = ImGui::GetCursorScreenPos();
    const float status_height = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().ItemSpacing.y;
    const ImVec2 avail = ImGui::GetContentRegionAvail();
    const ImVec2 size(std::max(std::floor(avail.x), 1.0f), std::max(std::floor(avail.y - status_height), 1.0f));
    const ImVec2 max(min.x + size.x, min.y + size.y);
    const glm::ivec2 pixels = glm::max(glm::ivec2(glm::vec2(size.x, size.y) * pixels_a_unit), glm::ivec2(1));
    pane.canvas_size = pixels;

    ImGui::InvisibleButton((id + ".picture").c_str(), size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle |
                               ImGuiButtonFlags_MouseButtonRight);
    controls.note((id + ".picture").c_str(), nullptr);
    if (ImGui::IsItemActivated())
        state.active_pane = index;
    const glm::ivec2 image_size = state.request_size();
    apply_mouse(read_mouse(min, pixels_a_unit), state.view.place(image_size, pixels), image_size, pixels, state);

    upload(pane);
    const Placement placement = state.view.place(image_size, pixels);
    CanvasView view{pixels,
                    placement.origin,
                    placement.extent,
                    colour_map(pane.settings.buffer),
                    state.exposure,
                    pane.snapshot && pane.snapshot->coarse,
                    top_};
    ImGui::GetWindowDrawList()->AddImage(texture_id(canvas_.draw(shader, view)), min, max, {0, 1}, {1, 0});
    if (index == state.active_pane && !state.linked)
        ImGui::GetWindowDrawList()->AddRect(min, max, colours::accent);
    if (const std::string text = notice(pane); !text.empty())
        draw_notice(min, max, text.c_str());
    else if (colour_map(pane.settings.buffer) == ColourMap::false_colour && !canvas_.empty())
        draw_legend({{min.x, min.y}, {max.x, max.y}}, id + ".legend", pane.settings.buffer, top_, controls);
}

void PaneView::draw(int index, const ScreenRect& where, const CanvasShader& shader, Controls& controls,
                    ViewerState& state) {
    const std::string id = "pane" + std::to_string(index);
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    const float pad = std::floor(ImGui::GetFontSize() * 0.3f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, pad});
    ImGui::Begin(id.c_str(), nullptr, pane_flags);
    ImGui::PopStyleVar();
    PaneState& pane = state.panes[static_cast<std::size_t>(index)];
    draw_header(id, controls, pane);
    draw_picture(index, id, shader, controls, state);
    const std::string status = status_text(pane, state.paused, state.spp_limit);
    ImGui::TextDisabled("%s", status.c_str());
    controls.note((id + ".status").c_str(), status.c_str()); // a narrow pane cuts it off
    ImGui::End();
}

std::string status_text(const PaneState& pane, bool paused, int spp_limit) {
    const std::string method(paper_name(pane.settings.render.method));
    if (!pane.snapshot || pane.snapshot->generation != pane.generation)
        return method + (paused ? "   paused" : "   starting");
    const Snapshot& snapshot = *pane.snapshot;
    const double rate =
        snapshot.seconds > 0 ? static_cast<double>(snapshot.counters.all_rays()) / snapshot.seconds : 0;
    char text[160];
    std::snprintf(text, sizeof text, "%s   %d spp   %.2f s   %.1f Mrays/s", method.c_str(), snapshot.spp,
                  snapshot.seconds, rate * 1e-6);
    std::string line = text;
    if (snapshot.coarse)
        line += "   first look";
    else if (snapshot.reconstruction && has_gradients(snapshot.settings.method))
        line += "   reconstruction of pass " + std::to_string(snapshot.reconstruction_spp);
    if (snapshot.counters.refused_samples > 0)
        line += "   " + std::to_string(snapshot.counters.refused_samples) + " samples refused";
    if (paused)
        line += "   paused";
    else if (spp_limit > 0 && snapshot.spp >= spp_limit)
        line += "   done";
    return line;
}

} // namespace tessera
