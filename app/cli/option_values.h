#pragma once

#include "recon/picture/reconstruct.h"
#include "render/load/scene_source.h"
#include "render/scene/camera.h"
#include "render/scene/sensor.h"
#include "render/settings/settings_table.h"

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace tessera {

struct SampleChoice;

// Parsers of option values with a structure. All throw BadInput that names the option.

/// Parses the value "WxH" of `option`, in pixels.
glm::ivec2 parse_size(const std::string& option, const std::string& text);
/// Parses the value "X,Y,WxH" of --crop, or "none", which has no window. Its film is `film`; 0: the scene's.
CropWindow parse_crop(const std::string& text, glm::ivec2 film);
/// Parses the values "name=value" of -D.
SceneVariables parse_variables(const std::vector<std::string>& definitions);
/// Parses the value "l2,none" of --recon.
std::vector<Norm> parse_norms(const std::string& text);
/// Throws BadInput if this machine lacks a library that one of the norms needs. Call it before anything is
/// rendered or reconstructed.
void check_available(const std::vector<Norm>& norms);
/// Parses the value "gpr,pt" of -m.
std::vector<Method> parse_methods(const std::string& text);

/// Parses the value "X,Y,PASS" of `option`: a sample of any pane.
SampleChoice parse_sample(const std::string& option, const std::string& text);

/// Restricts an option to finite numbers from `least` to `most`; CLI11's own ranges accept NaN. Returns the
/// option.
CLI::Option* limit(CLI::Option* option, double least, double most);
/// Forbids an empty name: an unset "$1" in a script must not select the built-in scene.
CLI::Option* forbid_empty(CLI::Option* option);
/// Restricts an option to seconds from 0.001 to most_seconds.
CLI::Option* limit_to_seconds(CLI::Option* option);
/// Adds --strict, for SceneSource::strict.
CLI::Option* add_strict(CLI::App& command, bool& strict);

// Options made from the table of settings. The variables that they write to must outlive the command. Each
// function returns the option, so that a command can change its description.

/// Adds the setting's option with its help, limits and default.
CLI::Option* add_setting(CLI::App& command, const Setting& setting);

/// Destinations of the options that choose the view of a scene.
struct ViewArguments {
    std::string &camera, &sensor, &crop;
};
/// Adds --camera, --sensor and --crop, whose text parse_crop() reads.
void add_view_options(CLI::App& command, ViewArguments words);

/// Adds --pixel-format.
CLI::Option* add_pixel_format(CLI::App& command, std::optional<PixelFormat>& format);

/// Adds -m for one method.
CLI::Option* add_method(CLI::App& command, Method& method);
/// Adds -m for several methods, whose text parse_methods() reads. `rest` follows the names in the help.
CLI::Option* add_methods(CLI::App& command, std::string& methods, const std::string& rest);
/// Adds --recon for one reconstruction.
CLI::Option* add_norm(CLI::App& command, ReconstructionSettings& settings);
/// Adds --recon for several reconstructions, whose text parse_norms() reads. `rest` follows the names in the
/// help.
CLI::Option* add_norms(CLI::App& command, std::string& norms, const std::string& rest);
/// Adds --alpha.
CLI::Option* add_alpha(CLI::App& command, ReconstructionSettings& settings);
/// Adds --clock, "cpu" or "wall": the time that --time limits.
CLI::Option* add_clock(CLI::App& command, std::string& clock);

/// Returns the options that change `from` into `to`, except for method and seed: " --tile 4 --no-adapt-tile".
std::string option_words(RenderSettings from, RenderSettings to);

/// Returns the option names of all render settings but the method, such as "--tile", in the order of the panel.
std::vector<std::string> render_option_names();

/// Destinations of the options of a picture.
struct PictureArguments {
    glm::ivec2& size; ///< 0: not given
    RenderSettings& settings;
    ReconstructionSettings& reconstruction;
    int& threads;
};

/// Adds an option for every render setting but the method, and --size, --seed and --threads.
void add_picture_options(CLI::App& command, PictureArguments words);

} // namespace tessera
