#pragma once

#include "ui/json_fields.h"
#include "ui/viewer_state.h"

namespace tessera {

/// The path inspector and the slow motion as fields of a settings file, "inspector" and "slow_motion": whether
/// they are on, how they show things, and the pixel that is looked at, of a given pass or the newest there is. The
/// shift chosen from its table is of the render that was, and not in it; nor is a pixel of an earlier picture.
void add_inspection(nlohmann::ordered_json& json, const ViewerState& state);

/// Sets what such fields say, once the panes are those of the file; what they do not mention stays.
void read_inspection(const JsonFields& fields, ViewerState& state);

} // namespace tessera
