#pragma once

#include "render/load/load_context.h"
#include "render/load/mitsuba_xml.h"
#include "render/load/xml_document.h"

#include <vector>

namespace tessera {

/// Goes through a scene once, in order, and
/// - replaces $name in all attributes by the value of the <default> of that name that stands before, or by that of
///   `given`, which wins;
/// - puts the files that <include> names in their places; they see the variables before them, and theirs are seen
///   after them;
/// - adds the folders of <path> to `files`.
/// Throws LoadError for an unknown name, a missing file, or files that include each other; notes the variables
/// given in vain.
void expand_scene(XmlDocument& document, const SceneVariables& given, FileSearch& files,
                  std::vector<LoadNote>& notes);

} // namespace tessera
