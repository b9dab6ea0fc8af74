#pragma once

#include "recon/image.h"

#include <array>

#include <glm/vec3.hpp>
#include <imgui.h>

namespace tessera {

/// What the first and the last of the false colours stand for.
struct ValueRange {
    float low = 0;
    float high = 1;           ///< > low
    bool logarithmic = false; ///< colours stand for powers; low > 0

    /// Where a value lies: 0 at `low`, 1 at `high`, beyond them below and above.
    float share(float value) const;
    /// The value that lies there.
    float value(float share) const;

    /// The range after its low or high end was dragged by a share of the legend's length. Stays in order.
    ValueRange with_low_dragged(float by) const;
    ValueRange with_high_dragged(float by) const;

    bool operator==(const ValueRange&) const = default;
};

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

/// How radiance becomes brightness on the screen.
struct Tone {
    enum class Curve {
        srgb,   ///< the display's own: what is linear looks linear
        filmic, ///< highlights are compressed, then sRGB
    };
    Curve curve = Curve::srgb;
    float exposure = 0;            ///< stops: radiance is multiplied by 2^exposure first
    float difference_exposure = 0; ///< stops, which gradients and differences have beyond it

    /// The exposure of gradients and differences, stops.
    float of_differences() const { return exposure + difference_exposure; }

    bool operator==(const Tone&) const = default;
};

/// What the canvas shows for a radiance, in [0, 1]: the shader's curves for drawings beside it.
Rgb displayed(const Rgb& radiance, const Tone& tone);

} // namespace tessera
