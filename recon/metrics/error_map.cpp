#include "recon/metrics/error_map.h"

#include "recon/metrics/metrics.h"

#include <glm/common.hpp>

namespace tessera {

float pixel_error(ErrorKind kind, const Rgb& value, const Rgb& reference) {
    const Rgb error = glm::abs(value - reference);
    const auto mean = [](const Rgb& c) { return (c.r + c.g + c.b) / 3; };
    switch (kind) {
    case ErrorKind::relative_squared:
        return mean(error * error / (reference * reference + static_cast<float>(relative_mse_epsilon)));
    case ErrorKind::squared:
        return mean(error * error);
    case ErrorKind::absolute:
        return mean(error);
    case ErrorKind::relative:
        return mean(error / (glm::abs(reference) + static_cast<float>(mape_epsilon)));
    }
    return 0;
}

RgbImage error_map(ErrorKind kind, const RgbImage& image, const RgbImage& reference) {
    RgbImage map(image.width(), image.height());
    for (std::size_t i = 0; i < map.size(); ++i)
        map.data()[i] = Rgb(pixel_error(kind, image.data()[i], reference.data()[i]));
    return map;
}

} // namespace tessera
