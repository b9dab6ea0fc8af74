#pragma once

#include "render/method/settings.h"

#include <string>

#include <CLI/App.hpp>

namespace tessera {

/// Gives the command an option for every setting of the table. They write to `settings`, which must outlive it.
void add_setting_options(CLI::App& command, RenderSettings& settings);

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
