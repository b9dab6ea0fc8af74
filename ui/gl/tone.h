#pragma once

#include "recon/image.h"

#include <array>

#include <glm/vec3.hpp>
#include <imgui.h>

namespace tessera {

/// Values of the first and the last false colour.
struct ValueRange {
    float low = 0;
    float high = 1;           ///< > low
    bool logarithmic = false; ///< colours are spaced logarithmically; low > 0

    /// Returns the position of a value: 0 at `low`, 1 at `high`, outside [0, 1] beyond them.
    float share(float value) const;
    /// Returns the value at a position.
    float value(float share) const;

    /// Return the range after its low or high end was dragged by a fraction of the legend's length. low < high is
    /// kept.
    ValueRange with_low_dragged(float by) const;
    ValueRange with_high_dragged(float by) const;

    bool operator==(const ValueRange&) const = default;
};

/// False colours: display colours (sRGB), evenly spaced, with linear interpolation between. Their lightness in
/// OKLab rises in equal steps from 0.20 to 0.94, while the hue turns from violet to yellow. Larger numbers look
/// brighter, also to the colour-blind and in grey prints.
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

/// Mapping of radiance to brightness on the screen.
struct Tone {
    enum class Curve {
        srgb,   ///< the display's own curve, clipped at 1
        filmic, ///< highlights are compressed, then sRGB
    };
    Curve curve = Curve::srgb;
    float exposure = 0;            ///< stops: radiance is multiplied by 2^exposure first
    float difference_exposure = 0; ///< additional stops of gradients and differences

    /// Returns the exposure of gradients and differences, in stops.
    float of_differences() const { return exposure + difference_exposure; }

    bool operator==(const Tone&) const = default;
};

/// Returns the display colour of a radiance, in [0, 1], by the curves of the shader.
Rgb displayed(const Rgb& radiance, const Tone& tone);

} // namespace tessera
