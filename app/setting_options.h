#pragma once

#include "render/method/settings.h"

#include <CLI/App.hpp>

namespace tessera {

/// Gives the command an option for every setting of the table. They write to `settings`, which must outlive it.
void add_setting_options(CLI::App& command, RenderSettings& settings);

} // namespace tessera
