#include "ui/state/companions.h"

#include "recon/metrics/metrics.h"
#include "recon/metrics/valid_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <glm/common.hpp>

namespace tessera {

float Histogram::low_end(int bin) {
    return std::exp2(static_cast<float>(first_stop) + static_cast<float>(bin) / bins_a_stop);
}

Histogram histogram_of(const RgbImage& image) {
    Histogram h;
    for (const Rgb& pixel : image) {
        const float l = luminance(pixel);
        if (!is_finite(pixel)) {
            ++h.not_finite;
        } else if (l <= 0) {
            ++(l < 0 ? h.negative : h.black);
        } else {
            const float place = (std::log2(l) - Histogram::first_stop) * Histogram::bins_a_stop;
            const int bin = std::clamp(static_cast<int>(std::floor(place)), 0, Histogram::bin_count - 1);
            ++h.bins[bin];
        }
    }
    return h;
}

namespace {

bool has_halves(const Reference& reference) {
    return !reference.halves[0].empty();
}

FloorFreeError measure(const RgbImage& picture, const RgbImage& a, const RgbImage& b, bool halves) {
    if (halves)
        return measure_floor_free_error(picture, a, b);
    return {measure_error(picture, a).relative_mse, std::numeric_limits<double>::quiet_NaN()};
}

} // namespace

std::optional<PictureError> error_to(const Reference& reference, const RgbImage& picture) {
    const bool halves = has_halves(reference);
    const RgbImage& a = halves ? reference.halves[0] : reference.image;
    const RgbImage& b = halves ? reference.halves[1] : reference.image;
    if (picture.empty() || !same_size(picture, a))
        return std::nullopt;
    const std::vector<std::size_t> excluded = invalid_pixels({&picture, &a, &b});
    if (excluded.size() == picture.size())
        return std::nullopt;
    // Pixels that are black in both images add nothing to the sum. Dividing by `share` excludes them from the
    // mean.
    const FloorFreeError error = excluded.empty() ? measure(picture, a, b, halves)
                                                  : measure(blackened(picture, excluded), blackened(a, excluded),
                                                            blackened(b, excluded), halves);
    const double share =
        static_cast<double>(picture.size() - excluded.size()) / static_cast<double>(picture.size());
    if (!std::isfinite(error.relative_mse))
        return std::nullopt;
    return PictureError{error.relative_mse / share, error.standard_error / share, excluded.size()};
}

std::string reference_caveat(const Reference& reference) {
    std::string text;
    if (!has_halves(reference))
        text = "The reference has no halves: these errors include its own, unknown error.";
    if (reference.not_finite > 0)
        text += fmt::format("{}{} of its pixels are not finite and are left out.", text.empty() ? "" : " ",
                            reference.not_finite);
    return text;
}

std::shared_ptr<const Reference> make_reference(std::string name, RgbImage image, std::array<RgbImage, 2> halves,
                                                std::optional<SceneChecksums> scene) {
    auto reference = std::make_shared<Reference>();
    reference->name = std::move(name);
    reference->image = std::move(image);
    reference->scene = scene;
    if (!halves[0].empty() && same_size(halves[0], reference->image) && same_size(halves[1], reference->image))
        reference->halves = std::move(halves);
    const Reference& r = *reference;
    reference->not_finite =
        (has_halves(r) ? invalid_pixels({&r.image, &r.halves[0], &r.halves[1]}) : invalid_pixels({&r.image}))
            .size();
    double sum = 0;
    for (const Rgb& pixel : r.image)
        sum += is_finite(pixel) ? static_cast<double>(luminance(pixel)) : 0;
    reference->mean = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(r.image.size(), 1)));
    return reference;
}

} // namespace tessera
