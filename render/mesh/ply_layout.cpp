#include "render/mesh/ply_layout.h"

#include <algorithm>
#include <optional>

namespace tessera {

namespace {

/// What the name of a property says: which attribute it belongs to, and which of its numbers it is.
struct Part {
    std::string attribute;            // without its prefix
    std::optional<std::size_t> place; // empty: the next one, as they are counted
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

std::optional<Part> part_of(const PlyProperty& property) {
    constexpr std::string_view diffuse = "diffuse_";
    std::string_view name = property.name;
    if (property.is_list)
        return {};
    if (name.starts_with(diffuse))
        name.remove_prefix(diffuse.size());
    for (const auto& names : {words, letters})
        if (const auto place = place_among(name, names))
            return Part{"color", place, true};
    const std::size_t end = name.rfind('_');
    if (end == std::string_view::npos || end == 0 || end + 1 == name.size())
        return {};
    const std::string stem(name.substr(0, end));
    const std::string_view last = name.substr(end + 1);
    if (const auto place = place_among(last, letters))
        return Part{stem + "_color", place, true};
    if (const auto place = place_among(last, axes))
        return Part{stem, place};
    if (last.find_first_not_of("0123456789") == std::string_view::npos)
        return Part{stem, {}, stem == "color"};
    return {};
}

/// An attribute while its numbers are found.
struct Group {
    Part first;
    std::array<std::optional<std::size_t>, 3> properties; // by place
    std::size_t count = 0;
};

std::vector<PlyAttribute> attributes_of(const PlyElement& element, std::string_view prefix) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const std::optional<Part> part = part_of(element.properties[i]);
        if (!part)
            continue;
        auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const Group& g) { return g.first.attribute == part->attribute; });
        if (group == groups.end())
            group = groups.insert(group, {*part, {}, 0});
        const std::size_t place = part->place ? *part->place : group->count++;
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
