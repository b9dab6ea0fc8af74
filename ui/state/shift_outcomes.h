#pragma once

#include "render/estimator/film.h"

#include <string>

#include <imgui.h>

namespace tessera {

/// The colour that stands for how a shift ended, wherever that is shown.
ImU32 outcome_colour(ShiftOutcome outcome);
/// What it means, in a sentence.
const char* outcome_help(ShiftOutcome outcome);

/// Display colours: of each pixel the mean of its shifts' colours. Black where none was tried.
RgbImage outcome_colours(const ReuseMaps& maps);

/// How the shifts to a pixel ended, most of them first: "ok 71 %, occluded 20 %, no light 9 %".
std::string outcome_shares(const ReuseCounts& counts);

} // namespace tessera
