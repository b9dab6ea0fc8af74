#include "ui/gl/controls.h"

#include "ui/gl/theme.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <imgui.h>

namespace tessera {

namespace {

constexpr double tooltip_delay = 0.4;   // seconds
constexpr float label_fraction = 0.46f; // of a row's width

std::string hidden_label(const char* id) {
    return std::string("##") + id;
}

void draw_tooltip(const char* text, const std::function<void()>& draw_below) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    if (draw_below)
        draw_below();
    ImGui::EndTooltip();
}

// Clamps a typed value, and rejects "nan". Values that the user does not touch may lie outside a slider's range,
// since options and files allow more.
void keep_within(float& value, float old, float least, float most) {
    value = std::isnan(value) ? old : std::clamp(value, least, most);
}

} // namespace

void Controls::begin_frame(double time) {
    rects_.clear();
    unexplained_.clear();
    hovered_before_ = std::move(hovered_);
    hovered_.clear();
    time_ = time;
    tooltip_pending_ = false;
}

void Controls::place(const char* id, const char* help, const std::function<void()>& draw_below) {
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    rects_[id] = {{min.x, min.y}, {max.x, max.y}};
    const bool explains = help != nullptr && *help != 0;
    if (!explains)
        unexplained_.insert(id);
    if (!explains || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        return;
    hovered_ = id;
    if (hovered_ != hovered_before_)
        hovered_since_ = time_;
    const bool in_use = ImGui::IsItemActive();
    if (!in_use && time_ - hovered_since_ >= tooltip_delay)
        draw_tooltip(help, draw_below);
    else if (!in_use)
        tooltip_pending_ = true;
}

void Controls::label(const char* text) const {
    const float start = ImGui::GetCursorPosX();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, colours::dim_text);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
    ImGui::SameLine(start + std::max(width * label_fraction, 1.0f), 0);
    ImGui::SetNextItemWidth(-FLT_MIN);
}

bool Controls::choice(const char* id, const char* label_text, std::span<const ChoiceItem> items, int& index,
                      const char* help) {
    label(label_text);
    const std::string& shown = items[index].label;
    return bare_choice(id, shown.c_str(), items, index, -FLT_MIN, help);
}

bool Controls::bare_choice(const char* id, const char* shown, std::span<const ChoiceItem> items, int& index,
                           float width, const char* help) {
    ImGui::SetNextItemWidth(width);
    const bool open = ImGui::BeginCombo(hidden_label(id).c_str(), shown, ImGuiComboFlags_HeightLargest);
    bool changed = false;
    if (open) {
        for (std::size_t i = 0; i < items.size(); ++i) {
            const bool selected = static_cast<int>(i) == index;
            if (ImGui::Selectable(items[i].label.c_str(), selected)) {
                changed = !selected;
                index = static_cast<int>(i);
            }
            if (selected)
                ImGui::SetItemDefaultFocus(); // arrow keys start there
            place((std::string(id) + "/" + items[i].id).c_str(), items[i].help.c_str());
        }
        ImGui::EndCombo(); // the last item is the combo itself again
    }
    place(id, help);
    return changed;
}

/// Returns the value that a control shows: the draft while the user types into it, else the value.
template <class Value>
const Value& Controls::draft_of(const char* id, const Value& value) const {
    const Value* draft = draft_id_ == id ? std::get_if<Value>(&draft_) : nullptr;
    return draft ? *draft : value;
}

/// Stores the draft of the item just drawn. Assigns it to the value when it is complete (`at_once`, as after
/// Enter) or the item loses focus. Returns whether the value changed.
template <class Value>
bool Controls::take_draft(const char* id, const Value& draft, bool at_once, Value& value) {
    if (at_once || ImGui::IsItemDeactivatedAfterEdit()) {
        draft_id_.clear();
        return draft != std::exchange(value, draft);
    }
    if (ImGui::IsItemActive()) {
        draft_id_ = id;
        draft_ = draft;
    } else if (draft_id_ == id) {
        draft_id_.clear(); // left without a change
    }
    return false;
}

/// Assigns a slider's draft to the value: at once while it is dragged, and like a number's when it is typed (Ctrl
/// + click). Returns whether the value changed.
template <class Value>
bool Controls::took_slider(const char* id, const char* help, const Value& draft, bool changed, Value& value) {
    const bool typed = ImGui::GetIO().WantTextInput || draft_id_ == id;
    bool taken = false;
    if (typed)
        taken = take_draft(id, draft, false, value);
    else if (changed)
        taken = draft != std::exchange(value, draft);
    place(id, help);
    return taken;
}

bool Controls::slider(const char* id, const char* label_text, int& value, int least, int most, const char* help) {
    label(label_text);
    int draft = draft_of(id, value);
    const bool changed =
        ImGui::SliderInt(hidden_label(id).c_str(), &draft, least, most, "%d", ImGuiSliderFlags_AlwaysClamp);
    if (changed)
        draft = std::clamp(draft, least, most);
    return took_slider(id, help, draft, changed, value);
}

bool Controls::slider(const char* id, const char* label_text, float& value, float least, float most,
                      const char* format, const char* help) {
    label(label_text);
    float draft = draft_of(id, value);
    const bool changed =
        ImGui::SliderFloat(hidden_label(id).c_str(), &draft, least, most, format, ImGuiSliderFlags_AlwaysClamp);
    if (changed)
        keep_within(draft, value, least, most);
    return took_slider(id, help, draft, changed, value);
}

bool Controls::log_slider(const char* id, const char* label_text, float& value, float least, float most,
                          const char* help) {
    label(label_text);
    float draft = draft_of(id, value);
    const bool changed = ImGui::SliderFloat(hidden_label(id).c_str(), &draft, least, most,
                                            least == 0 && draft == 0 ? "off" : "%.3g",
                                            ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    if (changed)
        keep_within(draft, value, least, most);
    return took_slider(id, help, draft, changed, value);
}

/// Returns the ImGuiDataType of the value.
template <class Value>
constexpr int data_type() {
    if constexpr (std::is_same_v<Value, double>)
        return ImGuiDataType_Double;
    else
        return std::is_same_v<Value, int> ? ImGuiDataType_S32 : ImGuiDataType_U64;
}

template <class Value>
bool Controls::typed_number(const char* id, const char* label_text, Value& value, Value least, Value most,
                            const char* help) {
    constexpr bool is_real = std::is_floating_point_v<Value>;
    label(label_text);
    Value draft = draft_of(id, value);
    const Value step = 1, large_step = is_real ? 10 : 16;
    const bool changed =
        ImGui::InputScalar(hidden_label(id).c_str(), data_type<Value>(), &draft, &step, &large_step,
                           is_real ? "%.6g" : nullptr, is_real ? ImGuiInputTextFlags_CharsScientific : 0);
    const bool stepped = changed && !ImGui::GetIO().WantTextInput;   // with its buttons
    draft = draft == draft ? std::clamp(draft, least, most) : value; // the user can type "nan"
    const bool taken = take_draft(id, draft, stepped, value);
    place(id, help);
    return taken;
}

bool Controls::number(const char* id, const char* label_text, int& value, int least, int most, const char* help) {
    return typed_number(id, label_text, value, least, most, help);
}

bool Controls::number(const char* id, const char* label_text, double& value, double least, double most,
                      const char* help) {
    return typed_number(id, label_text, value, least, most, help);
}

bool Controls::number(const char* id, const char* label_text, std::uint64_t& value, const char* help) {
    constexpr std::uint64_t least = 0, most = std::numeric_limits<std::uint64_t>::max();
    return typed_number(id, label_text, value, least, most, help);
}

bool Controls::text(const char* id, const char* label_text, std::string& value, const char* hint,
                    const char* help) {
    label(label_text);
    char buffer[1024] = {};
    draft_of(id, value).copy(buffer, sizeof buffer - 1);
    ImGui::InputTextWithHint(hidden_label(id).c_str(), hint, buffer, sizeof buffer);
    const bool taken = take_draft(id, std::string(buffer), false, value);
    place(id, help);
    return taken;
}

bool Controls::toggle(const char* id, const char* label_text, bool& value, const char* help) {
    label(label_text);
    const bool changed = ImGui::Checkbox(hidden_label(id).c_str(), &value);
    place(id, help);
    return changed;
}

bool Controls::button(const char* id, const char* label_text, const char* help, float width) {
    const bool pressed = ImGui::Button((std::string(label_text) + "##" + id).c_str(), {width, 0});
    place(id, help);
    return pressed;
}

void heading(const char* text) {
    ImGui::Spacing();
    ImGui::PushFont(bold_font());
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const float y = std::floor((min.y + max.y) * 0.5f);
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    ImGui::GetWindowDrawList()->AddLine({max.x + ImGui::GetFontSize() * 0.5f, y}, {right, y}, colours::line);
}

void draw_dialog(const char* title, glm::vec2 screen, float width, const std::function<void()>& draw) {
    const float font = ImGui::GetFontSize();
    const glm::vec2 size(std::min(screen.x, font * width), 0); // height 0: as high as its content
    ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.5f}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetColorU32(ImGuiCol_PopupBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, font * 0.5f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    if (ImGui::Begin(title, nullptr, overlay_flags & ~ImGuiWindowFlags_NoMove)) {
        heading(title);
        draw();
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

void dim_text(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colours::dim_text);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

} // namespace tessera
