#include "render/film.h"

#include <algorithm>
#include <utility>

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

Film::Film(int width, int height, const FilmBuffers& buffers)
    : primal_(width, height), very_direct_(width, height) {
    if (buffers.gradients) {
        dx_ = Sums(width, height);
        dy_ = Sums(width, height);
    }
    if (buffers.shifts)
        shifts_ = Image<Shifts>(width, height);
    if (buffers.base_luminance)
        base_luminance_ = Image<float>(width, height);
}

void Film::add(int x, int y, int pass, const PixelSample& sample, Counters& counters) {
    if (!is_finite(sample.primal) || !is_finite(sample.dx) || !is_finite(sample.dy) ||
        !is_finite(sample.very_direct)) {
        counters.refuse({pass, y, x});
        return;
    }
    if (!base_luminance_.empty())
        base_luminance_(x, y) = sample.base_luminance;
    if (!shifts_.empty()) {
        shifts_(x, y).arrived += sample.arrived;
        shifts_(x, y).failed += sample.failed;
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

ReuseMaps Film::reuse_maps(int passes) const {
    ReuseMaps maps{Image<float>(shifts_.width(), shifts_.height()),
                   Image<float>(shifts_.width(), shifts_.height())};
    for (std::size_t i = 0; i < shifts_.size(); ++i) {
        const auto arrived = static_cast<float>(shifts_.data()[i].arrived);
        const auto failed = static_cast<float>(shifts_.data()[i].failed);
        maps.reused.data()[i] = arrived / static_cast<float>(std::max(passes, 1));
        maps.failed.data()[i] = failed / std::max(arrived + failed, 1.0f);
    }
    return maps;
}

GradientImages Film::means(int passes) const {
    return {mean(primal_, passes), mean(dx_, passes), mean(dy_, passes), mean(very_direct_, passes)};
}

GradientImages Film::take_means(int passes) {
    const auto take = [passes](Sums& sums) { return mean(std::exchange(sums, {}), passes); };
    shifts_ = {};
    base_luminance_ = {};
    return {take(primal_), take(dx_), take(dy_), take(very_direct_)};
}

} // namespace tessera
