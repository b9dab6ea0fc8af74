#include "render/settings/setting.h"
#include "ui/gl/controls.h"

#include <string>
#include <variant>

namespace tessera {

namespace {

/// Longest range of whole numbers that has a slider; longer ones are typed.
constexpr int most_on_a_slider = 100;

struct Drawer {
    Controls& controls;
    std::string id, label, help;

    bool operator()(const Setting::Whole& n) const {
        const bool fits = n.most - n.least <= most_on_a_slider;
        return fits ? controls.slider(id.c_str(), label.c_str(), *n.value, n.least, n.most, help.c_str())
                    : controls.number(id.c_str(), label.c_str(), *n.value, n.least, n.most, help.c_str());
    }
    bool operator()(const Setting::Natural& n) const {
        return controls.number(id.c_str(), label.c_str(), *n.value, help.c_str());
    }
    bool operator()(const Setting::Real& n) const {
        return n.format
                   ? controls.slider(id.c_str(), label.c_str(), *n.value, n.low, n.high, n.format, help.c_str())
                   : controls.log_slider(id.c_str(), label.c_str(), *n.value, n.low, n.high, help.c_str());
    }
    bool operator()(const Setting::Seconds& n) const {
        return controls.number(id.c_str(), label.c_str(), *n.value, n.least, n.most, help.c_str());
    }
    bool operator()(const Setting::Switch& on) const {
        return controls.toggle(id.c_str(), label.c_str(), *on.value, help.c_str());
    }
    bool operator()(const Setting::OneOf& one) const {
        int index = one.get();
        const bool changed =
            controls.choice(id.c_str(), label.c_str(), choice_items(one.choices), index, help.c_str());
        if (changed)
            one.set(index);
        return changed;
    }
    bool operator()(const Setting::Size& size) const {
        const bool changed = controls.number("width", "Width", size.value->x, 1, size.most, "Pixels.");
        return controls.number("height", "Height", size.value->y, 1, size.most, "Pixels.") || changed;
    }
};

} // namespace

std::vector<ChoiceItem> choice_items(std::span<const SettingChoice> choices) {
    std::vector<ChoiceItem> items;
    for (const SettingChoice& c : choices)
        items.push_back({std::string(c.id), std::string(c.label), std::string(c.help)});
    return items;
}

bool draw_setting(Controls& controls, const Setting& s) {
    return std::visit(Drawer{controls, std::string(s.id), std::string(s.label), std::string(s.help)}, s.kind);
}

} // namespace tessera
