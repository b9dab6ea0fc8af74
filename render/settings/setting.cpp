#include "render/settings/setting.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <system_error>
#include <type_traits>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

template <class... Functions>
struct Cases : Functions... {
    using Functions::operator()...;
};

/// Parses the whole text as a number. Empty: it is none, or it is outside the limits.
template <class Number>
std::optional<Number> parsed(std::string_view text, Number least, Number most) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end || !(value >= least && value <= most))
        return {};
    return value;
}

/// Sets `value` if the text is a number within the limits, and returns whether it is.
template <class Number>
bool parse_into(std::string_view text, Number least, Number most, Number& value) {
    const std::optional<Number> number = parsed(text, least, most);
    value = number.value_or(value);
    return number.has_value();
}

bool parse_size_into(std::string_view text, const Setting::Size& size) {
    const std::size_t x = text.find('x');
    if (x == text.npos)
        return false;
    const std::optional<int> width = parsed(text.substr(0, x), 1, size.most),
                             height = parsed(text.substr(x + 1), 1, size.most);
    if (width && height)
        *size.value = {*width, *height};
    return width && height;
}

bool parse_switch_into(std::string_view text, bool& value) {
    if (text != "on" && text != "off")
        return false;
    value = text == "on";
    return true;
}

bool parse_choice_into(std::string_view text, const Setting::OneOf& one) {
    const auto found = std::ranges::find(one.choices, text, &SettingChoice::id);
    if (found == one.choices.end())
        return false;
    one.set(static_cast<int>(found - one.choices.begin()));
    return true;
}

} // namespace

std::string ids_of(std::span<const SettingChoice> choices) {
    std::string ids;
    for (const SettingChoice& choice : choices)
        ids += fmt::format("{}{}", ids.empty() ? "" : ", ", choice.id);
    return ids;
}

Setting setting_named(std::span<const Setting> settings, std::string_view id) {
    std::string wanted(id), all;
    std::ranges::replace(wanted, '-', '_');
    for (const Setting& setting : settings) {
        if (setting.id == wanted)
            return setting;
        all += fmt::format("{}{}", all.empty() ? "" : ", ", setting.id);
    }
    throw std::invalid_argument(fmt::format("there is no setting \"{}\", only: {}", id, all));
}

std::string Setting::text() const {
    return std::visit(Cases{[](const Switch& on) { return std::string(*on.value ? "on" : "off"); },
                            [](const OneOf& one) { return std::string(one.choices[one.get()].id); },
                            [](const Size& size) { return fmt::format("{}x{}", size.value->x, size.value->y); },
                            [](const auto& number) { return fmt::format("{}", *number.value); }},
                      kind);
}

void Setting::set_text(std::string_view text) const {
    const bool is_valid = std::visit(
        Cases{[&](const Natural& n) { return parse_into(text, std::uint64_t{0}, ~std::uint64_t{0}, *n.value); },
              [&](const Switch& on) { return parse_switch_into(text, *on.value); },
              [&](const OneOf& one) { return parse_choice_into(text, one); },
              [&](const Size& size) { return parse_size_into(text, size); },
              [&](const auto& n) { return parse_into(text, n.least, n.most, *n.value); }},
        kind);
    if (!is_valid)
        throw std::invalid_argument(fmt::format("{} is \"{}\": must be {}", id, text, allowed()));
}

std::string Setting::allowed() const {
    return std::visit(
        Cases{[](const Whole& n) { return fmt::format("a whole number from {} to {}", n.least, n.most); },
              [](const Natural&) { return std::string("a whole number from 0"); },
              [](const Switch&) { return std::string("on or off"); },
              [](const OneOf& one) { return "one of " + ids_of(one.choices); },
              [](const Size& size) {
                  return fmt::format("WIDTHxHEIGHT, such as 640x360, each from 1 to {} pixels", size.most);
              },
              [](const auto& n) { return fmt::format("a number from {:g} to {:g}", n.least, n.most); }},
        kind);
}

bool Setting::is_allowed() const {
    const auto lies_in = [](auto value, auto least, auto most) { return value >= least && value <= most; };
    return std::visit(
        Cases{[](const Natural&) { return true; }, [](const Switch&) { return true; },
              [&](const OneOf& one) { return lies_in(one.get(), 0, static_cast<int>(one.choices.size()) - 1); },
              [&](const Size& size) {
                  return lies_in(size.value->x, 1, size.most) && lies_in(size.value->y, 1, size.most);
              },
              [&](const auto& n) { return lies_in(*n.value, n.least, n.most); }},
        kind);
}

std::optional<double> Setting::number() const {
    using Number = std::optional<double>;
    return std::visit(Cases{[](const Switch&) { return Number(); }, [](const OneOf&) { return Number(); },
                            [](const Size& size) { return Number(double(size.value->x) * size.value->y); },
                            [](const auto& n) { return Number(static_cast<double>(*n.value)); }},
                      kind);
}

nlohmann::json Setting::json_value() const {
    return std::visit(Cases{[&](const OneOf&) { return nlohmann::json(text()); },
                            [&](const Size&) { return nlohmann::json(text()); },
                            [](const auto& n) { return nlohmann::json(*n.value); }},
                      kind);
}

} // namespace tessera
