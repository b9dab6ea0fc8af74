#include "app/crop.h"

#include "recon/metrics.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

float relative_error(Rgb value, Rgb truth) {
    const float error = luminance(value) - luminance(truth);
    return std::min(1.0f, error * error / (luminance(truth) * luminance(truth) + float(relative_mse_epsilon)));
}

/// sums(x, y) is that of all pixels left of x and above y.
Image<double> summed_errors(const RgbImage& reference, const std::vector<const RgbImage*>& pictures) {
    Image<double> sums(reference.width() + 1, reference.height() + 1);
    for (int y = 0; y < reference.height(); ++y) {
        double row = 0;
        for (int x = 0; x < reference.width(); ++x) {
            for (const RgbImage* picture : pictures)
                if (is_finite((*picture)(x, y)))
                    row += relative_error((*picture)(x, y), reference(x, y));
            sums(x + 1, y + 1) = sums(x + 1, y) + row;
        }
    }
    return sums;
}

bool overlap(PixelRect a, PixelRect b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

} // namespace

std::vector<PixelRect> choose_crops(const RgbImage& reference, const std::vector<const RgbImage*>& pictures,
                                    int edge, int count) {
    const Image<double> sums = summed_errors(reference, pictures);
    edge = std::min({edge, reference.width(), reference.height()});
    constexpr int step = 4; // pixels between squares that are tried
    std::vector<PixelRect> chosen;
    for (int i = 0; i < count; ++i) {
        PixelRect best{0, 0, 0, 0};
        double most = -1;
        for (int y = 0; y + edge <= reference.height(); y += step)
            for (int x = 0; x + edge <= reference.width(); x += step) {
                const PixelRect rect{x, y, x + edge, y + edge};
                const double sum = sums(rect.x1, rect.y1) - sums(rect.x0, rect.y1) - sums(rect.x1, rect.y0) +
                                   sums(rect.x0, rect.y0);
                const auto is_in = [&](PixelRect other) { return overlap(rect, other); };
                if (sum > most && std::none_of(chosen.begin(), chosen.end(), is_in)) {
                    most = sum;
                    best = rect;
                }
            }
        if (!best.empty())
            chosen.push_back(best);
    }
    return chosen;
}

RgbImage crop(const RgbImage& image, PixelRect rect) {
    RgbImage part(rect.width(), rect.height());
    for (int y = 0; y < part.height(); ++y)
        std::copy_n(image.row(rect.y0 + y) + rect.x0, part.width(), part.row(y));
    return part;
}

float usual_exposure(const RgbImage& image) {
    std::vector<float> values;
    for (Rgb c : image)
        values.push_back(std::isfinite(luminance(c)) ? luminance(c) : 0.0f);
    if (values.empty())
        return 0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() - 1) * 9 / 10;
    std::nth_element(values.begin(), at, values.end());
    return *at > 0 ? std::log2(0.8f / *at) : 0.0f;
}

} // namespace tessera
