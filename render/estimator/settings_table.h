#pragma once

#include "render/estimator/settings.h"

#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace tessera {

/// One value of a setting that has a few named ones.
struct SettingChoice {
    std::string_view id; ///< unique in the setting: "half-vector"
    std::string_view label;
    std::string_view help;
};

/// One of RenderSettings' members as command line, panel, log and files know it: they all are made from this
/// table.
struct Setting {
    struct Whole {
        int RenderSettings::*member;
        int least, most;
    };
    /// Shown on a logarithmic scale.
    struct Real {
        float RenderSettings::*member;
        float least, most; ///< limits
        float low, high;   ///< ends of a slider
    };
    struct Switch {
        bool RenderSettings::*member;
    };
    struct OneOf {
        std::span<const SettingChoice> choices; ///< in the order of the values
        int (*get)(const RenderSettings&);
        void (*set)(RenderSettings&, int);
    };

    std::string_view id; ///< "rr_delta", with underscores; the option is --rr-delta
    std::string_view label;
    std::string_view help; ///< a sentence or two, with units
    std::variant<Whole, Real, Switch, OneOf> kind;
    /// Whether it makes a difference while the other settings are as they are.
    bool (*matters)(const RenderSettings&);
    bool is_rare = false; ///< seldom changed: the panel folds it away

    /// The value as a word or number: "6", "0.1", "on", "half-vector". Numbers with all digits that they need.
    std::string text(const RenderSettings& settings) const;
    /// Sets it from such a word or number. Throws std::invalid_argument that says what it may be.
    void set_text(RenderSettings& settings, std::string_view text) const;
    /// What it may be: "a whole number from 1 to 16", "on or off", "one of tile, rooks".
    std::string allowed() const;
};

/// All but method and seed, in the order of the panel.
std::span<const Setting> all_settings();

/// The setting of that id, with underscores or with the option's hyphens. Throws std::invalid_argument that names
/// all.
const Setting& setting_named(std::string_view id);

/// Throws std::invalid_argument, naming the setting, where one is outside its limits.
void check(const RenderSettings& settings);

} // namespace tessera
