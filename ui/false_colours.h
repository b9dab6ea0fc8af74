#pragma once

#include <array>

#include <glm/vec3.hpp>

namespace tessera {

/// Colours that stand for numbers from 0 to a top value: display colours (sRGB), evenly spaced, linear between.
/// Their lightness in OKLab rises in equal steps, from 0.20 to 0.94, while the hue turns from violet to yellow:
/// what is greater looks brighter, to the colour-blind and on paper, too.
inline constexpr std::array<glm::vec3, 9> false_colours = {{
    {0.122f, 0.001f, 0.240f},
    {0.120f, 0.069f, 0.473f},
    {0.004f, 0.269f, 0.489f},
    {0.001f, 0.402f, 0.521f},
    {0.023f, 0.532f, 0.564f},
    {0.052f, 0.668f, 0.577f},
    {0.287f, 0.801f, 0.497f},
    {0.672f, 0.883f, 0.414f},
    {0.986f, 0.944f, 0.390f},
}};

} // namespace tessera
