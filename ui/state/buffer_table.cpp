// What there is to know of buffers before any image of them.
#include "ui/state/buffer.h"

namespace tessera {

namespace {

using Family = BufferFamily;

constexpr BufferInfo table[] = {
    {Buffer::reconstruction, "reconstruction", "Reconstruction",
     "The picture made from primal and gradients; radiance.", Family::picture, ColourMap::radiance, "", 1},
    {Buffer::primal, "primal", "Primal", "The picture as measured, before any reconstruction; radiance.",
     Family::picture, ColourMap::radiance, "", 1},
    {Buffer::dx, "dx", "Gradient dx",
     "Right neighbour minus pixel, luminance: orange above zero, blue below; of the coefficient where the basis "
     "is "
     "the albedo. Measured by G-PT and G-PR.",
     Family::gradient, ColourMap::signed_difference, "", 1},
    {Buffer::dy, "dy", "Gradient dy",
     "Pixel below minus pixel, luminance: orange above zero, blue below; of the coefficient where the basis is "
     "the "
     "albedo. Measured by G-PT and G-PR.",
     Family::gradient, ColourMap::signed_difference, "", 1},
    {Buffer::reused, "reused", "Reuse count",
     "How many base paths of other pixels brought light to a pixel, once in each set, the mean of all passes. Not "
     "for PT.",
     Family::reuse, ColourMap::false_colour, "paths a pass", 1},
    {Buffer::outcomes, "outcomes", "Shift outcomes",
     "How the shifts of other pixels' base paths to a pixel ended: the mean of the outcomes' colours, black where "
     "none was tried. Its number, in differences, too, is the share that brought no light. Not for PT.",
     Family::reuse, ColourMap::own, "%", 100},
    {Buffer::survival, "survival", "Roulette survival",
     "Of a pixel's own base paths that carry light, the share that the roulette on reuse let be shifted to the "
     "others of its tile (all passes; 0 where none has carried light). A survivor weighs 1/q for its probability "
     "q; "
     "roulette none and G-PT reuse all: 100 %. Not for PT.",
     Family::reuse, ColourMap::false_colour, "%", 100},
    {Buffer::very_direct, "very_direct", "Very direct",
     "Emission that the camera itself sees, straight or in mirrors; radiance. It is added after the "
     "reconstruction.",
     Family::picture, ColourMap::radiance, "", 1},
    {Buffer::error_relative_squared, "relMSE", "Error: relMSE",
     "(I - r)^2 / (r^2 + 0.001), the mean of red, green and blue, of the picture I and the reference r (no unit). "
     "Its mean over the pixels is the relMSE of [Bauszat 2017, 4].",
     Family::error, ColourMap::false_colour, "", 1},
    {Buffer::error_squared, "squared", "Error: squared",
     "(I - r)^2, the mean of red, green and blue, of the picture I and the reference r; radiance squared.",
     Family::error, ColourMap::false_colour, "", 1},
    {Buffer::error_absolute, "absolute", "Error: absolute",
     "|I - r|, the mean of red, green and blue, of the picture I and the reference r; radiance.", Family::error,
     ColourMap::false_colour, "", 1},
    {Buffer::error_relative, "relative", "Error: relative",
     "|I - r| / (|r| + 0.01), the mean of red, green and blue, of the picture I and the reference r; per cent.",
     Family::error, ColourMap::false_colour, "%", 100},
    {Buffer::reference, "reference", "Reference", "The picture that errors are measured against; radiance.",
     Family::reference, ColourMap::radiance, "", 1},
    {Buffer::albedo, "albedo", "Albedo",
     "The share of light that the surface first seen would send to the camera if it came from everywhere (no "
     "unit).",
     Family::first_hit, ColourMap::radiance, "", 1},
    {Buffer::normal, "normal", "Normal",
     "The shading normal of the surface first seen, in the world: x is red, y green, z blue; -1 is black, 1 full.",
     Family::first_hit, ColourMap::direction, "", 1},
    {Buffer::depth, "depth", "Depth",
     "The distance from the camera to the surface first seen, in units of the scene; 0: there is none.",
     Family::first_hit, ColourMap::false_colour, "units", 1},
    {Buffer::footprint_1, "footprint_1", "Footprint at x1",
     "How wide the part of the surface first seen is that a path stands for, at one sample a pixel: the root of "
     "the "
     "area of its footprint by path differentials [Suykens 2001], in units of the scene.",
     Family::first_hit, ColourMap::false_colour, "units", 1},
    {Buffer::footprint_2, "footprint_2", "Footprint at x2",
     "The same at the second vertex, the median of five paths: wide where light is scattered widely, narrow in "
     "mirrors, and in glossy surfaces between. Where it is wider than what pixels see, they can share the path.",
     Family::first_hit, ColourMap::false_colour, "units", 1},
    {Buffer::primal_variance, "primal_variance", "Variance of primal",
     "Variance of the primal's mean over the passes, the sum of red, green and blue; radiance squared. It falls "
     "with the samples; of the coefficient where the basis is the albedo. Pixels that share light err alike: "
     "their variances do not tell that.",
     Family::variance, ColourMap::false_colour, "radiance^2", 1},
    {Buffer::dx_variance, "dx_variance", "Variance of dx",
     "Variance of the mean of gradient dx over the passes, the sum of red, green and blue; radiance squared.",
     Family::variance, ColourMap::false_colour, "radiance^2", 1},
    {Buffer::dy_variance, "dy_variance", "Variance of dy",
     "Variance of the mean of gradient dy over the passes, the sum of red, green and blue; radiance squared.",
     Family::variance, ColourMap::false_colour, "radiance^2", 1},
    {Buffer::coefficient, "coefficient", "Coefficient",
     "Radiance over the albedo, as sampled: what gradients and variances are of, and the picture is made of, "
     "where "
     "the basis is the albedo; radiance.",
     Family::basis, ColourMap::radiance, "", 1},
    {Buffer::mean_albedo, "mean_albedo", "Mean albedo",
     "The mean of the albedos at many points of a pixel, which the reconstructed coefficient is multiplied by; no "
     "unit. Black where nothing is seen.",
     Family::basis, ColourMap::radiance, "", 1},
    {Buffer::sampled_albedo, "sampled_albedo", "Sampled albedo",
     "The mean of the albedos that the samples were divided by; no unit. It differs from the mean albedo by noise "
     "alone.",
     Family::basis, ColourMap::radiance, "", 1},
    {Buffer::covariance, "covariance", "Covariance term",
     "Mean radiance minus mean albedo times mean coefficient, of the samples, luminance: orange above zero, blue "
     "below. At edges, where albedo and light change together within a pixel, the picture needs it.",
     Family::basis, ColourMap::signed_difference, "", 1},
    {Buffer::projection, "projection", "Projection",
     "How much a pixel's surface scatters of one part of the light, times which the parts are the coefficient; no "
     "unit: orange above zero, blue below. Of a basis with parts; the command Next part goes on.",
     Family::basis, ColourMap::signed_difference, "", 1},
    {Buffer::redistributed, "redistributed", "Redistributed fireflies",
     "Radiance of a pixel's brightest sample that the denoiser clamps and redistributes to the pixels around. It "
     "decreases with the number of samples, and is zero before the second sample.",
     Family::picture, ColourMap::radiance, "", 1},
    {Buffer::reuse_set_size, "reuse_set_size", "Reuse set size",
     "Number of pixels in a pixel's reuse set in the next pass, including the pixel: those of its tile or tile "
     "split, "
     "and of G-PR's border. With G-PR the pixel can also be in the border of other tiles. 1: the pixel reuses no "
     "paths "
     "and takes several base paths of its own. PR and G-PR only.",
     Family::reuse, ColourMap::false_colour, "pixels", 1},
    {Buffer::gain, "gain", "Gain of sharing",
     "What sharing brings for its cost: how many times as many paths a path tracer takes for the same error, in "
     "squares of 16 x 16 pixels, as found before the first pass (no unit). Where it is below 1, pixels share "
     "nothing; 0: nothing is known. Of G-PR whose tiles adapt.",
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
