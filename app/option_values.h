#pragma once

#include "recon/reconstruct.h"
#include "render/load/mitsuba_xml.h"
#include "render/method/settings.h"

#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

struct SampleChoice;

// Values on the command line that stand for more than a word or a number. All throw BadInput that names the
// option.

/// "WxH" in pixels, as given to `option`.
glm::ivec2 parse_size(const std::string& option, const std::string& text);
/// "name=value" each, as given to -D.
SceneVariables parse_variables(const std::vector<std::string>& definitions);
/// "l2,none", as given to --recon.
std::vector<Norm> parse_norms(const std::string& text);
/// "gpr,pt", as given to -m.
std::vector<Method> parse_methods(const std::string& text);

/// "X,Y,PASS", as given to `option`: a sample of whatever pane.
SampleChoice parse_sample(const std::string& option, const std::string& text);

} // namespace tessera
