// Means, variances and half differences of a film's sums.
#include "render/film/film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr double largest_variance = std::numeric_limits<float>::max();

double scale_of_means(int passes) {
    return passes > 0 ? 1.0 / passes : 0.0;
}

/// Returns the variance of a mean over n, from the sample variance (squares - |sum|^2 / n) / (n - 1).
template <class Moments>
float variance_of(const Moments& m, double n) {
    const double spread = m.squares - glm::dot(m.sum, m.sum) / n; // rounding can make it negative
    return static_cast<float>(std::clamp(spread / (n * (n - 1)), 0.0, largest_variance));
}

} // namespace

/// Measures how albedo a, radiance v and coefficient e of pixel i vary from sample to sample. With S for sums of
/// products of deviations from the means, the part of e that follows a explains S_ea^2 / S_aa of S_ee. The rest
/// gives V_e' of reconstruction (47). Since a e = v, S_ea follows from the mean of v. For samples that are means,
/// S_aa includes the variance within them and S_ea does not, so the explained part is underestimated.
void Film::measure_samples(std::size_t i, int passes, Demodulation& result) const {
    const double n = passes;
    AlbedoSums mean = albedos_.data()[i];
    mean /= n;
    const Moments& primal = pixels_.data()[i].primal;
    const glm::dvec3 e = primal.sum / n;
    const glm::dvec3 beside = beside_.empty() ? glm::dvec3(0) : beside_.data()[i] / n;
    const glm::dvec3 variance = glm::max(mean.variance(), 0.0);
    const glm::dvec3 with_light = mean.value - beside - mean.albedo * e;
    const double all = primal.squares - n * glm::dot(e, e);
    double explained = 0;
    for (int c = 0; c < 3; ++c)
        explained += variance[c] > 0 ? n * with_light[c] * with_light[c] / variance[c] : 0;
    result.sampled_variance.data()[i] = Rgb(variance);
    result.value_covariance.data()[i] = Rgb(mean.covariance());
    result.unexplained_variance.data()[i] =
        static_cast<float>(std::clamp((all - explained) / (n * std::max(n - 2, 1.0)), 0.0, largest_variance));
}

Demodulation Film::demodulation(int passes) const {
    if (albedos_.empty())
        return {};
    const RgbImage black(width(), height());
    const Image<float> none(width(), height());
    Demodulation result{black, black, black, none, none, black, black, none};
    // The variance of a mean of albedos over n points of a net falls about as n^-1.5.
    const double scale = scale_of_means(passes), samples = std::pow(passes, 1.5);
    for (std::size_t i = 0; i < albedos_.size(); ++i) {
        result.value.data()[i] = Rgb(albedos_.data()[i].value * scale);
        result.sampled_albedo.data()[i] = Rgb(albedos_.data()[i].albedo * scale);
        result.albedo.data()[i] = features_.albedo(i);
        result.albedo_variance.data()[i] = features_.albedo_variance(i);
        result.sampled_weight.data()[i] =
            static_cast<float>(samples / (samples + std::pow(features_.count(i), 1.5)));
        if (passes > 1)
            measure_samples(i, passes, result);
    }
    return result;
}

std::vector<BasisComponent> Film::component_means(int passes) const {
    const RgbImage black(width(), height());
    const Image<float> none = passes > 1 ? Image<float>(width(), height()) : Image<float>();
    std::vector<BasisComponent> result;
    const double scale = scale_of_means(passes);
    for (int l = 0; l < buffers_.components; ++l) {
        BasisComponent& component =
            result.emplace_back(Image<float>(width(), height()), black, black, black, none, none, none);
        for (int y = 0; y < height(); ++y)
            for (int x = 0; x < width(); ++x) {
                const Component& sums = components_(x * buffers_.components + l, y);
                component.projection(x, y) = projection(x, y)[l];
                component.primal(x, y) = Rgb(sums.primal.sum * scale);
                component.dx(x, y) = Rgb(sums.dx.sum * scale);
                component.dy(x, y) = Rgb(sums.dy.sum * scale);
                if (passes < 2)
                    continue;
                component.primal_variance(x, y) = variance_of(sums.primal, passes);
                component.dx_variance(x, y) = variance_of(sums.dx, passes);
                component.dy_variance(x, y) = variance_of(sums.dy, passes);
            }
    }
    return result;
}

Film::HalfWeights Film::half_weights(int passes) const {
    const double balance = passes > 0 ? static_cast<double>(balance_) / passes : 0, kept = 1 - balance * balance;
    return {balance, kept > 0 ? 1 / std::sqrt(kept) : 1, passes};
}

/// Fills in dx and dy with their variances and half differences.
void Film::measure_gradients(int passes, GradientImages& images) const {
    const RgbImage black(gradients_.width(), gradients_.height());
    images.dx = images.dy = black;
    if (passes > 1) {
        images.dx_variance = images.dy_variance = Image<float>(black.width(), black.height());
        images.halves.dx = images.halves.dy = black;
    }
    const double scale = scale_of_means(passes);
    const HalfWeights half = half_weights(passes);
    for (std::size_t i = 0; i < gradients_.size(); ++i) {
        const GradientSums& sums = gradients_.data()[i];
        images.dx.data()[i] = Rgb(sums.dx.sum * scale);
        images.dy.data()[i] = Rgb(sums.dy.sum * scale);
        if (passes < 2)
            continue;
        images.dx_variance.data()[i] = variance_of(sums.dx, passes);
        images.dy_variance.data()[i] = variance_of(sums.dy, passes);
        images.halves.dx.data()[i] = half.difference(sums.half_dx, sums.dx);
        images.halves.dy.data()[i] = half.difference(sums.half_dy, sums.dy);
    }
}

/// Fills in the primal with its variance and half difference, directly visible emission, and the brightest
/// samples.
void Film::measure_pixels(int passes, GradientImages& images) const {
    const RgbImage black(width(), height()), none;
    const Image<float> numbers(width(), height());
    BrightestSamples& brightest = images.brightest;
    images.primal = images.very_direct = black;
    brightest = {black,
                 buffers_.gradients ? black : none,
                 buffers_.gradients ? black : none,
                 buffers_.albedo ? black : none,
                 numbers,
                 passes};
    if (passes > 1) {
        images.primal_variance = numbers;
        images.halves.primal = black;
    }
    const double scale = scale_of_means(passes);
    const HalfWeights half = half_weights(passes);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const PixelSums& sums = pixels_.data()[i];
        images.primal.data()[i] = Rgb(sums.primal.sum * scale);
        images.very_direct.data()[i] = Rgb(sums.very_direct * scale);
        brightest.primal.data()[i] = sums.brightest.primal;
        brightest.half.data()[i] = half.of_sample(sums.brightest.sign);
        if (buffers_.gradients) {
            brightest.dx.data()[i] = sums.brightest.dx;
            brightest.dy.data()[i] = sums.brightest.dy;
        }
        if (buffers_.albedo)
            brightest.albedo.data()[i] = sums.brightest.albedo;
        if (passes < 2)
            continue;
        images.primal_variance.data()[i] = variance_of(sums.primal, passes);
        images.halves.primal.data()[i] = half.difference(sums.half_primal, sums.primal);
    }
}

GradientImages Film::means(int passes) const {
    GradientImages images;
    images.components = component_means(passes);
    images.demodulation = demodulation(passes);
    images.features = features_.images();
    measure_gradients(passes, images);
    measure_pixels(passes, images);
    return images;
}

GradientImages Film::take_means(int passes) {
    reuse_ = {};
    luminance_ = {};
    GradientImages images;
    images.components = component_means(passes);
    components_ = {};
    images.demodulation = demodulation(passes);
    images.features = features_.images();
    albedos_ = {};
    beside_ = {};
    features_.clear();
    measure_gradients(passes, images);
    gradients_ = {};
    measure_pixels(passes, images);
    pixels_ = {};
    return images;
}

Image<float> Film::coverage(int passes) const {
    Image<float> alpha(width(), height());
    const double scale = scale_of_means(passes);
    std::ranges::transform(pixels_, alpha.begin(), [=](const PixelSums& sums) {
        return static_cast<float>(std::clamp(sums.coverage * scale, 0.0, 1.0));
    });
    return alpha;
}

ReuseMaps Film::reuse_maps(int passes) const {
    ReuseMaps maps{reuse_, passes};
    if (!buffers_.means)
        return maps;
    maps.paths = Image<float>(width(), height());
    std::ranges::transform(pixels_, maps.paths.begin(),
                           [](const PixelSums& sums) { return static_cast<float>(sums.paths); });
    return maps;
}

} // namespace tessera
