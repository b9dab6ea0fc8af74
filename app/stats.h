#pragma once

#include "app/reconstruction_layers.h"
#include "app/scene_source.h"
#include "render/session/picture_settings.h"
#include "render/session/render.h"

#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// An array of what each cost.
nlohmann::json reconstructions_json(const std::vector<ReconstructionStats>& reconstructions);

/// What was counted: rays, paths, shifts.
nlohmann::json counters_json(const Counters& counters);

/// The contents of --stats: times in seconds, memory in bytes.
nlohmann::json stats_json(const nlohmann::json& settings, const OpenedScene& opened, const Render& render,
                          int threads, const std::vector<ReconstructionStats>& reconstructions, bool interrupted);

} // namespace tessera
