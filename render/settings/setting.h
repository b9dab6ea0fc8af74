#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// One value of a setting that has a few named ones.
struct SettingChoice {
    std::string_view id; ///< unique in the setting: "half-vector"
    std::string_view label;
    std::string_view help;
};

/// What command line, panel, log, files and messages know of a setting, bound to where its value lies. They are
/// all made from such rows (settings_table.h), so that a name, a limit or a help text stands only there.
struct Setting {
    struct Whole {
        int* value;
        int least, most;
    };
    /// A whole number from 0 on, as large as they come.
    struct Natural {
        std::uint64_t* value;
    };
    /// A number without a unit, or with one that its help names.
    struct Real {
        float* value;
        float least, most;            ///< limits
        float low, high;              ///< ends of a slider
        const char* format = nullptr; ///< as printf takes it, on a linear scale; null: on a logarithmic one
    };
    struct Seconds {
        double* value;
        double least, most;
    };
    struct Switch {
        bool* value;
    };
    /// An enum, by the index of its value.
    struct OneOf {
        std::span<const SettingChoice> choices; ///< in the order of the values
        std::function<int()> get;
        std::function<void(int)> set;
    };
    /// Width and height, pixels.
    struct Size {
        glm::ivec2* value;
        int most; ///< of each; the least is 1
    };

    std::string_view id; ///< "rr_delta", with underscores; the option is --rr-delta
    std::string_view label;
    std::string_view help; ///< a sentence or two, with units
    std::variant<Whole, Natural, Real, Seconds, Switch, OneOf, Size> kind;
    bool matters = true;  ///< makes a difference while the other settings are as they are
    bool is_rare = false; ///< seldom changed: the panel folds it away

    /// The value as a word or number: "6", "0.1", "on", "half-vector", "640x360". Numbers with all digits that
    /// they need.
    std::string text() const;
    /// Sets it from such a word or number. Throws std::invalid_argument that says what it may be, and has then
    /// changed nothing.
    void set_text(std::string_view text) const;
    /// What it may be: "a whole number from 1 to 16", "on or off", "one of tile, rooks".
    std::string allowed() const;
    /// Whether the value, however it came there, is within the limits.
    bool is_allowed() const;
    /// Its place on an axis: the value, or the number of pixels of a size. Empty: it is a word.
    std::optional<double> number() const;
    /// A number, true or false, or the text of what is neither.
    nlohmann::json json_value() const;
};

/// The choices' ids in a row, as messages and help name them: "pt, pr, gpt, gpr".
std::string ids_of(std::span<const SettingChoice> choices);

/// The row of that id, given with underscores or with the option's hyphens. Throws std::invalid_argument that
/// names all.
Setting setting_named(std::span<const Setting> settings, std::string_view id);

/// Binds an enum whose values have the choices' order.
template <class Enum>
Setting::OneOf one_of(std::span<const SettingChoice> choices, Enum& value) {
    return {choices, [&value] { return static_cast<int>(value); },
            [&value](int index) { value = static_cast<Enum>(index); }};
}

} // namespace tessera
