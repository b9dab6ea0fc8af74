#include "render/film.h"

namespace tessera {

namespace {

RgbImage mean(const Image<glm::dvec3>& sums, int passes) {
    RgbImage image(sums.width(), sums.height());
    const double scale = passes > 0 ? 1.0 / passes : 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i)
        image.data()[i] = Rgb(sums.data()[i] * scale);
    return image;
}

} // namespace

Film::Film(int width, int height, bool gradients) : primal_(width, height), very_direct_(width, height) {
    if (!gradients)
        return;
    dx_ = Sums(width, height);
    dy_ = Sums(width, height);
}

void Film::add(int x, int y, const PixelSample& sample, Counters& counters) {
    if (!is_finite(sample.primal) || !is_finite(sample.dx) || !is_finite(sample.dy) ||
        !is_finite(sample.very_direct)) {
        ++counters.refused_samples;
        return;
    }
    primal_(x, y) += sample.primal;
    very_direct_(x, y) += sample.very_direct;
    if (dx_.empty())
        return;
    // The last column and row have no neighbour: their gradients stay 0.
    if (x + 1 < width())
        dx_(x, y) += sample.dx;
    if (y + 1 < height())
        dy_(x, y) += sample.dy;
}

GradientImages Film::means(int passes) const {
    return {mean(primal_, passes), mean(dx_, passes), mean(dy_, passes), mean(very_direct_, passes)};
}

} // namespace tessera
