#pragma once

#include "render/estimator/setting.h"
#include "ui/gl/controls.h"

#include <span>
#include <vector>

namespace tessera {

/// Choices of the table of settings, as items of a control.
std::vector<ChoiceItem> choice_items(std::span<const SettingChoice> choices);

/// The control that fits the setting, with its id, label, limits and help: a slider, or a number to type where a
/// slider could not point at each, a switch, a list. Of a size there are two, "width" and "height". Returns
/// whether it changed the value.
bool draw_setting(Controls& controls, const Setting& setting);

} // namespace tessera
