#pragma once

#include "recon/picture/reconstruct.h"
#include "render/io/files.h"
#include "render/settings/setting.h"
#include "render/settings/settings.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

// The table of all settings, the only place that defines their names, limits, choices and help.

inline constexpr int most_spp = 100'000'000; ///< samples per pixel of one picture
inline constexpr double most_seconds = 1e7;  ///< of rendering; a third of a year
inline constexpr int most_threads = 1024;    ///< of a render

/// Returns all members of RenderSettings except method and seed, in the order of the panel.
std::vector<Setting> settings_of(RenderSettings& settings);

/// Returns norm and alpha, in this order. Setting::matters assumes a method with gradients.
std::vector<Setting> settings_of(ReconstructionSettings& settings);
/// Returns the same with Setting::matters for a method with or without gradients.
std::vector<Setting> settings_of(ReconstructionSettings& settings, bool has_gradients);

/// Returns the settings in use: without gradients, the norm that applies, and the default alpha.
ReconstructionSettings applied(const ReconstructionSettings& settings, bool has_gradients);

Setting method_setting(Method& method);
Setting seed_setting(std::uint64_t& seed);
/// @param least  lower limit: 0, 1, or 2 for a picture of two halves
Setting spp_setting(int& spp, int least = 1);
/// @param least  lower limit; 0 stands for one thread per hardware thread
Setting threads_setting(int& threads, int least = 0);
Setting size_setting(glm::ivec2& size, int most = max_image_edge);

// Methods and norms, in the order of their enums.
std::span<const SettingChoice> method_choices();
std::span<const SettingChoice> norm_choices();

/// Throws std::invalid_argument that names the setting if a value is outside its limits.
void check(const RenderSettings& settings);

} // namespace tessera
