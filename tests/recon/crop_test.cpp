// Crops of a picture: a pixel depends on the samples around it, and not on the position of the picture's border.
#include "recon/picture/reconstruct.h"
#include "tests/recon/test_images.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace tessera::test {

namespace {

constexpr int tile = 4, samples = 16;

/// Returns noise that is equal within each tile, plus a little independent noise.
RgbImage tile_noise(int width, int height, std::uint32_t seed, float deviation) {
    const RgbImage tile_values = random_image(width / tile, height / tile, seed, 0, deviation);
    RgbImage noise = random_image(width, height, seed + 1, 0, 0.2f * deviation);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            noise(x, y) += tile_values(x / tile, y / tile);
    return noise;
}

/// Returns the light on walls of different normals: it falls off across them and has shadows that no feature
/// shows. Sets their features.
RgbImage lit_walls(int width, int height, FeatureImages& features) {
    RgbImage light(width, height);
    features = {RgbImage(width, height), RgbImage(width, height), Image<float>(width, height, 1),
                Image<float>(width, height, 1)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool faces_z = (x / 50 + y / 40) % 2 == 0;
            const float fall_off = 0.5f + 0.5f * std::cos(0.02f * static_cast<float>(x + y));
            light(x, y) = (x % 90 < 45 ? 1.0f : 0.3f) * (0.2f + fall_off) * Rgb(1, 0.9f, 0.8f);
            features.albedo(x, y) = x / 5 % 2 == 0 ? Rgb(0.7f, 0.5f, 0.3f) : Rgb(0.2f, 0.4f, 0.6f);
            features.normal(x, y) = faces_z ? Rgb(0, 0, 1) : Rgb(1, 0, 0);
        }
    return light;
}

void add(RgbImage& image, const RgbImage& other) {
    image = sum_of(image, other);
}

/// Gives one tile in 40 a firefly: its brightest sample adds 4 to the mean of all its pixels.
void add_firefly_tiles(GradientImages& images) {
    const int width = images.primal.width(), height = images.primal.height();
    constexpr float added = 4;
    BrightestSamples& b = images.brightest;
    b = {images.primal, images.dx, images.dy, {}, Image<float>(width, height, 1), samples};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if ((x / tile + 13 * (y / tile)) % 40 != 0)
                continue;
            b.primal(x, y) += Rgb(added * samples);
            images.primal(x, y) += Rgb(added);
            images.halves.primal(x, y) += Rgb(added);
            images.primal_variance(x, y) += 3 * added * added;
        }
}

/// Returns all images that the stages of `guided` read.
GradientImages whole_images(int width, int height) {
    constexpr float primal_noise = 0.2f, gradient_noise = 0.05f;
    GradientImages images;
    images.primal = lit_walls(width, height, images.features);
    images.dx = x_differences(images.primal);
    images.dy = y_differences(images.primal);
    add(images.primal, tile_noise(width, height, 1, primal_noise));
    add(images.dx, random_image(width, height, 3, 0, gradient_noise));
    add(images.dy, random_image(width, height, 4, 0, gradient_noise));
    images.halves = {tile_noise(width, height, 5, primal_noise), random_image(width, height, 7, 0, gradient_noise),
                     random_image(width, height, 8, 0, gradient_noise)};
    images.primal_variance = Image<float>(width, height, 3 * primal_noise * primal_noise);
    images.dx_variance = images.dy_variance = Image<float>(width, height, 3 * gradient_noise * gradient_noise);
    images.patch = tile;
    add_firefly_tiles(images);
    const FeatureImages features = images.features;
    demodulate(images);
    images.features = features;
    return images;
}

/// Calls visit(image) for all images of `images`.
template <class Visit>
void for_each_image(GradientImages& images, Visit&& visit) {
    Demodulation& d = images.demodulation;
    BrightestSamples& b = images.brightest;
    HalfDifferences& h = images.halves;
    FeatureImages& g = images.features;
    for (RgbImage* image :
         {&images.primal, &images.dx, &images.dy, &d.value, &d.albedo, &d.sampled_albedo, &d.sampled_variance,
          &d.value_covariance, &b.primal, &b.dx, &b.dy, &b.albedo, &h.primal, &h.dx, &h.dy, &g.albedo, &g.normal})
        visit(*image);
    for (Image<float>* image :
         {&images.primal_variance, &images.dx_variance, &images.dy_variance, &d.albedo_variance, &d.sampled_weight,
          &d.unexplained_variance, &b.half, &g.nearness, &g.roughness})
        visit(*image);
}

template <class Pixel>
Image<Pixel> cropped(const Image<Pixel>& image, PixelRect rect) {
    if (image.empty())
        return {};
    Image<Pixel> result(rect.width(), rect.height());
    for (int y = 0; y < rect.height(); ++y)
        for (int x = 0; x < rect.width(); ++x)
            result(x, y) = image(rect.x0 + x, rect.y0 + y);
    return result;
}

/// Sets the gradients and variances across the right and the lower border to 0.
void clear_border_gradients(GradientImages& images) {
    const int w = images.primal.width(), h = images.primal.height();
    for (RgbImage* dx : {&images.dx, &images.brightest.dx, &images.halves.dx})
        for (int y = 0; y < h; ++y)
            (*dx)(w - 1, y) = Rgb(0);
    for (RgbImage* dy : {&images.dy, &images.brightest.dy, &images.halves.dy})
        for (int x = 0; x < w; ++x)
            (*dy)(x, h - 1) = Rgb(0);
    for (int y = 0; y < h; ++y)
        images.dx_variance(w - 1, y) = 0;
    for (int x = 0; x < w; ++x)
        images.dy_variance(x, h - 1) = 0;
}

GradientImages cropped(GradientImages images, PixelRect rect) {
    for_each_image(images, [&](auto& image) { image = cropped(image, rect); });
    clear_border_gradients(images);
    return images;
}

/// The reconstruction of a crop, and the crop of the reconstruction.
struct Pictures {
    RgbImage of_crop, of_whole;

    Pictures(const GradientImages& images, PixelRect crop, Norm norm, const GuidedStages& stages) {
        const auto picture = [&](const GradientImages& from) {
            GuidedParameters parameters;
            parameters.stages = stages;
            Reconstructor reconstructor;
            reconstructor.set_parameters(parameters);
            return reconstructor.reconstruct(from, {norm}).image;
        };
        of_crop = picture(cropped(images, crop));
        of_whole = cropped(picture(images), crop);
    }

    /// Returns the relative rms difference in a rectangle of the crop.
    double difference(PixelRect inside) const {
        return relative_rms_difference(cropped(of_crop, inside), cropped(of_whole, inside));
    }
};

/// Relative rms differences over the pixels at least 10, 40 and 100 pixels from the border of a crop of 294x246.
struct Differences {
    double at_10, at_40, at_100;

    explicit Differences(Norm norm, const GuidedStages& stages = {}) {
        constexpr PixelRect crop{53, 37, 347, 283}; // not aligned with tiles or multigrid levels
        GradientImages images = whole_images(400, 320);
        clear_border_gradients(images);
        const Pictures pictures(images, crop, norm, stages);
        const auto at = [&](int depth) {
            return pictures.difference({depth, depth, crop.width() - depth, crop.height() - depth});
        };
        at_10 = at(10);
        at_40 = at(40);
        at_100 = at(100);
        std::cout << to_string(norm) << ": relative rms difference " << at_10 << " at 10 pixels, " << at_40
                  << " at 40, " << at_100 << " at 100\n";
    }
};

/// The difference falls with depth. It does not vanish, because redistributed energy also comes from pixels
/// outside of the crop.
TEST(Crop, ConvergesToTheWholeWithDepth) {
    for (const Norm norm : {Norm::guided, Norm::smoothed}) {
        const Differences d(norm);
        EXPECT_LT(d.at_10, 0.05) << to_string(norm);
        EXPECT_LT(d.at_100, 0.025) << to_string(norm);
        EXPECT_LT(d.at_100, 0.7 * d.at_10) << to_string(norm);
    }
}

/// `guided` keeps a difference, because its solver takes few steps.
TEST(Crop, WithoutRedistributionEqualsTheWholeFarFromTheBorder) {
    GuidedStages stages;
    stages.redistribution = false;
    const Differences guided(Norm::guided, stages), smoothed(Norm::smoothed, stages);
    EXPECT_LT(smoothed.at_10, 0.01);
    EXPECT_LT(smoothed.at_100, 1e-3);
    EXPECT_LT(guided.at_10, 0.03);
    EXPECT_LT(guided.at_100, 0.01);
}

/// A strip that is cut at the left only. Beyond the reach of all stages, the border has no influence.
TEST(Crop, EqualsTheWholeBeyondTheReachOfRedistribution) {
    constexpr int width = 1000, height = 60, cut = 53;
    GradientImages images = whole_images(width, height);
    clear_border_gradients(images);
    const Pictures pictures(images, {cut, 0, width, height}, Norm::smoothed, {});
    const auto difference = [&](int begin, int end) { return pictures.difference({begin, 0, end, height}); };
    const double near = difference(0, 50), far = difference(300, 400), beyond = difference(700, width - cut);
    std::cout << "smoothed: relative rms difference " << near << " up to 50 pixels, " << far
              << " from 300 to 400, " << beyond << " from 700\n";
    EXPECT_LT(far, 0.2 * near);
    EXPECT_LT(beyond, 1e-5);
}

} // namespace

} // namespace tessera::test
