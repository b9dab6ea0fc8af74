#include "recon/metrics/valid_pixels.h"

#include <algorithm>

namespace tessera {

std::vector<std::size_t> invalid_pixels(std::initializer_list<const RgbImage*> images) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < (*images.begin())->size(); ++i)
        if (!std::all_of(images.begin(), images.end(), [&](const RgbImage* m) { return is_finite(m->data()[i]); }))
            found.push_back(i);
    return found;
}

RgbImage blackened(RgbImage image, const std::vector<std::size_t>& pixels) {
    for (std::size_t i : pixels)
        image.data()[i] = Rgb(0);
    return image;
}

RgbImage without(const RgbImage& image, const std::vector<std::size_t>& pixels) {
    RgbImage rest(static_cast<int>(image.size() - pixels.size()), 1);
    auto out = rest.begin();
    auto left_out = pixels.begin();
    for (std::size_t i = 0; i < image.size(); ++i) {
        if (left_out != pixels.end() && *left_out == i)
            ++left_out;
        else
            *out++ = image.data()[i];
    }
    return rest;
}

} // namespace tessera
