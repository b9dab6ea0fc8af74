#include "recon/guided/joint_filter.h"

#include "recon/guided/feature_regression.h"
#include "recon/guided/shrinkage.h"
#include "recon/square_means.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <type_traits>
#include <utility>

#include <glm/common.hpp>

namespace tessera {

namespace {

/// Returns whether all channels are so small that sums and products of a kernel stay finite.
bool can_be_filtered(const RgbImage& image, const ParallelFor& parallel_for) {
    constexpr float largest = 1e28f;
    const auto is_large = [&](std::size_t i) {
        const Rgb c = image.data()[i];
        return !(std::abs(c.r) < largest && std::abs(c.g) < largest && std::abs(c.b) < largest);
    };
    return sum_over_pixels(image.width(), image.height(), parallel_for, is_large) == 0;
}

/// Filters planes of the picture with a known fit (Planes), or of picture and noise, which finds the fit
/// (NoisyPlanes).
template <class AnyPlanes>
class Filter {
    static constexpr bool has_noise = std::is_same_v<AnyPlanes, NoisyPlanes>;

public:
    Filter(const FeatureKernels& kernels, const Image<float>& local, const GuidedParameters& parameters,
           FilterFit& fit, const ParallelFor& parallel_for)
        : kernels_(kernels), local_(local), parameters_(parameters), fit_(fit), parallel_for_(parallel_for),
          width_(local.width()), height_(local.height()), dark_(width_, height_, Unfilled()) {
        for_pixels(width_, height_, parallel_for,
                   [&](std::size_t i) { dark_.data()[i] = parameters.dark * local.data()[i]; });
        make_planes(coarser_, width_, height_);
        if constexpr (has_noise)
            for (Plane* plane : {&brightness_, &weight_scratch_.pairs, &weight_scratch_.rows, &shrinkage_.sizes,
                                 &shrinkage_.noise, &shrinkage_.rows})
                *plane = Plane(width_, height_, Unfilled());
    }

    /// Replaces light by its last level plus the trusted differences of all levels, reconstruction (51). Returns
    /// false if stopped.
    bool filter_levels(AnyPlanes& light, const SolveWatch& watch) {
        auto differences = black_planes<AnyPlanes>(width_, height_, parallel_for_);
        const std::size_t levels = std::min(parameters_.levels, FilterFit::most_levels);
        for (std::size_t l = 0; l < levels; ++l) {
            if (!watch.goes_on(static_cast<int>(l), static_cast<int>(levels) + 1))
                return false;
            const int step = FeatureKernels::steps[l];
            if constexpr (has_noise)
                find_weights(light, l);
            write_kernel_means(light, fit_.weights[l], step, parallel_for_, coarser_);
            if constexpr (has_noise)
                find_trust(light, parameters_.noise_radius + step, fit_.trust[l]);
            add_difference(fit_.trust[l], light, coarser_, parallel_for_, differences);
            std::swap(light, coarser_);
        }
        for_pixels(width_, height_, parallel_for_, [&](std::size_t i) {
            for (std::size_t c = 0; c < light.size(); ++c)
                light[c].data()[i] += differences[c].data()[i];
        });
        return watch.goes_on(static_cast<int>(levels), static_cast<int>(levels) + 1);
    }

    /// Multiplies light and dark_ by the albedo of the features: light becomes radiance.
    void make_radiance(const FeatureImages& features, AnyPlanes& light) {
        for_pixels(width_, height_, parallel_for_, [&](std::size_t i) {
            const Rgb albedo = feature_albedo(features, i, parameters_.least_albedo);
            dark_.data()[i] *= brightness_of(albedo);
            for (std::size_t c = 0; c < light.size(); ++c)
                light[c].data()[i] *= albedo[static_cast<int>(c % 3)];
        });
    }

    /// Replaces radiance by its regression on features plus the trusted difference to it, reconstruction (55).
    void regress(AnyPlanes& radiance) {
        Plane weights(width_, height_, Unfilled()), rows(width_, height_, Unfilled());
        write_relative_weights(radiance, weights, rows);
        write_regressions(radiance, kernels_.features(), weights, parameters_.ridge, parallel_for_, coarser_);
        if constexpr (has_noise)
            find_trust(radiance, parameters_.noise_radius, fit_.regression_trust);
        add_difference(fit_.regression_trust, radiance, coarser_, parallel_for_, coarser_);
        std::swap(radiance, coarser_);
    }

private:
    /// Finds the kernel weights of a level, reconstruction (48) to (50).
    void find_weights(const NoisyPlanes& light, std::size_t level) {
        const int step = FeatureKernels::steps[level];
        Plane& noise = shrinkage_.noise;
        for_pixels(width_, height_, parallel_for_, [&](std::size_t i) {
            constexpr float largest = 1e9f; // its square stays finite
            const float bright = brightness_at(light, dark_.data()[i], i);
            noise.data()[i] = std::min(std::abs(mean_of(light, 3, i)) / bright, largest);
            brightness_.data()[i] = std::log(bright);
        });
        take_wide_means(noise, parameters_.noise_radius + step, shrinkage_.rows, parallel_for_);
        for_pixels(width_, height_, parallel_for_, [&](std::size_t i) {
            constexpr float gaussian_variance = std::numbers::pi_v<float> / 2; // over squared mean of |noise|
            noise.data()[i] *= gaussian_variance * noise.data()[i];
        });
        make_planes(fit_.weights[level], width_, height_);
        write_noisy_weights(kernels_.weights(level), brightness_, noise, step, parameters_, parallel_for_,
                            weight_scratch_, fit_.weights[level]);
    }

    void find_trust(const NoisyPlanes& finer, int radius, Plane& trust) {
        trust = Plane(width_, height_, Unfilled());
        write_trust(finer, coarser_, dark_, radius, parallel_for_, shrinkage_, trust);
    }

    /// Writes the weights of reconstruction (54), the inverse squared mean brightness around each pixel, so that
    /// relative errors count. The pixel's own brightness would favour pixels that noise makes dark, and darken the
    /// picture.
    void write_relative_weights(const AnyPlanes& radiance, Plane& weights, Plane& rows) {
        for_pixels(width_, height_, parallel_for_,
                   [&](std::size_t i) { weights.data()[i] = brightness_at(radiance, dark_.data()[i], i); });
        constexpr int radius = 2; // of the regression's squares
        take_wide_means(weights, radius, rows, parallel_for_);
        for_pixels(width_, height_, parallel_for_, [&](std::size_t i) {
            const float least = parameters_.dark * parameters_.least_albedo * local_.data()[i];
            const float root = std::min(least / weights.data()[i], 1.0f);
            weights.data()[i] = std::max(root * root, 1e-14f);
        });
    }

    const FeatureKernels& kernels_;
    const Image<float>& local_;
    const GuidedParameters& parameters_;
    FilterFit& fit_;
    const ParallelFor& parallel_for_;
    int width_, height_;
    Plane dark_; ///< `dark` L, which is added to brightness
    AnyPlanes coarser_;
    Plane brightness_;
    WeightScratch weight_scratch_;
    ShrinkageScratch shrinkage_;
};

template <class AnyPlanes>
NoisyPicture filter_planes(NoisyPicture picture, const FeatureImages& features, const FeatureKernels& kernels,
                           const Image<float>& local, const GuidedParameters& parameters, FilterFit& fit,
                           const ParallelFor& parallel_for, const SolveWatch& watch) {
    AnyPlanes planes;
    make_planes(planes, picture.image.width(), picture.image.height());
    write_light(picture.image, features, parameters.least_albedo, 0, parallel_for, planes);
    if constexpr (std::is_same_v<AnyPlanes, NoisyPlanes>)
        write_light(picture.noise, features, parameters.least_albedo, 3, parallel_for, planes);
    Filter<AnyPlanes> steps(kernels, local, parameters, fit, parallel_for);
    if (parameters.stages.filter && !steps.filter_levels(planes, watch))
        return {};
    steps.make_radiance(features, planes);
    if (parameters.stages.regression && !features.empty())
        steps.regress(planes);
    write_image(planes, 0, parallel_for, picture.image);
    if constexpr (std::is_same_v<AnyPlanes, NoisyPlanes>)
        write_image(planes, 3, parallel_for, picture.noise);
    return picture;
}

} // namespace

NoisyPicture filter(NoisyPicture picture, const FeatureImages& features, const FeatureKernels& kernels,
                    const Image<float>& local, const GuidedParameters& parameters, FilterFit& fit,
                    const ParallelFor& parallel_for, const SolveWatch& watch) {
    if (!can_be_filtered(picture.image, parallel_for) ||
        (!picture.noise.empty() && !can_be_filtered(picture.noise, parallel_for)))
        return picture;
    const auto filter_any = picture.noise.empty() ? filter_planes<Planes> : filter_planes<NoisyPlanes>;
    return filter_any(std::move(picture), features, kernels, local, parameters, fit, parallel_for, watch);
}

std::uint64_t bytes_to_filter(int width, int height) {
    constexpr std::uint64_t planes =
        3 * std::tuple_size_v<NoisyPlanes> + 7; // light, differences, coarser and scratch
    return planes * sizeof(float) * static_cast<std::uint64_t>(width) * height;
}

} // namespace tessera
