#include "render/load/properties.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

void expect_tag(const XmlElement& element, std::initializer_list<std::string_view> tags) {
    if (std::find(tags.begin(), tags.end(), element.tag()) != tags.end())
        return;
    element.fail("'" + element.attribute("name") + "' must be of type <" + std::string(*tags.begin()) +
                 ">, not <" + std::string(element.tag()) + ">");
}

} // namespace

std::string snake_case(std::string_view name) {
    const auto is_upper = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; };
    std::string result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (i > 0 && is_upper(name[i]) && !is_upper(name[i - 1]) && name[i - 1] != '_')
            result += '_';
        result += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    }
    return result;
}

Properties::Properties(const XmlElement& plugin, std::vector<LoadNote>& notes)
    : element_(plugin), type_(plugin.required("type")), notes_(&notes) {
    std::unordered_map<std::string, std::size_t> places; // by name; a file may have thousands
    for (const XmlElement& child : plugin.children()) {
        if (child.tag() == "default" || child.tag() == "alias") // handled by expand_scene() and collect_ids()
            continue;
        Parameter parameter{child, snake_case(child.attribute("name"))};
        const auto [place, is_new] = places.try_emplace(parameter.name, parameters_.size());
        if (is_new || parameter.name.empty()) {
            parameters_.push_back(parameter);
        } else {
            note(child, "'" + parameter.name + "' is given twice; this value is used");
            parameters_[place->second] = parameter;
        }
    }
}

std::string Properties::name() const {
    return element_.has("id") ? element_.attribute("id") : type_;
}

bool Properties::has(std::string_view parameter) const {
    return std::any_of(parameters_.begin(), parameters_.end(),
                       [&](const Parameter& p) { return p.name == parameter; });
}

std::optional<XmlElement> Properties::take(std::string_view parameter) {
    for (Parameter& p : parameters_) {
        if (p.name != parameter)
            continue;
        p.used = true;
        return p.element;
    }
    return {};
}

float Properties::number(std::string_view parameter, float fallback) {
    const auto element = take(parameter);
    if (!element)
        return fallback;
    expect_tag(*element, {"float", "integer"});
    return element->number("value");
}

int Properties::integer(std::string_view parameter, int fallback) {
    const auto element = take(parameter);
    if (!element)
        return fallback;
    expect_tag(*element, {"integer"});
    const double value = element->number("value");
    if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
        element->fail("'" + element->attribute("value") + "' is not an integer", "value");
    return static_cast<int>(value);
}

bool Properties::boolean(std::string_view parameter, bool fallback) {
    const auto element = take(parameter);
    if (!element)
        return fallback;
    expect_tag(*element, {"boolean"});
    const std::string value = snake_case(element->required("value"));
    if (value != "true" && value != "false")
        element->fail("'" + value + "' is neither 'true' nor 'false'", "value");
    return value == "true";
}

std::string Properties::text(std::string_view parameter, const std::string& fallback) {
    const auto element = take(parameter);
    if (!element)
        return fallback;
    expect_tag(*element, {"string"});
    return element->required("value");
}

SpectrumKind Properties::spectrum_of() const {
    return element_.tag() == "emitter" ? SpectrumKind::emission : SpectrumKind::reflectance;
}

Rgb Properties::color(std::string_view parameter, Rgb fallback) {
    const auto element = take(parameter);
    return element ? read_color(*element, fallback, *notes_, spectrum_of()) : fallback;
}

glm::mat4 Properties::transform(std::string_view parameter) {
    const auto element = take(parameter);
    if (!element)
        return glm::mat4(1.0f);
    return read_transform(*element, *notes_);
}

glm::mat3 Properties::rotation(std::string_view parameter) {
    const glm::mat4 transform = Properties::transform(parameter);
    const std::optional<glm::mat3> rotation = rotation_of(transform);
    if (!rotation) {
        notes_->push_back(take(parameter)->error("the transform is flat").note("it is left out"));
        return glm::mat3(1.0f);
    }
    for (int i = 0; i < 3; ++i)
        if (glm::dot(glm::normalize(glm::vec3(transform[i])), (*rotation)[i]) < 0.9999f)
            note(*take(parameter), "only the rotation in the transform is used, not its shear");
    return *rotation;
}

glm::vec3 Properties::point(std::string_view parameter, glm::vec3 fallback) {
    const auto element = take(parameter);
    if (!element)
        return fallback;
    expect_tag(*element, {"point", "vector"});
    return read_point(*element);
}

std::vector<XmlElement> Properties::take_all(const std::function<bool(const XmlElement&)>& predicate) {
    std::vector<XmlElement> result;
    for (Parameter& p : parameters_) {
        if (p.used || !predicate(p.element))
            continue;
        p.used = true;
        result.push_back(p.element);
    }
    return result;
}

void Properties::ignore(std::initializer_list<std::string_view> parameters) {
    for (std::string_view parameter : parameters)
        take(parameter);
}

void Properties::ignore_all() {
    for (Parameter& p : parameters_)
        p.used = true;
}

void Properties::note(const XmlElement& where, const std::string& text) const {
    notes_->push_back({where.position(), text});
}

void Properties::report_unused() const {
    for (const Parameter& p : parameters_) {
        if (p.used)
            continue;
        const std::string label = p.name.empty() ? "<" + std::string(p.element.tag()) + ">" : "'" + p.name + "'";
        note(p.element, label + " of " + std::string(element_.tag()) + " '" + type_ + "' is not used");
    }
}

} // namespace tessera
