#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

struct Setting;
struct SettingChoice;

/// Flags of a window beside the pictures, which is fixed and scrolls.
inline constexpr ImGuiWindowFlags side_panel_flags =
    (ImGuiWindowFlags_NoDecoration ^ ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav;

/// Flags of a window over the pictures.
inline constexpr ImGuiWindowFlags overlay_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                                  ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;

/// Rectangle in which a control was drawn, in screen units.
struct ControlRect {
    glm::vec2 min{0};
    glm::vec2 max{0};
    glm::vec2 center() const { return (min + max) * 0.5f; }
    bool operator==(const ControlRect&) const = default;
};

/// One entry of a choice.
struct ChoiceItem {
    std::string id;    ///< unique in the choice
    std::string label; ///< as listed
    std::string help;
};

/// Widgets of the viewer. Each has an id and a tooltip, and a labelled row of its own unless said otherwise. Each
/// returns whether its value changed. Rectangles are recorded by id, so that tests and scripts can point at
/// widgets.
class Controls {
public:
    /// @param time  in seconds
    void begin_frame(double time);

    /// A list as wide as the row. Its items are recorded as "id/item id" while the list is open.
    bool choice(const char* id, const char* label, std::span<const ChoiceItem> items, int& index,
                const char* help);
    /// A list of a given width without a label. Closed, it shows `shown` and not the chosen item's label.
    bool bare_choice(const char* id, const char* shown, std::span<const ChoiceItem> items, int& index, float width,
                     const char* help);
    bool slider(const char* id, const char* label, int& value, int least, int most, const char* help);
    bool slider(const char* id, const char* label, float& value, float least, float most, const char* format,
                const char* help);
    /// A slider on a logarithmic scale. If `least` is 0, the left end is 0 and shows "off".
    bool log_slider(const char* id, const char* label, float& value, float least, float most, const char* help);
    /// A number to type. The value changes with Enter, or when the control loses focus.
    bool number(const char* id, const char* label, int& value, int least, int most, const char* help);
    bool number(const char* id, const char* label, double& value, double least, double most, const char* help);
    bool number(const char* id, const char* label, std::uint64_t& value, const char* help);
    /// Text to type, taken over as numbers are. Empty text shows `hint`.
    bool text(const char* id, const char* label, std::string& value, const char* hint, const char* help);
    bool toggle(const char* id, const char* label, bool& value, const char* help);
    /// A button, without a row of its own, as wide as its label or `width`.
    bool button(const char* id, const char* label, const char* help, float width = 0);

    /// Draws a row's label for another widget, which then fills the row.
    void label(const char* text) const;
    /// Records the rectangle of the item just drawn, and shows `help` as its tooltip, with what `draw_below` draws
    /// below the text. An item without help must explain itself, as a menu does.
    void place(const char* id, const char* help, const std::function<void()>& draw_below = {});

    /// Records the rectangle of an area that is no item, without a tooltip.
    void place_rect(const char* id, glm::vec2 min, glm::vec2 max) { rects_[id] = {min, max}; }

    /// Returns the ids of items without help in this frame.
    const std::set<std::string, std::less<>>& unexplained() const { return unexplained_; }

    /// Returns the rectangles of this frame's controls so far, or of the last complete frame, by id.
    const std::map<std::string, ControlRect, std::less<>>& rects() const { return rects_; }

    /// Returns whether a tooltip is about to appear, so that a frame is due soon without input.
    bool tooltip_pending() const { return tooltip_pending_; }

private:
    template <class Value>
    const Value& draft_of(const char* id, const Value& value) const;
    template <class Value>
    bool take_draft(const char* id, const Value& draft, bool at_once, Value& value);
    template <class Value>
    bool took_slider(const char* id, const char* help, const Value& draft, bool changed, Value& value);
    template <class Value>
    bool typed_number(const char* id, const char* label, Value& value, Value least, Value most, const char* help);

    std::map<std::string, ControlRect, std::less<>> rects_;
    std::string hovered_;
    std::string hovered_before_;
    double hovered_since_ = 0;
    double time_ = 0;
    bool tooltip_pending_ = false;
    std::set<std::string, std::less<>> unexplained_;

    // Value being typed, which replaces the control's value when it is complete.
    std::string draft_id_;
    std::variant<int, float, double, std::uint64_t, std::string> draft_;
};

/// Draws a heading with a line in a panel.
void heading(const char* text);

/// Draws a window over everything, centred at first, and as high as the content that `draw` draws.
/// @param width  in font heights
void draw_dialog(const char* title, glm::vec2 screen, float width, const std::function<void()>& draw);

/// Draws a dimmed paragraph, for explanations.
void dim_text(const std::string& text);

/// Converts choices of the settings table to items of a control.
std::vector<ChoiceItem> choice_items(std::span<const SettingChoice> choices);

/// Draws the control of a setting, with its id, label, limits and help: a slider, a number to type for ranges that
/// are too long for a slider, a switch, or a list. A size has two controls, "width" and "height". Returns whether
/// it changed the value.
bool draw_setting(Controls& controls, const Setting& setting);

} // namespace tessera
