#include "app/sweep_points.h"

#include "app/exit_codes.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/core.h>

namespace tessera {

namespace {

/// As the setting itself spells it: "0.10" is "0.1".
std::string spelled(const Setting& setting, std::string_view value) {
    RenderSettings settings;
    setting.set_text(settings, value);
    return setting.text(settings);
}

/// Every setting in turn, each time with all values of the variation.
std::vector<RenderSettings> varied(const std::vector<RenderSettings>& all, const Variation& variation) {
    std::vector<RenderSettings> result;
    for (RenderSettings settings : all) {
        for (const std::string& value : variation.values) {
            variation.setting->set_text(settings, value);
            result.push_back(settings);
        }
    }
    return result;
}

} // namespace

Variation parse_variation(std::string_view text) {
    try {
        const std::size_t equals = text.find('=');
        if (equals == text.npos)
            throw std::invalid_argument("must be SETTING=VALUE,VALUE,... such as tile=2,4,8");
        Variation variation{&setting_named(text.substr(0, equals)), {}};
        std::string_view rest = text.substr(equals + 1);
        for (bool more = true; more;) {
            const std::size_t comma = rest.find(',');
            variation.values.push_back(spelled(*variation.setting, rest.substr(0, comma)));
            more = comma != rest.npos;
            rest.remove_prefix(more ? comma + 1 : rest.size());
        }
        return variation;
    } catch (const std::invalid_argument& error) {
        throw BadInput(fmt::format("--vary {}: {}", text, error.what()));
    }
}

std::vector<SweepPoint> sweep_points(const RenderSettings& base, const std::vector<Method>& methods,
                                     const std::vector<Variation>& variations) {
    std::vector<RenderSettings> all;
    for (Method method : methods) {
        all.push_back(base);
        all.back().method = method;
    }
    for (const Variation& variation : variations)
        all = varied(all, variation);

    std::vector<SweepPoint> points;
    for (const RenderSettings& settings : all) {
        SweepPoint point{settings, {}};
        for (const Variation& v : variations)
            point.values.push_back(v.setting->matters(settings) ? v.setting->text(settings) : "");
        const auto is_same = [&](const SweepPoint& p) {
            return p.settings.method == settings.method && p.values == point.values;
        };
        if (std::none_of(points.begin(), points.end(), is_same))
            points.push_back(point);
    }
    return points;
}

} // namespace tessera
