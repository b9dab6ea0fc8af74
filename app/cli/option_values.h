#pragma once

#include "recon/reconstruct.h"
#include "render/estimator/settings.h"
#include "render/load/mitsuba_xml.h"

#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <glm/vec2.hpp>

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
/// "gpr,pt", as given to -m.
std::vector<Method> parse_methods(const std::string& text);

/// "X,Y,PASS", as given to `option`: a sample of whatever pane.
SampleChoice parse_sample(const std::string& option, const std::string& text);

/// Gives the command an option for every setting of the table. They write to `settings`, which must outlive it.
void add_setting_options(CLI::App& command, RenderSettings& settings);

/// The options that lead from some settings to others, as words of a command line: " --tile 4 --no-jitter".
/// Without method and seed, which are in no table.
std::string option_words(const RenderSettings& from, const RenderSettings& to);

/// Where options of a picture are written to; all must outlive the command.
struct PictureWords {
    std::string& size; ///< "640x360"
    RenderSettings& settings;
    float& alpha;
    int& threads;
};

/// The same, and --size, --alpha, --seed and --threads.
void add_picture_options(CLI::App& command, PictureWords words);

} // namespace tessera
