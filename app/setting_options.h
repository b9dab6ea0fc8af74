#pragma once

#include "render/method/settings.h"

#include <string>

#include <CLI/App.hpp>

namespace tessera {

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
