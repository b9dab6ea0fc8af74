#include "render/settings/settings_table.h"

#include <array>
#include <cctype>
#include <stdexcept>
#include <string>
#include <system_error>
#include <type_traits>

#include <fmt/core.h>

namespace tessera {

namespace {

constexpr SettingChoice methods[] = {
    {"pt", "Path tracing",
     "Each pixel uses its own paths only. Emitter and BSDF sampling are combined by multiple importance sampling "
     "[Veach 1997]."},
    {"pr", "Path reusing",
     "Each base path contributes to all pixels of its tile. There is less noise, which is correlated within a "
     "tile [Bekaert 2002, Bauszat 2017]."},
    {"gpt", "Gradient-domain path tracing",
     "Each path is shifted to the neighbours of its pixel, which measures gradients with little noise. The "
     "picture is reconstructed from gradients and primal [Kettunen 2015]."},
    {"gpr", "Gradient-domain path reusing",
     "Gradients as in G-PT, from paths that are reused within a tile as in PR [Bauszat 2017]."},
};
static_assert(std::size(methods) == std::size(all_methods));

constexpr SettingChoice patterns[] = {
    {"tile", "square tile", "All pixels of a square reuse each other's paths."},
    {"rooks", "N-rooks",
     "N pixels of an N x N square, one in each row and column, reuse each other's paths. Pixels side by side are "
     "in different sets and share no base path [Bekaert 2002]. PR only."},
};
constexpr SettingChoice shift_kinds[] = {
    {"half-vector", "half vectors, reconnection",
     "Copies half vectors until two rough vertices can be connected. Paths are reused in mirrors and through "
     "glass, too [Kettunen 2015, Bauszat 2017]."},
    {"reconnection", "reconnection of x1 and x2",
     "Connects the first hit of one pixel to the second hit of another. Direct light is not reused [Bekaert "
     "2002]."},
    {"replay", "random replay", "The whole path of the other pixel uses the same random numbers [Hua 2019, 3.1]."},
    {"replay-reconnection", "replay, reconnection",
     "Replays random numbers until two rough vertices can be connected [Hua 2019, 3.1]."},
};
constexpr SettingChoice texture_filters[] = {
    {"off", "off", "Textures are looked up at points, as in Mitsuba."},
    {"camera", "by camera",
     "Texture values are means over the footprint of a camera ray, at every surface as if the camera saw it "
     "directly. Less noise at few samples where a pixel covers much of a texture. Blurs by less than a pixel."},
    {"path", "by path",
     "The same, but in mirrors and through glass with the footprint of the path [Suykens 2001]."},
};
constexpr SettingChoice guidings[] = {
    {"off", "off", "No direction is drawn from earlier passes."},
    {"auto", "automatic",
     "Guides paths in scenes where earlier passes show that the lower variance outweighs the cost. Other scenes "
     "get the same bits as with off."},
    {"on", "on", "Guides paths in every scene, except at places where samples show no gain."},
};
constexpr SettingChoice roulette_kinds[] = {
    {"relative", "relative", "Relative to the noise of the tile. Independent of the unit of radiance."},
    {"absolute", "absolute", "Relative to RR delta, a radiance [Bauszat 2017, 3.3]."},
    {"none", "none", "Every path is reused."},
};
constexpr SettingChoice bases[] = {
    {"none", "none", "The radiance itself."},
    {"albedo", "albedo",
     "The radiance divided by the albedo, which is smooth where only textures vary. The result is multiplied by "
     "the mean albedo of each pixel, over points independent of the samples [Fang 2024]. Takes at least 168 bytes "
     "more per pixel."},
    {"sh1", "harmonics, 4",
     "The radiance divided by the albedo, in components by incident direction, which are smooth where normals "
     "vary, too [Fang 2024]. Four spherical harmonics, up to degree 1. Takes at least 568 bytes more per pixel."},
    {"sh2", "harmonics, 9",
     "As sh1, with nine spherical harmonics, up to degree 2. Takes at least 1068 bytes more per pixel."},
    {"sh3", "harmonics, 16",
     "As sh1, with sixteen spherical harmonics, up to degree 3. Takes at least 1768 bytes more per pixel."},
    {"box", "boxes, 9",
     "As sh1, with nine boxes that divide the sphere of directions into equal solid angles. Takes at least 1068 "
     "bytes more per pixel."},
};
constexpr SettingChoice filters[] = {
    {"box", "box", "The mean over the pixel's square."},
    {"tent", "tent", "Linear, 1 pixel from the centre to the end."},
    {"gaussian", "Gaussian", "Standard deviation 0.5 pixels, Mitsuba's default."},
    {"mitchell", "Mitchell-Netravali", "Cubic with B = C = 1/3. Sharpens slightly; its negative lobes add noise."},
    {"catmullrom", "Catmull-Rom", "Cubic with B = 0, C = 1/2. Sharper, with larger negative lobes."},
    {"lanczos", "Lanczos", "Three lobes."},
    {"scene", "the scene's", "The filter of the scene's sensor."},
};
} // namespace

std::string_view short_name(Method method) {
    return methods[static_cast<int>(method)].id;
}
std::string_view long_name(Method method) {
    return methods[static_cast<int>(method)].label;
}

std::span<const SettingChoice> method_choices() {
    return methods;
}

namespace {

/// Label and description of a reconstruction, without its guarantee.
struct NormText {
    std::string_view label, description;
};

NormText text_of(Norm norm) {
    switch (norm) {
    case Norm::none:
        return {"raw samples", "The raw primal image."};
    case Norm::l2:
        return {"L2",
                "Least squares of gradients and primal, on raw samples [Kettunen 2015]. Outliers leave blobs."};
    case Norm::l1:
        return {
            "L1",
            "Least absolute misfits of gradients and primal, on raw samples [Kettunen 2015]. Outliers vanish."};
    case Norm::mixed:
        return {"mixed", "Least absolute misfits of the gradients, least squares of the primal, on raw samples."};
    case Norm::uniform:
        return {"uniform",
                "Uniform control variates on raw samples: 50 times the mean of a pixel and its neighbours plus "
                "the gradients [Rousselle 2016]."};
    case Norm::weighted:
        return {"weighted", "Control variates weighted by variances, on raw samples: noisy gradients have less "
                            "weight [Rousselle 2016]."};
    case Norm::guided:
        return {"guided", "Tessera's denoiser on the weighted reconstruction: firefly suppression, and a "
                          "cross-bilateral filter guided by albedo, normal, depth and roughness."};
    case Norm::smoothed:
        return {"smoothed", "Tessera's denoiser on the primal image alone, for methods without gradients, too."};
    case Norm::oidn:
        return {"OIDN", "Intel's Open Image Denoise on the raw primal image, with albedo and normals, where its "
                        "library is found."};
    }
    return {};
}

/// Returns the guarantee as text: "Consistent: at few samples ...".
std::string guarantee_text(Norm norm) {
    const Guarantee guarantee = guarantee_of(norm);
    std::string kind(to_string(guarantee.convergence)), reason(guarantee.reason);
    kind[0] = static_cast<char>(std::toupper(kind[0]));
    reason[0] = static_cast<char>(std::tolower(reason[0]));
    return kind + ": " + reason;
}

} // namespace

std::span<const SettingChoice> norm_choices() {
    static const std::array<std::string, all_norms.size()> help = [] {
        std::array<std::string, all_norms.size()> texts;
        for (const Norm norm : all_norms)
            texts[static_cast<int>(norm)] = std::string(text_of(norm).description) + " " + guarantee_text(norm);
        return texts;
    }();
    static const std::array<SettingChoice, all_norms.size()> choices = [] {
        std::array<SettingChoice, all_norms.size()> rows;
        for (const Norm norm : all_norms)
            rows[static_cast<int>(norm)] = {to_string(norm), text_of(norm).label, help[static_cast<int>(norm)]};
        return rows;
    }();
    return choices;
}

Setting method_setting(Method& method) {
    return {"method", "Method", "How light paths are sampled.", one_of(methods, method)};
}

Setting seed_setting(std::uint64_t& seed) {
    return {"seed", "Seed", "Seed of the random numbers.", Setting::Natural{&seed}};
}

Setting spp_setting(int& spp, int least) {
    return {"spp", "Samples a pixel", "Samples a pixel.", Setting::Whole{&spp, least, most_spp}};
}

Setting threads_setting(int& threads, int least) {
    return {"threads", "Threads", "Number of render threads. 0: one per hardware thread.",
            Setting::Whole{&threads, least, most_threads}};
}

Setting size_setting(glm::ivec2& size, int most) {
    return {"size", "Size, pixels", "WIDTHxHEIGHT of the image, pixels.", Setting::Size{&size, most}};
}

std::vector<Setting> settings_of(RenderSettings& s) {
    const bool reuses = reuses_paths(s.method), shifts = s.method != Method::pt,
               reconnects = shifts && s.shift != ShiftKind::replay,
               uses_distance = reconnects && s.shift != ShiftKind::reconnection;
    return {
        {"tile", "Tile",
         "Edge of a tile, in pixels. The pixels of a tile reuse each other's paths. Used by PR and G-PR.",
         Setting::Whole{&s.tile, 1, most_tile}, reuses},
        {"adapt_tile", "Adaptive tiles",
         "Splits a tile where reusing paths costs more than it gains. With G-PR, pixels that gain nothing from "
         "reuse trace more paths of their own instead.",
         Setting::Switch{&s.adapt_tile}, can_split_tiles(s)},
        {"pattern", "Pattern", "Pixels that reuse each other's paths.", one_of(patterns, s.pattern),
         s.method == Method::pr},
        {"roulette", "Roulette", "Russian roulette that decides which base paths are reused.",
         one_of(roulette_kinds, s.roulette), reuses},
        {"rr_delta", "RR delta",
         "Absolute roulette: a path whose value (luminance, a radiance) is below delta is reused with "
         "probability value / delta, and at least 0.1. 0: every path is reused.",
         Setting::Real{&s.rr_delta, 0, 1e30f, 0, 10}, reuses && s.roulette == RouletteKind::absolute},
        {"basis", "Basis", "The quantity that is measured and reconstructed.", one_of(bases, s.basis),
         s.method != Method::pt},
        {"filter", "Filter",
         "Reconstruction filter of the picture. References are comparable only if they have the same filter.",
         one_of(filters, s.filter)},
        {"shift", "Shift", "How a base path is shifted to another pixel.", one_of(shift_kinds, s.shift), shifts},
        {"shift_distance", "Distance",
         "Assumed distance between pixels that reuse paths, in pixel widths. The shift copies the half vector "
         "where an edge is shorter than this, or a lobe narrower than the angle of this distance. 0: all edges "
         "are reconnected, as published.",
         Setting::Real{&s.shift_distance, 0, 1000, 0, 20}, uses_distance, true},
        {"max_depth", "Max depth",
         "Limit on the edges of a light path. 1: directly visible emission only. 2: direct light, too.",
         Setting::Whole{&s.max_depth, 1, most_edges}},
        {"filter_textures", "Filter textures",
         "Filter of reflectance textures. With PT, or without a basis, it applies to directly visible emitters, "
         "too.",
         one_of(texture_filters, s.filter_textures), true, true},
        {"path_guiding", "Path guiding",
         "Draws some directions at rough surfaces toward light that earlier passes found. Each place in the "
         "scene uses the fraction with the least variance there.",
         one_of(guidings, s.path_guiding), true, true},
        {"edge_rays", "Edge rays",
         "Traces several camera rays per sample where a pixel sees several surfaces, or the edge of a directly "
         "visible emitter. Off: one ray, as published.",
         Setting::Switch{&s.edge_rays}, true, true},
        {"roulette_depth", "RR depth",
         "Number of edges after which Russian roulette can end a path. It continues with a probability that "
         "follows the reflectance (0.1 to 0.95). 0: no roulette.",
         Setting::Whole{&s.roulette_depth, 0, most_edges}, true, true},
    };
}

std::vector<Setting> settings_of(ReconstructionSettings& s) {
    return {
        {"norm", "Reconstruction", "How the picture is reconstructed from primal and gradients.",
         one_of(norm_choices(), s.norm)},
        {"alpha", "Alpha",
         "Weight of the primal relative to the gradients, without unit. A smaller alpha gives a smoother picture.",
         Setting::Real{&s.alpha, 1e-4f, 1e3f, 0.001f, 10},
         s.norm != Norm::none && s.norm != Norm::uniform && s.norm != Norm::smoothed && s.norm != Norm::oidn},
    };
}

std::vector<Setting> settings_of(ReconstructionSettings& s, bool has_gradients) {
    std::vector<Setting> all = settings_of(s);
    const bool denoises_primal = applied(s.norm, false) != Norm::none;
    for (Setting& setting : all) {
        const bool needs_no_gradients = setting.id == "norm" && denoises_primal;
        setting.matters = setting.matters && (has_gradients || needs_no_gradients);
    }
    return all;
}

ReconstructionSettings applied(const ReconstructionSettings& settings, bool has_gradients) {
    if (has_gradients)
        return settings;
    return {.norm = applied(settings.norm, false)};
}

void check(const RenderSettings& settings) {
    RenderSettings copy = settings;
    for (const Setting& setting : settings_of(copy))
        if (!setting.is_allowed())
            throw std::invalid_argument(
                fmt::format("{} is {}: must be {}", setting.id, setting.text(), setting.allowed()));
}

} // namespace tessera
