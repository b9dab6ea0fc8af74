#include "app/experiment/setup.h"

#include "app/cli/terminal.h"
#include "render/settings/settings_table.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include <fmt/core.h>

namespace tessera {

std::vector<Setting> settings_of(PictureSettings& s) {
    std::vector<Setting> all = settings_of(s.render);
    for (Setting& setting : settings_of(s.reconstruction, has_gradients(s.render.method))) {
        if (setting.id == "norm") {
            setting.id = "recon";
            setting.label = "Reconstruction";
        }
        all.push_back(setting);
    }
    all.push_back(size_setting(s.size));
    all.push_back(threads_setting(s.threads, 1));
    return all;
}

std::string Variable::text(PictureSettings settings) const {
    return setting_named(settings_of(settings), id).text();
}
void Variable::set_text(PictureSettings& settings, std::string_view text) const {
    setting_named(settings_of(settings), id).set_text(text);
}
bool Variable::matters(PictureSettings settings) const {
    return setting_named(settings_of(settings), id).matters;
}
std::optional<double> Variable::number(PictureSettings settings) const {
    return setting_named(settings_of(settings), id).number();
}

Variable variable_named(std::string_view id) {
    PictureSettings any;
    const Setting setting = setting_named(settings_of(any), id);
    return {std::string(setting.id), std::string(setting.label)};
}

namespace {

/// Returns the value in the setting's own format: "0.1" for "0.10".
std::string spelled(const Variable& variable, std::string_view value) {
    PictureSettings settings;
    variable.set_text(settings, value);
    return variable.text(settings);
}

/// Returns all combinations of the given settings with the values of the variation.
std::vector<PictureSettings> varied(const std::vector<PictureSettings>& all, const Variation& variation) {
    std::vector<PictureSettings> result;
    for (PictureSettings settings : all) {
        for (const std::string& value : variation.values) {
            variation.variable.set_text(settings, value);
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
        Variation variation{variable_named(text.substr(0, equals)), {}};
        std::string_view rest = text.substr(equals + 1);
        for (bool more = true; more;) {
            const std::size_t comma = rest.find(',');
            variation.values.push_back(spelled(variation.variable, rest.substr(0, comma)));
            more = comma != rest.npos;
            rest.remove_prefix(more ? comma + 1 : rest.size());
        }
        return variation;
    } catch (const std::invalid_argument& error) {
        throw BadInput(fmt::format("--vary {}: {}", text, error.what()));
    }
}

std::vector<Setup> setups_of(const PictureSettings& base, const std::vector<Method>& methods,
                             const std::vector<Norm>& norms, const std::vector<Variation>& variations) {
    std::vector<PictureSettings> all;
    for (Method method : methods) {
        for (Norm norm : norms) {
            all.push_back(base);
            all.back().render.method = method;
            all.back().reconstruction.norm = norm;
        }
    }
    for (const Variation& variation : variations)
        all = varied(all, variation);

    std::vector<Setup> setups;
    for (const PictureSettings& settings : all) {
        Setup setup{settings, {}};
        setup.settings.reconstruction = applied(settings.reconstruction, has_gradients(settings.render.method));
        for (const Variation& v : variations)
            setup.values.push_back(v.variable.matters(settings) ? v.variable.text(settings) : "");
        const auto is_same = [&](const Setup& p) {
            return name_of(p) == name_of(setup) && p.values == setup.values;
        };
        if (std::none_of(setups.begin(), setups.end(), is_same))
            setups.push_back(setup);
    }
    return setups;
}

std::string name_of(const Setup& setup) {
    std::string name(short_name(setup.settings.render.method));
    if (has_gradients(setup.settings.render.method) || setup.settings.reconstruction.norm != Norm::none)
        name += fmt::format("-{}", to_string(setup.settings.reconstruction.norm));
    return name;
}

} // namespace tessera
