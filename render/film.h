#pragma once

#include "recon/gradient_images.h"
#include "render/method/counters.h"

#include <glm/vec3.hpp>

namespace tessera {

/// What one pass found at one pixel.
struct PixelSample {
    Rgb primal{0};
    Rgb dx{0}; ///< to the pixel on the right
    Rgb dy{0}; ///< to the pixel below
    Rgb very_direct{0};
};

/// Sums of a render's samples, the only place that knows counts and borders. Sums are kept in double: means are
/// taken when they are asked for, and 10^5 passes neither drift nor overflow. Every pixel is written once a pass,
/// by one worker, so the sums do not depend on the number of threads.
class Film {
public:
    Film(int width, int height, bool gradients);

    int width() const { return primal_.width(); }
    int height() const { return primal_.height(); }

    /// Adds a pass's sample of one pixel. A sample that is not finite is refused and counted.
    void add(int x, int y, const PixelSample& sample, Counters& counters);

    /// Means over `passes` complete passes.
    GradientImages means(int passes) const;

private:
    using Sums = Image<glm::dvec3>;
    Sums primal_, dx_, dy_, very_direct_;
};

} // namespace tessera
