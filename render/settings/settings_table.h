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

// The one table of settings: every row's name, limits, choices and help stand here and nowhere else. A row is
// bound to a value that must outlive it.

inline constexpr int most_spp = 100'000'000; ///< samples a pixel of one picture
inline constexpr double most_seconds = 1e7;  ///< of rendering, a third of a year
inline constexpr int most_threads = 1024;    ///< of a renderer

/// All members of RenderSettings but method and seed, in the order of the panel.
std::vector<Setting> settings_of(RenderSettings& settings);

/// Norm and alpha, in this order. Setting::matters is that of methods with gradients.
std::vector<Setting> settings_of(ReconstructionSettings& settings);
/// The same, where it is known whether there are gradients: without them, there is nothing to solve.
std::vector<Setting> settings_of(ReconstructionSettings& settings, bool has_gradients);

/// The settings that a method uses: without gradients, the norm that is applied, and defaults otherwise.
ReconstructionSettings applied(const ReconstructionSettings& settings, bool has_gradients);

Setting method_setting(Method& method);
Setting seed_setting(std::uint64_t& seed);
/// `least` is above 0 where a picture needs samples, or two for its two halves.
Setting spp_setting(int& spp, int least = 1);
/// `least` is 0 where that may stand for one a hardware thread.
Setting threads_setting(int& threads, int least = 0);
Setting size_setting(glm::ivec2& size, int most = most_image_edge);

/// The methods and norms by name, in the order of their enums.
std::span<const SettingChoice> method_choices();
std::span<const SettingChoice> norm_choices();

/// Throws std::invalid_argument, naming the setting, where one is outside its limits.
void check(const RenderSettings& settings);

} // namespace tessera
