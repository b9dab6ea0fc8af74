#include "app/option_values.h"

#include "app/exit_codes.h"
#include "ui/inspector.h"

#include <charconv>
#include <cstdio>
#include <optional>

#include <CLI/StringTools.hpp>
#include <fmt/core.h>

namespace tessera {

glm::ivec2 parse_size(const std::string& option, const std::string& text) {
    int w = 0, h = 0, used = 0;
    if (std::sscanf(text.c_str(), "%dx%d%n", &w, &h, &used) != 2 || used != static_cast<int>(text.size()))
        throw BadInput(fmt::format("{} {}: must be WIDTHxHEIGHT, such as 640x360", option, text));
    if (w < 1 || h < 1 || w > 32768 || h > 32768)
        throw BadInput(fmt::format("{} {}: width and height must be from 1 to 32768", option, text));
    return {w, h};
}

SceneVariables parse_variables(const std::vector<std::string>& definitions) {
    SceneVariables variables;
    for (const std::string& d : definitions) {
        const std::size_t equals = d.find('=');
        if (equals == std::string::npos || equals == 0)
            throw BadInput(fmt::format("-D {}: must be name=value", d));
        variables[d.substr(0, equals)] = d.substr(equals + 1);
    }
    return variables;
}

namespace {

/// Values with commas between them, each by `from_name`, which returns an optional.
template <class FromName>
auto parse_list(const std::string& option, const std::string& text, const char* known, FromName from_name) {
    std::vector<typename decltype(from_name({}))::value_type> values;
    for (const std::string& name : CLI::detail::split(text, ',')) {
        const auto value = from_name(name);
        if (!value)
            throw BadInput(fmt::format("{} {}: must be of {}", option, name, known));
        values.push_back(*value);
    }
    return values;
}

} // namespace

std::vector<Norm> parse_norms(const std::string& text) {
    return parse_list("--recon", text, "none, l2, l1, mixed, uniform, weighted", norm_from_name);
}

std::vector<Method> parse_methods(const std::string& text) {
    return parse_list("-m", text, "pt, pr, gpt, gpr", method_from_name);
}

SampleChoice parse_sample(const std::string& option, const std::string& text) {
    const char *at = text.data(), *const end = at + text.size();
    int numbers[3] = {};
    for (int i = 0; i < 3; ++i) {
        const auto [rest, error] = std::from_chars(at, end, numbers[i]); // refuses what an int cannot hold
        const bool ends_well = i == 2 ? rest == end : rest != end && *rest == ',';
        if (error != std::errc() || numbers[i] < 0 || !ends_well)
            throw BadInput(fmt::format("{} {}: must be X,Y,PASS, such as 120,45,0", option, text));
        at = rest + 1;
    }
    return {0, {numbers[0], numbers[1]}, numbers[2]};
}

} // namespace tessera
