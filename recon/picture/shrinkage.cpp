#include "recon/picture/shrinkage.h"

#include "recon/picture/guide_kernel.h"
#include "recon/pixel_loops.h"
#include "recon/square_means.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

// Tried on four rooms, 3 to 34 samples: half the radius costs 0.1 to 0.2 dB.
constexpr int radius = 16;      // of the squares of pixels that tell
constexpr float most = 0.5f;    // of the way to the target
constexpr float largest = 1e6f; // square, so that sums know others beside it; what is not finite, too

/// Squared beside the brightness of both pictures.
float square_of(Rgb light, float brightness) {
    const Rgb c = light / brightness;
    const float square = glm::dot(c, c);
    return square < largest ? square : largest;
}

} // namespace

RgbImage shrink_toward(const RgbImage& target, NoisyPicture picture, const GuideImages& guides,
                       const ParallelFor& parallel_for) {
    if (picture.noise.empty())
        return target;
    const int width = target.width(), height = target.height();
    Image<float> brightness(width, height), noise(width, height), difference(width, height);
    double sum = 0;
    for (std::size_t i = 0; i < target.size(); ++i) {
        const Rgb both = light_at(picture.image, guides, i) + light_at(target, guides, i);
        brightness.data()[i] = is_finite(both) ? brightness_of(both) / 2 : 0;
        sum += static_cast<double>(brightness.data()[i]);
    }
    const float least = dark * static_cast<float>(sum / static_cast<double>(target.size()));
    if (!(least > 0))
        return std::move(picture.image);
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        const float b = brightness.data()[i] + least;
        noise.data()[i] = square_of(light_at(picture.noise, guides, i), b);
        difference.data()[i] = square_of(light_at(target, guides, i) - light_at(picture.image, guides, i), b);
    });
    take_wide_means(noise, radius, brightness, parallel_for);
    take_wide_means(difference, radius, brightness, parallel_for);
    for_pixels(width, height, parallel_for, [&](std::size_t i) {
        const float d = difference.data()[i], share = d > 0 ? std::min(noise.data()[i] / d, most) : 0;
        if (is_finite(target.data()[i]))
            picture.image.data()[i] += share * (target.data()[i] - picture.image.data()[i]);
    });
    return std::move(picture.image);
}

} // namespace tessera
