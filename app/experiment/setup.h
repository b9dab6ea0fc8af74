// The settings that an experiment varies, and the setups that result from them.
#pragma once

#include "recon/picture/reconstruct.h"
#include "render/settings/setting.h"
#include "render/settings/settings.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// All settings of a picture, except for the scene and the effort.
struct PictureSettings {
    RenderSettings render;
    ReconstructionSettings reconstruction; ///< used by methods with gradients
    glm::ivec2 size{640, 360};
    int threads = 0; ///< 0: one per hardware thread

    bool operator==(const PictureSettings&) const = default;
};

/// Returns the settings that an experiment can vary (render/settings/settings_table.h): those of the render and
/// the reconstruction (its norm is named "recon", as on the command line), size and threads. `settings` must
/// outlive them.
std::vector<Setting> settings_of(PictureSettings& settings);

/// Accessor of one of these settings in any PictureSettings.
struct Variable {
    std::string id;    ///< "rr_delta"
    std::string label; ///< label of a chart's axis

    std::string text(PictureSettings settings) const;
    /// Throws std::invalid_argument that states the valid values.
    void set_text(PictureSettings& settings, std::string_view text) const;
    /// Returns whether the setting has an effect, given the other settings.
    bool matters(PictureSettings settings) const;
    /// Returns the value as a number on a chart's axis; empty: it is not a number.
    std::optional<double> number(PictureSettings settings) const;
};

/// Finds a variable by its id, or by the option's name with hyphens. Throws std::invalid_argument that lists all.
Variable variable_named(std::string_view id);

/// A setting and the values it takes.
struct Variation {
    Variable variable;
    std::vector<std::string> values; ///< in the format of Variable::text()
};

/// Parses a text such as "tile=2,3,4". Throws BadInput for an unknown setting, an empty list, or a value outside
/// the setting's limits.
Variation parse_variation(std::string_view text);

/// A method with its settings: one way to render a scene.
struct Setup {
    PictureSettings settings;
    std::vector<std::string> values; ///< one for each variation; empty: the variable has no effect here
};

/// Returns every combination of method, norm and values; the last variation changes fastest. Combinations that
/// differ only in settings without effect (the tile of PT) become one setup.
std::vector<Setup> setups_of(const PictureSettings& base, const std::vector<Method>& methods,
                             const std::vector<Norm>& norms, const std::vector<Variation>& variations);

/// Returns the method and, where it has an effect, the reconstruction: "pt", "gpr-l2".
std::string name_of(const Setup& setup);

} // namespace tessera
