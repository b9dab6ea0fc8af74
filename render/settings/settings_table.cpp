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
     "Every pixel for itself: light and BSDF sampling, combined by multiple importance sampling [Veach 1997]."},
    {"pr", "Path reusing",
     "Each base path brings light to all pixels of its tile: less noise, alike within a tile [Bekaert 2002, "
     "Bauszat 2017]."},
    {"gpt", "Gradient-domain path tracing",
     "Each path is shifted to its pixel's neighbours, which measures gradients with little noise; the picture is "
     "reconstructed from these and the primal [Kettunen 2015]."},
    {"gpr", "Gradient-domain path reusing",
     "Gradients as G-PT has, from the paths that a tile shares as PR does [Bauszat 2017]."},
};
static_assert(std::size(methods) == std::size(all_methods));

constexpr SettingChoice patterns[] = {
    {"tile", "square tile", "All pixels of a square share their paths."},
    {"rooks", "N-rooks",
     "N pixels on an N x N square share their paths, one in each row and column, so that nothing repeats from a "
     "pixel to its neighbour [Bekaert 2002]. PR only."},
};
constexpr SettingChoice shift_kinds[] = {
    {"half-vector", "half vectors, reconnection",
     "Half vectors are copied until two rough vertices can be connected; mirrors and glass are reused, too "
     "[Kettunen 2015, Bauszat 2017]."},
    {"reconnection", "reconnection of x1 and x2",
     "The first hit of one pixel is joined to the second hit of another; direct light is each pixel's own "
     "[Bekaert 2002]."},
    {"replay", "random replay",
     "The other pixel's path takes the same random numbers, all the way [Hua 2019, 3.1]."},
    {"replay-reconnection", "replay, reconnection",
     "Random numbers are replayed until two rough vertices can be connected [Hua 2019, 3.1]."},
};
constexpr SettingChoice texture_filters[] = {
    {"off", "off", "Points of textures are looked up, as in Mitsuba."},
    {"camera", "by camera",
     "Means of what a pixel covers, wherever the camera sees it, or would see it: less noise at a few samples, "
     "where "
     "much of a texture is in a pixel. Softer by less than a pixel."},
    {"path", "by path", "The same, but in mirrors and through glass what a pixel covers there [Suykens 2001]."},
};
constexpr SettingChoice guidings[] = {
    {"off", "off", "Lights and BSDFs have all directions."},
    {"auto", "where it pays",
     "In scenes where passes tell that less noise makes up for the time that it takes; the others have the same "
     "bits as without."},
    {"on", "on", "In every scene, at places where samples do not tell that it is of no use."},
};
constexpr SettingChoice roulette_kinds[] = {
    {"relative", "relative", "Against the noise of the tile: the unit of light does not matter."},
    {"absolute", "absolute", "Against RR delta, a radiance [Bauszat 2017, 3.3]."},
    {"none", "none", "Every path is reused."},
};
constexpr SettingChoice bases[] = {
    {"none", "none", "The radiance itself."},
    {"albedo", "albedo",
     "The radiance over the albedo: the light that arrives is alike where textures differ. The picture is "
     "multiplied by the mean albedo of many points of each pixel [Fang 2024]. Takes 168 bytes a pixel more."},
    {"sh1", "harmonics, 4",
     "The light over the albedo in parts, by where it comes from: these are alike where normals differ, too "
     "[Fang 2024]. Four spherical harmonics, up to degree 1. Takes 568 bytes a pixel more."},
    {"sh2", "harmonics, 9", "The same with nine, up to degree 2. Takes 1068 bytes a pixel more."},
    {"sh3", "harmonics, 16", "The same with sixteen, up to degree 3. Takes 1768 bytes a pixel more."},
    {"box", "boxes, 9", "The same with nine parts of the sphere. Takes 1068 bytes a pixel more."},
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

/// Label and description of a reconstruction, without what guarantee_of() says.
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
                "Uniform control variates on raw samples: 50 times the mean of a pixel and its neighbours "
                "plus the gradients [Rousselle 2016]."};
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

/// "Consistent: at few samples ...".
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
    return {"seed", "Seed", "Of the random numbers.", Setting::Natural{&seed}};
}

Setting spp_setting(int& spp, int least) {
    return {"spp", "Samples a pixel", "Samples a pixel.", Setting::Whole{&spp, least, most_spp}};
}

Setting threads_setting(int& threads, int least) {
    return {"threads", "Threads", "Threads of the renderer; 0: one a hardware thread.",
            Setting::Whole{&threads, least, most_threads}};
}

Setting size_setting(glm::ivec2& size, int most) {
    return {"size", "Size, pixels", "WIDTHxHEIGHT of the image, pixels.", Setting::Size{&size, most}};
}

std::vector<Setting> settings_of(RenderSettings& s) {
    const bool shares = reuses_paths(s.method), shifts = s.method != Method::pt,
               joins = shifts && s.shift != ShiftKind::replay,
               joins_long_edges = joins && s.shift != ShiftKind::reconnection;
    return {
        {"tile", "Tile",
         "Edge of a tile, in pixels. The pixels of a tile reuse each other's paths. Used by PR and G-PR.",
         Setting::Whole{&s.tile, 1, most_tile}, shares},
        {"adapt_tile", "Adapt",
         "Cuts tiles into smaller ones where paths bring alike: there, many offsets cost more than they gain. "
         "Where "
         "sharing brings G-PR nothing, pixels take more paths of their own instead.",
         Setting::Switch{&s.adapt_tile}, has_tiles_to_cut(s)},
        {"pattern", "Pattern", "Which pixels share their paths.", one_of(patterns, s.pattern),
         s.method == Method::pr},
        {"roulette", "Roulette", "How it is decided which base paths are reused.",
         one_of(roulette_kinds, s.roulette), shares},
        {"rr_delta", "RR delta",
         "Absolute roulette: a path whose value (luminance, a radiance) is below delta is reused with probability "
         "value / delta. 0: every path is reused.",
         Setting::Real{&s.rr_delta, 0, 1e30f, 0, 10}, shares && s.roulette == RouletteKind::absolute},
        {"basis", "Basis", "What primal and gradients are measured of, and the picture is made of.",
         one_of(bases, s.basis), s.method != Method::pt},
        {"shift", "Shift", "How a path is taken to another pixel.", one_of(shift_kinds, s.shift), shifts},
        {"shift_distance", "Distance",
         "Shift distance: the distance between pixels that reuse paths, in pixel widths. The shift copies the "
         "half "
         "vector where an edge is shorter than this, or a lobe narrower than the angle of this distance. "
         "0: all edges are reconnected, as published.",
         Setting::Real{&s.shift_distance, 0, 1000, 0, 20}, joins_long_edges, true},
        {"max_depth", "Max depth", "Most edges of a light path. 1: only lamps seen directly; 2: and direct light.",
         Setting::Whole{&s.max_depth, 1, most_edges}},
        {"filter_textures", "Filter textures",
         "What of a texture a path looks up: colours of surfaces, and with PT of lamps that the camera sees.",
         one_of(texture_filters, s.filter_textures), true, true},
        {"path_guiding", "Path guiding",
         "Draws some of the directions at rough surfaces from where earlier passes found light to come from, by "
         "place in the scene: as many as have paid there. The BSDF has the others.",
         one_of(guidings, s.path_guiding), true, true},
        {"edge_rays", "Edge rays",
         "Traces several camera rays per sample where a pixel sees several surfaces, or the edge of a directly "
         "visible emitter. Off: one ray, as published.",
         Setting::Switch{&s.edge_rays}, true, true},
        {"roulette_depth", "RR depth",
         "Edges beyond which a path goes on with a probability that follows the reflectance it meets (at most "
         "0.95). 0: it goes on to the max depth.",
         Setting::Whole{&s.roulette_depth, 0, most_edges}, true, true},
    };
}

std::vector<Setting> settings_of(ReconstructionSettings& s) {
    return {
        {"norm", "Norm", "How the picture is made from primal and gradients (screened Poisson).",
         one_of(norm_choices(), s.norm)},
        {"alpha", "Alpha",
         "Weight of the primal against the gradients (no unit). Small: gradients alone decide on all but the "
         "mean, as far as they are trusted; with weights of their own alpha counts half.",
         Setting::Real{&s.alpha, 1e-4f, 1e3f, 0.001f, 10},
         s.norm != Norm::none && s.norm != Norm::uniform && s.norm != Norm::smoothed && s.norm != Norm::oidn},
    };
}

std::vector<Setting> settings_of(ReconstructionSettings& s, bool has_gradients) {
    std::vector<Setting> all = settings_of(s);
    const bool smooths = applied(s.norm, false) != Norm::none;
    for (Setting& setting : all) {
        const bool is_of_all = setting.id == "norm" && smooths;
        setting.matters = setting.matters && (has_gradients || is_of_all);
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
