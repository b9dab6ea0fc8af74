#pragma once

#include "recon/picture/reconstruct.h"
#include "render/load/scene_source.h"
#include "render/settings/settings_table.h"

#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace tessera {

struct SampleChoice;

// Values on the command line that stand for more than a word or a number. All throw BadInput that names the
// option.

/// "WxH" in pixels, as given to `option`.
glm::ivec2 parse_size(const std::string& option, const std::string& text);
/// "name=value" each, as given to -D.
SceneVariables parse_variables(const std::vector<std::string>& definitions);
/// "l2,none", as given to --recon.
std::vector<Norm> parse_norms(const std::string& text);
/// Throws BadInput where this machine lacks the library that one of them needs: before something is rendered or
/// reconstructed, not where it is only spoken of.
void check_available(const std::vector<Norm>& norms);
/// "gpr,pt", as given to -m.
std::vector<Method> parse_methods(const std::string& text);

/// "X,Y,PASS", as given to `option`: a sample of whatever pane.
SampleChoice parse_sample(const std::string& option, const std::string& text);

/// Lets an option take only finite numbers from `least` to `most`: CLI11's own ranges let NaN pass. Returns the
/// option.
CLI::Option* limit(CLI::Option* option, double least, double most);
/// Lets an option take no empty name: "$1" of a script that was given nothing is no wish for the built-in scene.
CLI::Option* forbid_empty(CLI::Option* option);
/// Lets an option take only seconds above 0, at most most_seconds.
CLI::Option* limit_to_seconds(CLI::Option* option);

// Options made from the table of settings. What they write to must outlive the command. Each returns the option,
// for a command that describes it otherwise.

/// The setting's own option, with its help, limits and, where the value is one by itself, default.
CLI::Option* add_setting(CLI::App& command, const Setting& setting);

/// -m of one method.
CLI::Option* add_method(CLI::App& command, Method& method);
/// -m of several, whose text is for parse_methods. `rest` follows their names in the help.
CLI::Option* add_methods(CLI::App& command, std::string& methods, const std::string& rest);
/// --recon of one reconstruction.
CLI::Option* add_norm(CLI::App& command, ReconstructionSettings& settings);
/// --recon of several, whose text is for parse_norms. `rest` follows their names in the help.
CLI::Option* add_norms(CLI::App& command, std::string& norms, const std::string& rest);
/// --alpha.
CLI::Option* add_alpha(CLI::App& command, ReconstructionSettings& settings);
/// --clock, "cpu" or "wall": what --time counts.
CLI::Option* add_clock(CLI::App& command, std::string& clock);

/// The options that lead from some settings to others, as words of a command line: " --tile 4 --no-adapt-tile".
/// Without method and seed.
std::string option_words(RenderSettings from, RenderSettings to);

/// The options of all render settings but the method, "--tile", in the order of the panel.
std::vector<std::string> render_option_names();

/// Where options of a picture are written to.
struct PictureWords {
    glm::ivec2& size; ///< 0: not given
    RenderSettings& settings;
    ReconstructionSettings& reconstruction;
    int& threads;
};

/// Adds an option for every render setting but the method, and --size, --seed and --threads.
void add_picture_options(CLI::App& command, PictureWords words);

} // namespace tessera
