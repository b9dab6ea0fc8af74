#include "render/mesh/ply_layout.h"

#include <algorithm>
#include <optional>

namespace tessera {

namespace {

/// Meaning of a property's name: its attribute, and its component of that attribute.
struct Component {
    std::string attribute;            // without its prefix
    std::optional<std::size_t> place; // 0 to 2; empty: named by a number, next in file order
    bool is_color = false;
};

std::optional<std::size_t> place_among(std::string_view name, const std::array<std::string_view, 3>& names) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        return {};
    return static_cast<std::size_t>(found - names.begin());
}

constexpr std::array<std::string_view, 3> words = {"red", "green", "blue"}, letters = {"r", "g", "b"},
                                          axes = {"x", "y", "z"};

std::optional<Component> component_of(const PlyProperty& property) {
    constexpr std::string_view diffuse = "diffuse_";
    std::string_view name = property.name;
    if (property.is_list)
        return {};
    if (name.starts_with(diffuse))
        name.remove_prefix(diffuse.size());
    for (const auto& names : {words, letters})
        if (const auto place = place_among(name, names))
            return Component{"color", place, true};
    const std::size_t end = name.rfind('_');
    if (end == std::string_view::npos || end == 0 || end + 1 == name.size())
        return {};
    const std::string stem(name.substr(0, end));
    const std::string_view last = name.substr(end + 1);
    if (const auto place = place_among(last, letters))
        return Component{stem + "_color", place, true};
    if (const auto place = place_among(last, axes))
        return Component{stem, place};
    if (last.find_first_not_of("0123456789") == std::string_view::npos)
        return Component{stem, {}, stem == "color"};
    return {};
}

/// An attribute whose components are being collected.
struct Group {
    Component first;
    std::array<std::optional<std::size_t>, 3> properties; // by component
    std::size_t count = 0;                                // components named by a number
};

std::vector<PlyAttribute> attributes_of(const PlyElement& element, std::string_view prefix) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const std::optional<Component> component = component_of(element.properties[i]);
        if (!component)
            continue;
        auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const Group& g) { return g.first.attribute == component->attribute; });
        if (group == groups.end())
            group = groups.insert(group, {*component, {}, 0});
        const std::size_t place = component->place ? *component->place : group->count++;
        if (place < 3)
            group->properties[place] = i;
    }
    std::vector<PlyAttribute> attributes;
    for (const Group& group : groups) {
        const auto& [x, y, z] = group.properties;
        const std::string name = std::string(prefix) + group.first.attribute;
        if (x && y && z)
            attributes.push_back({name, {*x, *y, *z}, group.first.is_color});
        else if (x && group.count == 1)
            attributes.push_back({name, {*x, *x, *x}, group.first.is_color});
    }
    return attributes;
}

using Slot = PlyLayout::Slot;

std::optional<Slot> slot_of(const PlyProperty& property) {
    struct Name {
        std::string_view name;
        Slot slot;
    };
    static constexpr Name names[] = {
        {"x", Slot::x},   {"y", Slot::y},   {"z", Slot::z},         {"nx", Slot::nx},
        {"ny", Slot::ny}, {"nz", Slot::nz}, {"u", Slot::u},         {"v", Slot::v},
        {"s", Slot::u},   {"t", Slot::v},   {"texture_u", Slot::u}, {"texture_v", Slot::v},
    };
    for (const Name& known : names)
        if (!property.is_list && known.name == property.name)
            return known.slot;
    return {};
}

} // namespace

PlyLayout::PlyLayout(const PlyElement& element, std::string_view prefix)
    : attributes_(attributes_of(element, prefix)), is_used_(element.properties.size()) {
    for (const PlyAttribute& attribute : attributes_)
        for (const std::size_t property : attribute.properties)
            is_used_[property] = true;
    if (element.name != "vertex")
        return;
    for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (const std::optional<Slot> known = slot_of(element.properties[i])) {
            places_[static_cast<std::size_t>(*known)] = i;
            is_used_[i] = true;
        }
}

bool PlyLayout::has(std::initializer_list<Slot> slots) const {
    return std::all_of(slots.begin(), slots.end(), [&](Slot slot) { return place(slot).has_value(); });
}

} // namespace tessera
