#pragma once

#include "recon/image.h"
#include "render/load/xml_document.h"

#include <vector>

namespace tessera {

/// Whether the element is a colour: <rgb>, <srgb>, <spectrum>, <color> or a <float>.
bool is_color(const XmlElement& element);

/// A colour's linear value. A spectrum given by wavelengths becomes the grey of its mean, one in a file becomes
/// the fallback, with a note. Throws LoadError for anything else.
Rgb read_color(const XmlElement& element, Rgb fallback, std::vector<LoadNote>& notes);

} // namespace tessera
