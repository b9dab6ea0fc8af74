// What an experiment varies, and the setups that come of it.
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

/// All that a picture is made with, but for the scene and the time it is given.
struct PictureSettings {
    RenderSettings render;
    ReconstructionSettings reconstruction; ///< of methods with gradients
    glm::ivec2 size{640, 360};
    int threads = 0; ///< 0: one a hardware thread

    bool operator==(const PictureSettings&) const = default;
};

/// The settings of the table that an experiment may vary (render/settings/settings_table.h): those of the render,
/// recon (as the command line calls the norm), alpha, size and threads. `settings` must outlive them.
std::vector<Setting> settings_of(PictureSettings& settings);

/// One of these settings, whichever picture it is of.
struct Variable {
    std::string id;    ///< "rr_delta"
    std::string label; ///< of an axis

    std::string text(PictureSettings settings) const;
    /// Throws std::invalid_argument that says what it may be.
    void set_text(PictureSettings& settings, std::string_view text) const;
    /// Whether it makes a difference while the others are as they are.
    bool matters(PictureSettings settings) const;
    /// Its place on an axis; empty: it is no number.
    std::optional<double> number(PictureSettings settings) const;
};

/// The variable of that id, or of the option's name with hyphens. Throws std::invalid_argument that names all.
Variable variable_named(std::string_view id);

/// A setting and the values that it takes in turn.
struct Variation {
    Variable variable;
    std::vector<std::string> values; ///< as Variable::text() has them
};

/// What a text such as "tile=2,3,4" says. Throws BadInput for an unknown setting, an empty list or a value outside
/// the setting's limits.
Variation parse_variation(std::string_view text);

/// One way to make a picture of a scene.
struct Setup {
    PictureSettings settings;
    std::vector<std::string> values; ///< one a variation; empty: it makes no difference here
};

/// Every method with every norm and every combination of values, those of the last variation next to each other.
/// Combinations that differ only in what makes no difference (a tile for PT) are one setup.
std::vector<Setup> setups_of(const PictureSettings& base, const std::vector<Method>& methods,
                             const std::vector<Norm>& norms, const std::vector<Variation>& variations);

/// Its method and, where there are gradients, reconstruction: "pt", "gpr-l2".
std::string name_of(const Setup& setup);

} // namespace tessera
