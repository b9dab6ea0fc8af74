#pragma once

#include <glm/vec2.hpp>

namespace tessera {

inline constexpr int most_render_pixels_an_edge = 8192;

/// How many pixels the panes render.
struct SizeChoice {
    enum class Base { pane, scene, custom };
    Base base = Base::pane; ///< what fits the pane, the film of the scene, or `custom`
    float scale = 1.0f;     ///< of width and height, (0, 2]
    glm::ivec2 custom{640, 360};

    bool operator==(const SizeChoice&) const = default;
};

/// The size to ask for; at least 1x1. For SizeChoice::Base::pane it has the proportions of the film, and a width
/// of small prime factors only, which the Fourier transform of the reconstruction is quick with.
glm::ivec2 render_size(const SizeChoice& choice, glm::ivec2 film_size, glm::ivec2 pane_size);

} // namespace tessera
