#include "render/film/film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>

// What a film's sums say: means, variances and the like.

namespace tessera {

namespace {

constexpr double largest_variance = std::numeric_limits<float>::max();

/// An image of sum / passes, where `sum_of` gives the sum of an entry.
template <class Entry, class SumOf>
RgbImage means_of(const Image<Entry>& entries, int passes, SumOf sum_of) {
    RgbImage image(entries.width(), entries.height());
    const double scale = passes > 0 ? 1.0 / passes : 0.0;
    std::transform(entries.begin(), entries.end(), image.begin(),
                   [&](const Entry& entry) { return Rgb(sum_of(entry) * scale); });
    return image;
}

/// Of a mean over n, from the sample variance (squares - |sum|^2 / n) / (n - 1).
template <class Moments>
float variance_of(const Moments& m, double n) {
    const double spread = m.squares - glm::dot(m.sum, m.sum) / n; // below 0 by rounding alone
    return static_cast<float>(std::clamp(spread / (n * (n - 1)), 0.0, largest_variance));
}

/// The means and their variances.
template <class Moments>
void measure(const Image<Moments>& moments, int passes, RgbImage& mean, Image<float>& variance) {
    mean = means_of(moments, passes, [](const Moments& m) { return m.sum; });
    variance = {};
    if (passes < 2)
        return;
    variance = Image<float>(moments.width(), moments.height());
    std::transform(moments.begin(), moments.end(), variance.begin(),
                   [passes](const Moments& m) { return variance_of(m, passes); });
}

} // namespace

/// How albedo, value and coefficient of entry i changed from sample to sample. With S for sums over products of
/// differences to the means, the coefficient that follows the albedo explains S_ea^2 / S_aa of S_ee; a v / a is v.
/// (Of samples that are means, S_aa has what is within them, too, and S_ea has not: then less is explained than
/// could be.)
void Film::measure_samples(std::size_t i, int passes, Demodulation& result) const {
    const double n = passes;
    const glm::dvec3 a = sampled_albedo_.data()[i] / n, v = value_.data()[i] / n, e = primal_.data()[i].sum / n;
    const glm::dvec3 beside = beside_.empty() ? glm::dvec3(0) : beside_.data()[i] / n;
    const glm::dvec3 variance = glm::max(albedo_squares_.data()[i] / n - a * a, 0.0); // below 0 by rounding alone
    const glm::dvec3 with_value = albedo_values_.data()[i] / n - a * v, with_light = v - beside - a * e;
    const double all = primal_.data()[i].squares - n * glm::dot(e, e);
    double explained = 0;
    for (int c = 0; c < 3; ++c)
        explained += variance[c] > 0 ? n * with_light[c] * with_light[c] / variance[c] : 0;
    result.sampled_variance.data()[i] = Rgb(variance);
    result.value_covariance.data()[i] = Rgb(with_value);
    result.unexplained_variance.data()[i] =
        static_cast<float>(std::clamp((all - explained) / (n * std::max(n - 2, 1.0)), 0.0, largest_variance));
}

Demodulation Film::demodulation(int passes) const {
    if (value_.empty())
        return {};
    const auto sum = [](const glm::dvec3& s) { return s; };
    const RgbImage black(width(), height());
    const Image<float> none(width(), height());
    Demodulation result{means_of(value_, passes, sum),
                        black,
                        means_of(sampled_albedo_, passes, sum),
                        none,
                        none,
                        black,
                        black,
                        none};
    const double samples = std::pow(passes, 1.5);
    for (std::size_t i = 0; i < value_.size(); ++i) {
        result.albedo.data()[i] = looks_.albedo(i);
        result.albedo_variance.data()[i] = looks_.albedo_variance(i);
        result.sampled_share.data()[i] = static_cast<float>(samples / (samples + std::pow(looks_.count(i), 1.5)));
        if (passes > 1)
            measure_samples(i, passes, result);
    }
    return result;
}

std::vector<CoefficientPart> Film::part_means(int passes) const {
    const RgbImage black(width(), height());
    const Image<float> none = passes > 1 ? Image<float>(width(), height()) : Image<float>();
    std::vector<CoefficientPart> result;
    const double scale = passes > 0 ? 1.0 / passes : 0.0;
    for (int l = 0; l < parts_a_pixel_; ++l) {
        CoefficientPart& part =
            result.emplace_back(Image<float>(width(), height()), black, black, black, none, none, none);
        for (int y = 0; y < height(); ++y)
            for (int x = 0; x < width(); ++x) {
                const Part& sums = parts_(x * parts_a_pixel_ + l, y);
                part.projection(x, y) = projection(x, y)[l];
                part.primal(x, y) = Rgb(sums.primal.sum * scale);
                part.dx(x, y) = Rgb(sums.dx.sum * scale);
                part.dy(x, y) = Rgb(sums.dy.sum * scale);
                if (passes < 2)
                    continue;
                part.primal_variance(x, y) = variance_of(sums.primal, passes);
                part.dx_variance(x, y) = variance_of(sums.dx, passes);
                part.dy_variance(x, y) = variance_of(sums.dy, passes);
            }
    }
    return result;
}

BrightestSamples Film::brightest_samples(int passes) const {
    const auto image_of = [this](Rgb Brightest::*part) {
        RgbImage image(width(), height());
        std::transform(brightest_.begin(), brightest_.end(), image.begin(),
                       [part](const Brightest& b) { return b.*part; });
        return image;
    };
    const bool has_gradients = !dx_.empty();
    Image<float> half(width(), height());
    const auto balance = static_cast<float>(share_of_balance(passes));
    const auto scale = static_cast<float>(scale_of_halves(passes));
    std::ranges::transform(brightest_, half.begin(),
                           [=](const Brightest& b) { return scale * (b.sign - balance); });
    return {image_of(&Brightest::primal),
            has_gradients ? image_of(&Brightest::dx) : RgbImage(),
            has_gradients ? image_of(&Brightest::dy) : RgbImage(),
            value_.empty() ? RgbImage() : image_of(&Brightest::albedo),
            std::move(half),
            passes};
}

/// What makes up for the little of the noise that is left out where one half has more passes.
double Film::scale_of_halves(int passes) const {
    const double balance = share_of_balance(passes), kept = 1 - balance * balance;
    return kept > 0 ? 1 / std::sqrt(kept) : 1;
}

/// With n passes of signs s_k that sum to S, the mean of (s_k - S / n) x_k: its weights sum to zero, whatever n.
/// Their squares sum to n - S^2 / n, and are scaled to n, as those of the mean.
HalfDifferences Film::half_differences(int passes) const {
    if (passes < 2)
        return {};
    const double balance = share_of_balance(passes), scale = scale_of_halves(passes) / passes;
    const auto image_of = [&](const Image<Moments>& moments, Rgb Difference::*part) {
        RgbImage image(moments.width(), moments.height());
        for (std::size_t i = 0; i < image.size(); ++i)
            image.data()[i] =
                Rgb((glm::dvec3(differences_.data()[i].*part) - balance * moments.data()[i].sum) * scale);
        return image;
    };
    return {image_of(primal_, &Difference::primal), image_of(dx_, &Difference::dx),
            image_of(dy_, &Difference::dy)};
}

GradientImages Film::means(int passes) const {
    GradientImages images;
    measure(primal_, passes, images.primal, images.primal_variance);
    measure(dx_, passes, images.dx, images.dx_variance);
    measure(dy_, passes, images.dy, images.dy_variance);
    images.parts = part_means(passes);
    images.demodulation = demodulation(passes);
    images.very_direct = means_of(very_direct_, passes, [](const glm::dvec3& sum) { return sum; });
    images.brightest = brightest_samples(passes);
    images.halves = half_differences(passes);
    images.guides = looks_.guides();
    images.own = means_of(own_, passes, [](const glm::dvec3& sum) { return sum; });
    return images;
}

GradientImages Film::take_means(int passes) {
    reuse_ = {};
    paths_ = {};
    luminance_ = {};
    GradientImages images;
    images.parts = part_means(passes);
    parts_ = {};
    images.brightest = brightest_samples(passes);
    brightest_ = {};
    images.halves = half_differences(passes);
    differences_ = {};
    const auto take = [passes](Image<Moments>& moments, RgbImage& mean, Image<float>& variance) {
        measure(moments, passes, mean, variance);
        moments = {};
    };
    take(dx_, images.dx, images.dx_variance);
    take(dy_, images.dy, images.dy_variance);
    images.demodulation = demodulation(passes);
    images.guides = looks_.guides();
    looks_.clear();
    value_ = sampled_albedo_ = albedo_squares_ = albedo_values_ = beside_ = {};
    take(primal_, images.primal, images.primal_variance);
    images.own = means_of(own_, passes, [](const glm::dvec3& sum) { return sum; });
    own_ = {};
    images.very_direct = means_of(very_direct_, passes, [](const glm::dvec3& sum) { return sum; });
    return images;
}

ReuseMaps Film::reuse_maps(int passes) const {
    ReuseMaps maps{reuse_, passes};
    maps.paths = Image<float>(paths_.width(), paths_.height());
    std::ranges::transform(paths_, maps.paths.begin(), [](std::uint32_t n) { return static_cast<float>(n); });
    return maps;
}

} // namespace tessera
