#pragma once

#include "app/experiment/artefacts.h"
#include "recon/metrics.h"
#include "render/estimator/counters.h"

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace tessera {

/// How much a render is given.
struct Effort {
    enum class Unit { spp, cpu_seconds, wall_seconds };

    double amount = 64;
    Unit unit = Unit::spp;

    bool operator==(const Effort&) const = default;
};

/// The effort with its unit: "64 spp", "60 CPU s", "60 s".
std::string to_string(const Effort& effort);

/// One picture and its errors. Times are of rendering and of this picture's reconstruction.
struct Measurement {
    int halvings = 0; ///< taken after 1 / 2^halvings of the time or samples that a render is given
    std::uint64_t seed = 0;
    int spp = 0;
    double cpu_seconds = 0, wall_seconds = 0;
    double reconstruction_cpu_seconds = 0; ///< part of cpu_seconds
    double relative_mse = 0;               ///< to the mean of the reference's halves
    FloorFreeError floor_free;
    std::optional<TileSpectrum> tiles; ///< of methods that share light within tiles of two pixels and more
    Counters counters;
    std::optional<Artefacts> artefacts; ///< where they are measured
};

/// The measurement as JSON; numbers that are not finite become null.
nlohmann::ordered_json to_json(const Measurement& measurement);
/// What to_json wrote. Throws nlohmann::json::exception where something is missing.
Measurement measurement_from_json(const nlohmann::json& json);

} // namespace tessera
