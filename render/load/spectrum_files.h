#pragma once

#include "render/load/load_context.h"

#include <vector>

#include <pugixml.hpp>

namespace tessera {

/// Replaces the file of a <spectrum filename="..."> by its samples, as an attribute `value`. Replaces the file of
/// a <string name="filename"> in a <spectrum type="irregular"> by parameters `wavelengths` and `values`. Each line
/// of such a file (.spd) is a wavelength in nm and a value; "#" begins a comment. Other elements are left as they
/// are. A file that is missing or cannot be read has an error note, and the element keeps its file name.
void expand_spectrum_file(const XmlElement& element, pugi::xml_node node, const FileSearch& files,
                          std::vector<LoadNote>& notes);

} // namespace tessera
