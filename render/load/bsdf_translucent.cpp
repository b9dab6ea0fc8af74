#include "render/io/text.h"
#include "render/load/bsdf_readers.h"
#include "render/load/plugins.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace tessera {

// BSDFs of Mitsuba 0.6 that transmit light without refraction.

namespace {

/// Scattering and absorption coefficients in 1/mm [Jensen 2001, fig. 5].
struct Medium {
    std::string_view name;
    Rgb sigma_s, sigma_a;
};
constexpr Medium media[] = {
    {"apple", {2.29f, 2.39f, 1.97f}, {0.0030f, 0.0034f, 0.046f}},
    {"chicken1", {0.15f, 0.21f, 0.38f}, {0.015f, 0.077f, 0.19f}},
    {"chicken2", {0.19f, 0.25f, 0.32f}, {0.018f, 0.088f, 0.20f}},
    {"cream", {7.38f, 5.47f, 3.15f}, {0.0002f, 0.0028f, 0.0163f}},
    {"ketchup", {0.18f, 0.07f, 0.03f}, {0.061f, 0.97f, 1.45f}},
    {"marble", {2.19f, 2.62f, 3.00f}, {0.0021f, 0.0041f, 0.0071f}},
    {"potato", {0.68f, 0.70f, 0.55f}, {0.0024f, 0.0090f, 0.12f}},
    {"skimmilk", {0.70f, 1.22f, 1.90f}, {0.0014f, 0.0025f, 0.0142f}},
    {"skin1", {0.74f, 0.88f, 1.01f}, {0.032f, 0.17f, 0.48f}},
    {"skin2", {1.09f, 1.59f, 1.79f}, {0.013f, 0.070f, 0.145f}},
    {"spectralon", {11.6f, 20.4f, 14.9f}, {0, 0, 0}},
    {"wholemilk", {2.55f, 3.21f, 3.77f}, {0.0011f, 0.0024f, 0.014f}},
};

Medium medium_parameter(Properties& p) {
    std::string name = p.text("material", "skin1");
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto find_named = [&](std::string_view wanted) {
        return std::find_if(std::begin(media), std::end(media), [&](const Medium& m) { return m.name == wanted; });
    };
    if (const auto known = find_named(name); known != std::end(media))
        return *known;
    p.note(*p.take("material"), "the medium '" + name + "' is not known and replaced by 'skin1'");
    return *find_named("skin1");
}

/// Reads a coefficient. Throws LoadError if it is negative.
Texture coefficient(LoadContext& context, Properties& p, std::string_view name, Rgb fallback) {
    const Texture texture = texture_parameter(context, p, name, fallback);
    const Rgb* sigma = std::get_if<Rgb>(&texture.kind);
    if (sigma && std::min({sigma->r, sigma->g, sigma->b}) < 0)
        p.take(name)->fail("'" + std::string(name) + "' must not be negative", "value");
    return texture;
}

/// Returns the mean cosine of the nested phase function; 0 without one.
float mean_cosine(LoadContext& context, Properties& p) {
    const std::optional<XmlElement> nested = context.take_one_nested(p, "phase");
    if (!nested)
        return 0;
    Properties phase(*nested, p.notes());
    float g = 0;
    if (phase.type() == "hg")
        g = phase.number("g", 0.8f);
    else if (phase.type() != "isotropic")
        p.note(*nested, "the phase function '" + phase.type() + "' is replaced by an isotropic one");
    else
        phase.report_unused();
    if (!(g > -1 && g < 1))
        phase.take("g")->fail("'g' must be above -1 and below 1", "value");
    return g;
}

} // namespace

Material read_diffuse_transmitter(LoadContext& context, Properties& p) {
    return {{}, DiffuseTransmitterMaterial{reflectance_parameter(context, p, "transmittance", Rgb(0.5f))}};
}

Material read_medium_layer(LoadContext& context, Properties& p) {
    MediumLayerMaterial layer;
    layer.by_share = p.has("sigma_t") || p.has("albedo");
    if (layer.by_share) {
        if (!p.has("sigma_t") || !p.has("albedo"))
            p.element().fail("'hk' needs both 'sigma_t' and 'albedo', or neither");
        layer.lost = coefficient(context, p, "sigma_t", Rgb(1));
        layer.scattered = reflectance_parameter(context, p, "albedo", Rgb(0.5f));
        p.ignore({"material"});
    } else {
        const Medium medium = medium_parameter(p);
        layer.scattered = coefficient(context, p, "sigma_s", medium.sigma_s);
        layer.lost = coefficient(context, p, "sigma_a", medium.sigma_a);
    }
    layer.thickness = p.number("thickness", 1);
    if (!(layer.thickness >= 0))
        p.take("thickness")->fail("'thickness' must not be negative", "value");
    layer.g = mean_cosine(context, p);
    return {{}, layer};
}

} // namespace tessera
