// What an experiment varies, and the setups that come of it.
#pragma once

#include "recon/reconstruct.h"
#include "render/estimator/settings.h"

#include <functional>
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

/// One of these settings, by name, for whatever takes several values of it in turn: a setting of the table
/// (render/estimator/settings_table.h), or recon, alpha, size or threads.
struct Variable {
    std::string id;    ///< "rr_delta"
    std::string label; ///< of an axis
    std::function<std::string(const PictureSettings&)> text;
    /// Sets the value from a text. Throws std::invalid_argument that says what it may be.
    std::function<void(PictureSettings&, std::string_view)> set_text;
    /// Whether it makes a difference while the others are as they are.
    std::function<bool(const PictureSettings&)> matters;
    /// The value's place on an axis; empty: it is no number.
    std::function<std::optional<double>(const PictureSettings&)> number;
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
