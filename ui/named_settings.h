#pragma once

#include "ui/viewer_state.h"

#include <string>

namespace tessera {

/// The buffer of that id. Throws std::invalid_argument where there is none.
Buffer buffer_named(const std::string& id);

/// Sets a part of the state by its name from a word or number: a render setting of the active pane (of all, when
/// linked), its method, buffer or comparison, or something of the viewer. Throws std::invalid_argument that says
/// what there is or may be.
void set_by_name(ViewerState& state, const std::string& name, const std::string& value);

} // namespace tessera
