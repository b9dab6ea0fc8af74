#pragma once

#include "recon/image.h"

#include <optional>
#include <string_view>

namespace tessera {

/// Index of refraction of a transparent material by its usual name ("bk7", "water", ...), in any case.
std::optional<float> refraction_index(std::string_view name);

/// A metal's complex index of refraction against vacuum, for red, green and blue.
struct ComplexIndex {
    Rgb eta;
    Rgb k;
};

/// By chemical symbol ("Au", "Cu", ...) as in Mitsuba; "none" is a mirror that reflects all.
std::optional<ComplexIndex> metal_index(std::string_view name);

} // namespace tessera
