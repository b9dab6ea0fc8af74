#include "render/load/refraction_indices.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace tessera {

namespace {

struct Dielectric {
    std::string_view name;
    float index;
};

// At 589 nm and room temperature [Hecht, Optics].
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

// Measured spectra, seen in Rec. 709 primaries; the usual figures of other renderers.
const Metal metals[] = {
    {"none", {Rgb(0), Rgb(1)}},
    {"Ag", {{0.155265f, 0.116723f, 0.138381f}, {4.828343f, 3.122246f, 2.146950f}}},
    {"Al", {{1.657460f, 0.880369f, 0.521229f}, {9.223869f, 6.269523f, 4.837001f}}},
    {"Au", {{0.143119f, 0.374957f, 1.442479f}, {3.983160f, 2.385721f, 1.603215f}}},
    {"Cr", {{4.369683f, 2.916702f, 1.654701f}, {5.206434f, 4.231365f, 3.754947f}}},
    {"Cu", {{0.200438f, 0.924033f, 1.102212f}, {3.912949f, 2.452848f, 2.142188f}}},
    {"Hg", {{2.398931f, 1.440025f, 0.909551f}, {6.327627f, 4.371941f, 3.421790f}}},
    {"Ir", {{3.086410f, 2.082194f, 1.617887f}, {5.592151f, 4.067176f, 3.267261f}}},
};

std::string lower_case(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

} // namespace

std::optional<float> refraction_index(std::string_view name) {
    const std::string wanted = lower_case(name);
    for (const Dielectric& dielectric : dielectrics)
        if (dielectric.name == wanted)
            return dielectric.index;
    return {};
}

std::optional<ComplexIndex> metal_index(std::string_view name) {
    for (const Metal& metal : metals)
        if (metal.symbol == name)
            return metal.index;
    return {};
}

} // namespace tessera
