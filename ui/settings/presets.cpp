#include "ui/settings/presets.h"

#include <iterator>

namespace tessera {

namespace {

/// Returns settings without Tessera's additions: no tile splitting, basis expansion, minimum distance of
/// reconnections, Russian roulette on path length, path guiding, or additional camera rays at edges.
PaneSettings plain() {
    PaneSettings s;
    s.render.adapt_tile = false;
    s.render.basis = Basis::none;
    s.render.shift_distance = 0;
    s.render.roulette_depth = 0;
    s.render.path_guiding = Guiding::off;
    s.render.edge_rays = false;
    return s;
}

PaneSettings bekaert() {
    PaneSettings s = plain();
    s.render.pattern = Pattern::rooks;
    s.render.tile = 8;
    s.render.shift = ShiftKind::reconnection;
    s.render.roulette = RouletteKind::none;
    s.reconstruction.norm = Norm::none;
    return s;
}

PaneSettings kettunen() {
    PaneSettings s = plain();
    s.reconstruction.norm = Norm::l1;
    s.reconstruction.alpha = 0.2f;
    return s;
}

PaneSettings bauszat() {
    PaneSettings s = kettunen();
    s.render.tile = 6;
    s.render.roulette = RouletteKind::absolute;
    s.render.rr_delta = 0.1f;
    return s;
}

PaneSettings fang() {
    PaneSettings s = plain();
    s.render.basis = Basis::albedo;
    s.reconstruction.norm = Norm::mixed;
    s.reconstruction.alpha = 0.2f;
    return s;
}

constexpr Preset table[] = {
    {"ours", "Tessera", "The default settings.", [] { return PaneSettings(); }},
    {"bekaert2002", "Bekaert 2002",
     "PR as first published: N-rooks patterns of 8 pixels, reconnection from x1 to x2, direct light not reused, "
     "no Russian roulette on reuse.",
     bekaert},
    {"kettunen2015", "Kettunen 2015",
     "G-PT as first published: half-vector copy and reconnection, L1 with alpha 0.2, no albedo demodulation.",
     kettunen},
    {"bauszat2017", "Bauszat 2017",
     "PR and G-PR in tiles of 6 pixels, with absolute Russian roulette (RR delta 0.1, q min 0.1); L1, alpha 0.2.",
     bauszat},
    {"fang2024", "Fang 2024",
     "Gradients of albedo-demodulated radiance, mixed reconstruction: L1 for the gradients, L2 for the primal; "
     "alpha 0.2.",
     fang},
};

/// Returns the preset's settings with the settings that the pane keeps.
PaneSettings with_own(PaneSettings preset, const PaneSettings& pane) {
    preset.render.method = pane.render.method;
    preset.render.seed = pane.render.seed;
    preset.render.max_depth = pane.render.max_depth;
    preset.buffer = pane.buffer;
    preset.comparison = pane.comparison;
    return preset;
}

} // namespace

std::span<const Preset> presets() {
    return table;
}

void apply(const Preset& preset, PaneSettings& pane) {
    pane = with_own(preset.settings(), pane);
}

int preset_of(const PaneSettings& pane) {
    for (std::size_t i = 0; i < std::size(table); ++i)
        if (with_own(table[i].settings(), pane) == pane)
            return static_cast<int>(i);
    return -1;
}

} // namespace tessera
