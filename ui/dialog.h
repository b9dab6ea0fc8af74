#pragma once

#include <functional>
#include <string>

#include <glm/vec2.hpp>

namespace tessera {

/// A window over everything, in the middle of the screen until it is moved, as high as what `draw` draws in it.
/// @param width  in heights of a line
void draw_dialog(const char* title, glm::vec2 screen, float width, const std::function<void()>& draw);

/// A paragraph of less weight than what it explains.
void dim_text(const std::string& text);

} // namespace tessera
