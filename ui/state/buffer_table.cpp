#include "ui/state/buffer.h"

namespace tessera {

namespace {

using Family = BufferFamily;

constexpr BufferInfo table[] = {
    {Buffer::reconstruction, "reconstruction", "Result", "The picture of the chosen reconstruction; radiance.",
     Family::picture, ColourMap::radiance, "", 1},
    {Buffer::primal, "primal", "Primal", "The primal image, without reconstruction; radiance.", Family::picture,
     ColourMap::radiance, "", 1},
    {Buffer::dx, "dx", "Gradient dx",
     "Right neighbour minus pixel, luminance: orange above zero, blue below. With a basis, it is the "
     "difference of coefficients. Measured by G-PT and G-PR.",
     Family::gradient, ColourMap::signed_difference, "", 1},
    {Buffer::dy, "dy", "Gradient dy",
     "Pixel below minus pixel, luminance: orange above zero, blue below. With a basis, it is the difference of "
     "coefficients. Measured by G-PT and G-PR.",
     Family::gradient, ColourMap::signed_difference, "", 1},
    {Buffer::reused, "reused", "Reuse count",
     "Base paths of other pixels that contributed to a pixel, counted once per sampling set: mean of all "
     "passes. Not for PT.",
     Family::reuse, ColourMap::false_colour, "paths per pass", 1},
    {Buffer::outcomes, "outcomes", "Shift outcomes",
     "Outcomes of the shifts of other pixels' base paths to a pixel: mean of the outcomes' colours, black without "
     "shifts. Its value, also in differences, is the percentage of failed shifts. Not for PT.",
     Family::reuse, ColourMap::own, "%", 100},
    {Buffer::survival, "survival", "Roulette survival",
     "Of a pixel's base paths that carry light, the percentage that survives Russian roulette on reuse, in all "
     "passes; 0 without such paths. A survivor has the weight 1/q for its survival probability q. With roulette none, "
     "and for G-PT, all survive. Not for PT.",
     Family::reuse, ColourMap::false_colour, "%", 100},
    {Buffer::very_direct, "very_direct", "Directly visible emitters",
     "Emission that the camera sees directly or in mirrors; radiance. It is added after the reconstruction.",
     Family::picture, ColourMap::radiance, "", 1},
    {Buffer::error_relative_squared, "relMSE", "Error: relMSE",
     "(I - r)^2 / (r^2 + 0.001) for picture I and reference r, mean of red, green and blue; no unit. Its mean "
     "over the pixels is the relMSE of [Bauszat 2017, 4].",
     Family::error, ColourMap::false_colour, "", 1},
    {Buffer::error_squared, "squared", "Error: squared",
     "(I - r)^2 for picture I and reference r, mean of red, green and blue; radiance squared.", Family::error,
     ColourMap::false_colour, "", 1},
    {Buffer::error_absolute, "absolute", "Error: absolute",
     "|I - r| for picture I and reference r, mean of red, green and blue; radiance.", Family::error,
     ColourMap::false_colour, "", 1},
    {Buffer::error_relative, "relative", "Error: relative",
     "|I - r| / (|r| + 0.01) for picture I and reference r, mean of red, green and blue; per cent.", Family::error,
     ColourMap::false_colour, "%", 100},
    {Buffer::reference, "reference", "Reference", "The image that errors are measured against; radiance.",
     Family::reference, ColourMap::radiance, "", 1},
    {Buffer::albedo, "albedo", "Albedo",
     "Albedo of the surface seen first: the fraction of light that it scatters to the camera under uniform "
     "illumination; no unit.",
     Family::first_hit, ColourMap::radiance, "", 1},
    {Buffer::normal, "normal", "Normal",
     "Shading normal of the surface seen first, in world space: x is red, y green, z blue; -1 is black, 1 full.",
     Family::first_hit, ColourMap::direction, "", 1},
    {Buffer::depth, "depth", "Depth",
     "Distance from the camera to the surface seen first, in scene units; 0: no surface.", Family::first_hit,
     ColourMap::false_colour, "units", 1},
    {Buffer::footprint_1, "footprint_1", "Footprint at x1",
     "Width of a path's footprint on the surface seen first, at one sample per pixel: the square root of its "
     "area by path differentials [Suykens 2001], in scene units.",
     Family::first_hit, ColourMap::false_colour, "units", 1},
    {Buffer::footprint_2, "footprint_2", "Footprint at x2",
     "Width of a path's footprint at the second vertex, median of five paths: large after diffuse scattering, "
     "small after mirrors, between them after glossy scattering. Where it is larger than the distance between "
     "the points that neighbouring pixels see, they can reuse each other's paths.",
     Family::first_hit, ColourMap::false_colour, "units", 1},
    {Buffer::primal_variance, "primal_variance", "Variance of primal",
     "Variance of the primal's mean over the passes, sum of red, green and blue; radiance squared. With a "
     "basis, the variance of the coefficient. It decreases with the number of samples. Pixels that share paths "
     "have correlated errors, which variances do not show.",
     Family::variance, ColourMap::false_colour, "radiance^2", 1},
    {Buffer::dx_variance, "dx_variance", "Variance of dx",
     "Variance of the mean of gradient dx over the passes, sum of red, green and blue; radiance squared.",
     Family::variance, ColourMap::false_colour, "radiance^2", 1},
    {Buffer::dy_variance, "dy_variance", "Variance of dy",
     "Variance of the mean of gradient dy over the passes, sum of red, green and blue; radiance squared.",
     Family::variance, ColourMap::false_colour, "radiance^2", 1},
    {Buffer::coefficient, "coefficient", "Coefficient",
     "Demodulated radiance, that is radiance over albedo: mean of the samples; radiance. With a basis, "
     "gradients and variances refer to it, and the picture is reconstructed from it.",
     Family::basis, ColourMap::radiance, "", 1},
    {Buffer::mean_albedo, "mean_albedo", "Mean albedo",
     "Mean of the albedos at many points of a pixel, by which the reconstructed coefficient is multiplied; no "
     "unit. Black where nothing is seen.",
     Family::basis, ColourMap::radiance, "", 1},
    {Buffer::sampled_albedo, "sampled_albedo", "Sampled albedo",
     "Mean of the albedos by which the samples were divided; no unit. It differs from the mean albedo by noise "
     "only.",
     Family::basis, ColourMap::radiance, "", 1},
    {Buffer::covariance, "covariance", "Covariance term",
     "Mean radiance minus mean albedo times mean coefficient of the samples, luminance: orange above zero, blue "
     "below. It corrects the picture where albedo and light vary together within a pixel, for example at edges.",
     Family::basis, ColourMap::signed_difference, "", 1},
    {Buffer::projection, "projection", "Projection",
     "Projection of a pixel's scattering on one basis function: orange above zero, blue below; no unit. The "
     "coefficient is the sum of all components times their projections. For a basis with several components; the "
     "command Next component selects one.",
     Family::basis, ColourMap::signed_difference, "", 1},
    {Buffer::redistributed, "redistributed", "Redistributed fireflies",
     "Radiance of a pixel's brightest sample that the denoiser clamps and redistributes to the pixels around. It "
     "decreases with the number of samples, and is zero before the second sample.",
     Family::picture, ColourMap::radiance, "", 1},
    {Buffer::reuse_set_size, "reuse_set_size", "Reuse set size",
     "Number of pixels in a pixel's reuse set in the next pass, including the pixel: those of its tile or tile "
     "split, and of G-PR's border. With G-PR the pixel can also be in the border of other tiles. 1: the pixel "
     "reuses no paths and takes several base paths of its own. PR and G-PR only.",
     Family::reuse, ColourMap::false_colour, "pixels", 1},
    {Buffer::gain, "gain", "Gain of path reuse",
     "Squared error without path reuse over that with it, at equal cost; no unit. The pilot pass measures it in "
     "squares of 16 x 16 pixels. Pixels below 1 reuse no paths; 0: unknown. Only for G-PR with adaptive tiles.",
     Family::reuse, ColourMap::false_colour, "times", 1},
    {Buffer::samples, "samples", "Samples",
     "Base paths that a pixel has traced in all passes. A pass traces more than one where pixels reuse no paths.",
     Family::reuse, ColourMap::false_colour, "paths", 1},
};

} // namespace

const BufferInfo& info(Buffer buffer) {
    return entry_of(table, buffer);
}

std::string_view paper_name(Method method) {
    switch (method) {
    case Method::pt:
        return "PT";
    case Method::pr:
        return "PR";
    case Method::gpt:
        return "G-PT";
    case Method::gpr:
        return "G-PR";
    }
    return "";
}

} // namespace tessera
