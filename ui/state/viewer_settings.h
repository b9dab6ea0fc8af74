#pragma once

#include "render/estimator/setting.h"
#include "render/session/session.h"
#include "ui/gl/tone.h"
#include "ui/state/viewer_state.h"

#include <vector>

namespace tessera {

// Rows of the table of settings (render/estimator/settings_table.h) for what is the viewer's own. What they are
// bound to must outlive them.

/// How the panes share the cores, and when they rest.
std::vector<Setting> settings_of(Pace& pace);

/// Tone curve, exposure and gamma, in this order.
std::vector<Setting> settings_of(Tone& tone);

/// How the pane shows another one's picture.
Setting comparison_setting(Comparison::Kind& kind);

/// How many pixels are rendered: in relation to what, ...
Setting size_base_setting(SizeChoice::Base& base);
/// ... or by number. The panes hold no more pixels than these limits allow.
Setting custom_size_setting(glm::ivec2& size);

/// Norm, alpha, joint colour, and all of the render but the method: what linked panes have in common.
std::vector<Setting> shared_settings_of(PaneSettings& pane);

} // namespace tessera
