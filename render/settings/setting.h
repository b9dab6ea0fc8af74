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

/// A named value of a setting.
struct SettingChoice {
    std::string_view id; ///< unique within the setting: "half-vector"
    std::string_view label;
    std::string_view help;
};

/// A setting: its name, limits and help, bound to a value. Command line, panel, log, files and messages use these
/// rows (settings_table.h), so each name, limit and help text is defined once. The value must outlive the setting.
struct Setting {
    struct Whole {
        int* value;
        int least, most;
    };
    /// A whole number from 0 to 2^64 - 1.
    struct Natural {
        std::uint64_t* value;
    };
    /// A real number. Its unit, if any, is in the help.
    struct Real {
        float* value;
        float least, most;            ///< limits
        float low, high;              ///< ends of a slider
        const char* format = nullptr; ///< printf format of a linear slider; null: logarithmic slider
    };
    struct Seconds {
        double* value;
        double least, most;
    };
    struct Switch {
        bool* value;
    };
    /// An enum. `get` and `set` take the index of its value.
    struct OneOf {
        std::span<const SettingChoice> choices; ///< in the order of the enum
        std::function<int()> get;
        std::function<void(int)> set;
    };
    /// Width and height, pixels.
    struct Size {
        glm::ivec2* value;
        int most; ///< limit of both; the lower limit is 1
    };

    std::string_view id; ///< with underscores: "rr_delta"; the option is --rr-delta
    std::string_view label;
    std::string_view help; ///< a sentence or two, with units
    std::variant<Whole, Natural, Real, Seconds, Switch, OneOf, Size> kind;
    bool matters = true;  ///< has an effect with the present values of the other settings
    bool is_rare = false; ///< rarely changed: the panel folds it away

    /// Returns the value as text: "6", "0.1", "on", "half-vector", "640x360". Numbers are exact.
    std::string text() const;
    /// Sets the value from such text. Throws std::invalid_argument that names the allowed values, and then changes
    /// nothing.
    void set_text(std::string_view text) const;
    /// Describes the allowed values: "a whole number from 1 to 16", "on or off", "one of tile, rooks".
    std::string allowed() const;
    /// Returns whether the value is within the limits.
    bool is_allowed() const;
    /// Returns the position on a chart's axis: the value, or the number of pixels of a size. Empty: it is a word.
    std::optional<double> number() const;
    /// Returns the value as a JSON number or boolean, or as text() for choices and sizes.
    nlohmann::json json_value() const;
};

/// Returns the ids as a list: "pt, pr, gpt, gpr".
std::string ids_of(std::span<const SettingChoice> choices);

/// Returns the setting with this id, written with underscores or hyphens. Throws std::invalid_argument that lists
/// all ids if there is none.
Setting setting_named(std::span<const Setting> settings, std::string_view id);

/// Binds an enum to choices, which are in the order of its values.
template <class Enum>
Setting::OneOf one_of(std::span<const SettingChoice> choices, Enum& value) {
    return {choices, [&value] { return static_cast<int>(value); },
            [&value](int index) { value = static_cast<Enum>(index); }};
}

} // namespace tessera
