#include "render/settings/settings_table.h"
#include "ui/settings/settings_file.h"
#include "ui/state/words.h"

namespace tessera {

std::vector<Setting> settings_of(Pace& pace) {
    return {
        {"equal", "Panes have", "How the panes share the cores.", one_of(words::shares, pace.equal)},
        {"spp_limit", "Stop at spp", "Samples a pixel after which the panes rest. 0: they never do.",
         Setting::Whole{&pace.spp_limit, 0, most_spp}},
        {"seconds_limit", "Stop at seconds",
         "Seconds (wall time) of a pane's own passes after which it rests. 0: it never does.",
         Setting::Seconds{&pace.seconds_limit, 0, most_seconds}},
    };
}

std::vector<Setting> settings_of(Tone& tone) {
    const float low = ranges::exposure.low(), high = ranges::exposure.high();
    return {
        {"tone", "Tone curve", "How radiance becomes brightness on the screen (Y).",
         one_of(words::tones, tone.curve)},
        {"exposure", "Exposure", "Brightness on the screen: every stop doubles it. Gradients are enlarged alike.",
         Setting::Real{&tone.exposure, low, high, low, high, "%+.1f stops"}},
        {"gamma", "Gamma", "The exponent's inverse (no unit).", Setting::Real{&tone.gamma, 1, 4, 1, 4, "%.2f"},
         tone.curve == Tone::Curve::gamma},
    };
}

Setting comparison_setting(Comparison::Kind& kind) {
    return {"comparison", "Active pane", "How the active pane shows another one's picture.",
            one_of(words::comparisons, kind)};
}

Setting size_base_setting(SizeChoice::Base& base) {
    return {"size", "Size", "How many pixels are rendered.", one_of(words::sizes, base)};
}

Setting custom_size_setting(glm::ivec2& size) {
    return size_setting(size, most_render_pixels_an_edge);
}

std::vector<Setting> shared_settings_of(PaneSettings& pane) {
    std::vector<Setting> all = settings_of(pane.render);
    for (const Setting& setting : settings_of(pane.reconstruction))
        all.push_back(setting);
    all.push_back(seed_setting(pane.render.seed));
    return all;
}

} // namespace tessera
