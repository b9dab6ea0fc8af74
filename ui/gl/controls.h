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

/// For a window beside the pictures: it stays where it is, and scrolls.
inline constexpr ImGuiWindowFlags side_panel_flags =
    (ImGuiWindowFlags_NoDecoration ^ ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav;

/// For a window over the pictures.
inline constexpr ImGuiWindowFlags overlay_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                                  ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;

/// Where a control was drawn, in screen units.
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

/// The widgets of the viewer: each has an id, a tooltip, and a row of its own with a label unless said otherwise,
/// and tells whether it changed its value. Notes where each was drawn, so that tests and scripts can point at it
/// by id.
class Controls {
public:
    /// `time` in seconds.
    void begin_frame(double time);

    /// A choice is as wide as the row; its items are noted as "id/item id" while the list is open.
    bool choice(const char* id, const char* label, std::span<const ChoiceItem> items, int& index,
                const char* help);
    /// A choice of a given width and without a label, showing `shown` instead of the item's label.
    bool bare_choice(const char* id, const char* shown, std::span<const ChoiceItem> items, int& index, float width,
                     const char* help);
    bool slider(const char* id, const char* label, int& value, int least, int most, const char* help);
    bool slider(const char* id, const char* label, float& value, float least, float most, const char* format,
                const char* help);
    /// A slider on a logarithmic scale. If `least` is 0, the left end is 0 and reads "off".
    bool log_slider(const char* id, const char* label, float& value, float least, float most, const char* help);
    /// What is typed is taken with Enter, and when the control is left.
    bool number(const char* id, const char* label, int& value, int least, int most, const char* help);
    bool number(const char* id, const char* label, double& value, double least, double most, const char* help);
    bool number(const char* id, const char* label, std::uint64_t& value, const char* help);
    /// What is typed is taken as a number's is; empty text shows `hint`.
    bool text(const char* id, const char* label, std::string& value, const char* hint, const char* help);
    bool toggle(const char* id, const char* label, bool& value, const char* help);
    /// A button has no row of its own: it is as wide as its label, or `width`.
    bool button(const char* id, const char* label, const char* help, float width = 0);

    /// A row's label, for what is drawn without these widgets: the item after it fills the row.
    void label(const char* text) const;
    /// Says where the item just drawn is, and explains it: for what is drawn without these widgets. Without help
    /// only what explains itself, such as a menu.
    void place(const char* id, const char* help);

    /// Says where an area is that is no item, without explaining it.
    void place_rect(const char* id, glm::vec2 min, glm::vec2 max) { rects_[id] = {min, max}; }

    /// Ids of what has been placed without help since the last frame began.
    const std::set<std::string, std::less<>>& unexplained() const { return unexplained_; }

    /// Where controls lie, by id, in this frame or the last whole one.
    const std::map<std::string, ControlRect, std::less<>>& rects() const { return rects_; }

    /// Whether a tooltip is about to appear, so that a frame is due soon though nothing happens.
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

    // What is being typed: the value itself changes when that is taken.
    std::string draft_id_;
    std::variant<int, float, double, std::uint64_t, std::string> draft_;
};

/// A heading in a panel, with a line.
void heading(const char* text);

/// A window over everything, in the middle of the screen until it is moved, as high as what `draw` draws in it.
/// @param width  in heights of a line
void draw_dialog(const char* title, glm::vec2 screen, float width, const std::function<void()>& draw);

/// A paragraph of less weight than what it explains.
void dim_text(const std::string& text);

/// Choices of the table of settings, as items of a control.
std::vector<ChoiceItem> choice_items(std::span<const SettingChoice> choices);

/// The control that fits the setting, with its id, label, limits and help: a slider, or a number to type where a
/// slider could not point at each, a switch, a list. Of a size there are two, "width" and "height". Returns
/// whether it changed the value.
bool draw_setting(Controls& controls, const Setting& setting);

} // namespace tessera
