#pragma once

#include "render/load/mitsuba_xml.h"
#include "render/load/xml_document.h"

#include <vector>

namespace tessera {

/// Replaces $name in all attributes by the value of the <default> of that name that stands before, or by that of
/// `given`, which wins. Throws LoadError for an unknown name; notes the variables given in vain.
void substitute_variables(XmlDocument& document, const SceneVariables& given, std::vector<LoadNote>& notes);

} // namespace tessera
