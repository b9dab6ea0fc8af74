#include "render/session/picture_settings.h"

#include "render/method/settings_table.h"

#include <nlohmann/json.hpp>

namespace tessera {

using nlohmann::json;

namespace {

json value_json(const Setting& setting, const RenderSettings& s) {
    if (const auto* whole = std::get_if<Setting::Whole>(&setting.kind))
        return s.*whole->member;
    if (const auto* real = std::get_if<Setting::Real>(&setting.kind))
        return s.*real->member;
    if (const auto* on = std::get_if<Setting::Switch>(&setting.kind))
        return s.*on->member;
    return setting.text(s);
}

} // namespace

json settings_json(const SceneSource& scene, const RenderSettings& s, glm::ivec2 size, int spp, float alpha) {
    json settings{{"version", TESSERA_VERSION},
                  {"scene", to_string(scene)},
                  {"variables", scene.variables},
                  {"camera", scene.camera.string()},
                  {"method", short_name(s.method)},
                  {"width", size.x},
                  {"height", size.y},
                  {"spp", spp},
                  {"alpha", alpha},
                  {"seed", s.seed}};
    for (const Setting& setting : all_settings())
        settings[std::string(setting.id)] = value_json(setting, s);
    return settings;
}

} // namespace tessera
