#pragma once

#include "recon/image.h"
#include "render/load/xml_document.h"

#include <vector>

namespace tessera {

/// Whether the element is a colour: <rgb>, <srgb>, <spectrum>, <blackbody>, <color> or a <float>.
bool is_color(const XmlElement& element);

/// A colour's linear value. A spectrum given by wavelengths or as a plugin of Mitsuba 3 becomes its linear sRGB
/// colour, one in a file the fallback, with a note. Throws LoadError for anything else.
Rgb read_color(const XmlElement& element, Rgb fallback, std::vector<LoadNote>& notes);

/// The curve of sRGB [IEC 61966-2-1], from code 0 to 1 to linear.
float srgb_to_linear(float code);

} // namespace tessera
