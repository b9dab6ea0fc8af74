#pragma once

#include "app/verdict.h"

#include <string>
#include <vector>

namespace tessera {

/// What the suite says of one point on one scene.
struct OverviewCell {
    std::string scene, point; ///< their names
    Verdict::Kind verdict = Verdict::Kind::ok;
    double factor = 0; ///< as in Findings
};

/// A table in Markdown: a line a scene, a column a point, each in the order in which they come: the ratio of
/// errors, or what is wrong. Empty where there is no such cell. Scenes link to their anchors.
std::string overview(const std::vector<OverviewCell>& cells);

/// What leads to a scene's section, to stand before its heading: headings have anchors of their own, but without
/// the dots of a name.
std::string anchor(const std::string& scene);

} // namespace tessera
