#include "render/io/text.h"
#include "render/load/properties.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <string>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

constexpr int first_nm = 360;
constexpr int last_nm = 830;

// The CIE's standard illuminant D65, every 10 nm [ISO/CIE 11664-2].
constexpr double d65[] = {46.6383, 52.0891, 49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008,
                          117.812, 114.861, 115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046,
                          100.000, 96.3342, 95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268,
                          80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856, 75.0870, 63.5927,
                          46.4182, 66.8054, 63.3828, 64.3040, 59.4519, 51.9590, 57.4406, 60.3125};
static_assert(std::size(d65) == (last_nm - first_nm) / 10 + 1);

double d65_at(int nm) {
    const int i = std::min((nm - first_nm) / 10, static_cast<int>(std::size(d65)) - 2);
    const double t = (nm - first_nm) / 10.0 - i;
    return d65[i] + t * (d65[i + 1] - d65[i]);
}

/// Returns the linear sRGB colour of a spectrum: its integral with the CIE matching functions, divided by the
/// integral of y.
template <class Spectrum>
Rgb linear_rgb(const Spectrum& spectrum) {
    glm::dvec3 xyz(0);
    double y = 0;
    for (int nm = first_nm; nm <= last_nm; ++nm) {
        const glm::dvec3 weights(color_matching(static_cast<float>(nm)));
        xyz += weights * spectrum(static_cast<double>(nm));
        y += weights.y;
    }
    return rgb_of_xyz(glm::vec3(xyz / y));
}

double interpolate(const std::vector<glm::vec2>& samples, double nm) {
    const auto above = std::upper_bound(samples.begin(), samples.end(), nm,
                                        [](double x, glm::vec2 s) { return x < static_cast<double>(s.x); });
    if (above == samples.begin())
        return 0;
    const glm::dvec2 left = *std::prev(above);
    if (above == samples.end())
        return nm == left.x ? left.y : 0;
    const glm::dvec2 right = *above;
    return left.y + (right.y - left.y) * (nm - left.x) / (right.x - left.x);
}

} // namespace

Rgb rgb_of_spectrum(const std::vector<glm::vec2>& samples, SpectrumKind what) {
    if (samples.size() < 2)
        return Rgb(samples.empty() ? 0.0f : samples[0].y);
    if (what == SpectrumKind::emission)
        return glm::max(linear_rgb([&](double nm) { return interpolate(samples, nm); }), Rgb(0));
    const auto lit = [](double nm, double value) { return value * d65_at(static_cast<int>(nm)); };
    static const Rgb white = linear_rgb([&](double nm) { return lit(nm, 1); });
    const Rgb rgb = linear_rgb([&](double nm) { return lit(nm, interpolate(samples, nm)); }) / white;
    return glm::max(rgb, Rgb(0));
}

Rgb rgb_of_black_body(double kelvin) {
    // Planck's law: 2 h c^2 / wavelength^5 / (exp(h c / (wavelength k T)) - 1).
    constexpr double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23; // SI
    const auto radiance = [&](double nm) {
        const double m = nm * 1e-9;
        return 1e-9 * 2 * h * c * c / std::pow(m, 5) / std::expm1(h * c / (m * k * kelvin));
    };
    return glm::max(linear_rgb(radiance), Rgb(0));
}

namespace {

struct Dielectric {
    std::string_view name;
    float index;
};

// Indices of refraction at 589 nm and room temperature [Hecht, Optics].
constexpr Dielectric dielectrics[] = {
    {"vacuum", 1.0f},
    {"helium", 1.000036f},
    {"hydrogen", 1.000132f},
    {"air", 1.000277f},
    {"carbon dioxide", 1.00045f},
    {"water", 1.3330f},
    {"acetone", 1.36f},
    {"ethanol", 1.361f},
    {"carbon tetrachloride", 1.461f},
    {"glycerol", 1.4729f},
    {"benzene", 1.501f},
    {"silicone oil", 1.52045f},
    {"bromine", 1.661f},
    {"water ice", 1.31f},
    {"fused quartz", 1.458f},
    {"pyrex", 1.470f},
    {"acrylic glass", 1.49f},
    {"polypropylene", 1.49f},
    {"bk7", 1.5046f},
    {"glass", 1.5046f},
    {"sodium chloride", 1.544f},
    {"amber", 1.55f},
    {"pet", 1.5750f},
    {"diamond", 2.419f},
};

struct Metal {
    std::string_view symbol;
    ComplexIndex index;
};

// Measured spectra [Palik, Handbook of Optical Constants of Solids; SOPRA database] in Rec. 709 primaries, as
// published by the renderers Tungsten and Yocto/GL; negative values are set to 0. Names as in Mitsuba. AlSb is
// missing, because its red index is negative.
const Metal metals[] = {
    {"none", {Rgb(0), Rgb(1)}},
    {"a-C", {{2.944100f, 2.227150f, 1.968167f}, {0.887433f, 0.799322f, 0.815286f}}},
    {"Ag", {{0.155265f, 0.116723f, 0.138381f}, {4.828343f, 3.122246f, 2.146950f}}},
    {"Al", {{1.657460f, 0.880369f, 0.521229f}, {9.223869f, 6.269523f, 4.837001f}}},
    {"AlAs", {{3.605102f, 3.232937f, 2.217561f}, {0.000667f, 0.000000f, 0.007426f}}},
    {"Au", {{0.143119f, 0.374957f, 1.442479f}, {3.983160f, 2.385721f, 1.603215f}}},
    {"Be", {{4.185059f, 3.185060f, 2.784091f}, {3.835440f, 3.010126f, 2.869009f}}},
    {"Cr", {{4.369683f, 2.916702f, 1.654701f}, {5.206434f, 4.231365f, 3.754947f}}},
    {"CsI", {{2.144903f, 1.702316f, 1.662419f}, {0.000000f, 0.000000f, 0.000000f}}},
    {"Cu", {{0.200438f, 0.924033f, 1.102212f}, {3.912949f, 2.452848f, 2.142188f}}},
    {"Cu2O", {{3.549283f, 2.952062f, 2.736920f}, {0.113218f, 0.194666f, 0.600168f}}},
    {"CuO", {{3.245382f, 2.449629f, 2.197411f}, {0.520274f, 0.570737f, 0.717225f}}},
    {"d-C", {{2.711252f, 2.318581f, 2.228857f}, {0.000000f, 0.000000f, 0.000000f}}},
    {"Hg", {{2.398931f, 1.440025f, 0.909551f}, {6.327627f, 4.371941f, 3.421790f}}},
    {"HgTe", {{4.779527f, 3.230998f, 2.660025f}, {1.631983f, 1.580819f, 1.729575f}}},
    {"Ir", {{3.086410f, 2.082194f, 1.617887f}, {5.592151f, 4.067176f, 3.267261f}}},
    {"K", {{0.064049f, 0.046410f, 0.038184f}, {2.104216f, 1.348936f, 0.913211f}}},
    {"Li", {{0.265787f, 0.195610f, 0.220920f}, {3.540174f, 2.311131f, 1.668593f}}},
    {"MgO", {{2.089589f, 1.650722f, 1.594876f}, {0.000000f, 0.000000f, 0.000000f}}},
    {"Mo", {{4.483701f, 3.525458f, 2.776077f}, {4.111131f, 3.420872f, 3.150603f}}},
    {"Na", {{0.060267f, 0.056141f, 0.061991f}, {3.179291f, 2.112480f, 1.579094f}}},
    {"Nb", {{3.420135f, 2.790192f, 2.395586f}, {3.441382f, 2.737644f, 2.579913f}}},
    {"Ni", {{2.367275f, 1.663358f, 1.467055f}, {4.498833f, 3.050164f, 2.345427f}}},
    {"Rh", {{2.585795f, 1.860187f, 1.554428f}, {6.782293f, 4.702950f, 3.976089f}}},
    {"Se", {{4.059261f, 2.842695f, 2.820758f}, {0.754379f, 0.638515f, 0.521587f}}},
    {"Se-e", {{5.724272f, 4.165399f, 4.081610f}, {0.871375f, 1.105285f, 1.564779f}}},
    {"SiC", {{3.172345f, 2.525968f, 2.479362f}, {0.000000f, 0.000000f, 0.000010f}}},
    {"SnTe", {{4.525187f, 1.981153f, 1.281682f}, {0.000000f, 0.000000f, 0.000000f}}},
    {"Ta", {{2.062585f, 2.393092f, 2.628068f}, {2.408047f, 1.741371f, 1.947038f}}},
    {"Te", {{7.390840f, 4.482103f, 2.637071f}, {3.256141f, 3.527391f, 3.292168f}}},
    {"Te-e", {{7.509040f, 4.296460f, 2.369873f}, {5.584208f, 4.947623f, 3.997515f}}},
    {"ThF4", {{1.830719f, 1.442227f, 1.387649f}, {0.000000f, 0.000000f, 0.000000f}}},
    {"TiC", {{3.700467f, 2.837436f, 2.582303f}, {3.265691f, 2.351559f, 2.172786f}}},
    {"TiN", {{1.648469f, 1.150448f, 1.379780f}, {3.368460f, 1.943489f, 1.102012f}}},
    {"TiO2", {{3.456620f, 2.801708f, 2.905149f}, {0.000103f, 0.000000f, 0.000636f}}},
    {"TiO2-e", {{3.106557f, 2.513155f, 2.582384f}, {0.000029f, 0.000000f, 0.000178f}}},
    {"V", {{4.277513f, 3.513154f, 2.761126f}, {3.491184f, 2.889358f, 3.111697f}}},
    {"VC", {{3.657567f, 2.752730f, 2.532681f}, {3.068352f, 2.198669f, 1.963182f}}},
    {"VN", {{2.865601f, 2.119182f, 1.940077f}, {3.032326f, 2.056108f, 1.616293f}}},
    {"W", {{4.370703f, 3.300297f, 2.998267f}, {3.500678f, 2.604865f, 2.273193f}}},
};

} // namespace

std::optional<float> refraction_index(std::string_view name) {
    const std::string wanted = lower_case(name);
    for (const Dielectric& dielectric : dielectrics)
        if (dielectric.name == wanted)
            return dielectric.index;
    return {};
}

std::optional<ComplexIndex> metal_index(std::string_view name) {
    static constexpr std::string_view measured_by = "_palik"; // as in Mitsuba's Na_palik, Ni_palik, V_palik
    if (name.ends_with(measured_by))
        name.remove_suffix(measured_by.size());
    for (const Metal& metal : metals)
        if (metal.symbol == name)
            return metal.index;
    return {};
}

} // namespace tessera
