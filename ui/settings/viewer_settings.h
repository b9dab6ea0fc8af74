#pragma once

#include "render/session/session.h"
#include "render/settings/setting.h"
#include "ui/gl/tone.h"
#include "ui/state/viewer_state.h"

#include <vector>

namespace tessera {

// Rows of the table of settings (render/settings/settings_table.h) for what is the viewer's own. What they are
// bound to must outlive them.

/// How the panes share the cores, and when they rest.
std::vector<Setting> settings_of(Pace& pace);

/// Tone curve, exposure and gamma, in this order.
std::vector<Setting> settings_of(Tone& tone);

/// How the pane shows another one's picture.
Setting comparison_setting(Comparison::Kind& kind);

/// What the number of rendered pixels follows: the pane, the scene, or a size of its own.
Setting size_base_setting(SizeChoice::Base& base);
/// The size where it is one of its own; the panes hold no more pixels than its limits allow.
Setting custom_size_setting(glm::ivec2& size);

/// What linked panes have in common: all of the render but its method, and the reconstruction.
std::vector<Setting> shared_settings_of(PaneSettings& pane);

} // namespace tessera
