#include "render/run/picture_identity.h"

#include "render/io/json_text.h"
#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "render/scene/scene_checksums.h"
#include "render/settings/settings_table.h"

#include <optional>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

nlohmann::json settings_json(const SceneSource& scene, RenderSettings s, glm::ivec2 size, int spp,
                             const ReconstructionSettings& reconstruction) {
    nlohmann::json json{{"version", TESSERA_VERSION},
                        {"scene", to_string(scene)},
                        {"variables", scene.variables},
                        {"camera", scene.camera.string()},
                        {"sensor", scene.sensor},
                        {"crop", scene.crop ? text_of(*scene.crop) : ""},
                        {"width", size.x},
                        {"height", size.y},
                        {"spp", spp},
                        {"alpha", reconstruction.alpha}};
    std::vector<Setting> settings = settings_of(s);
    settings.push_back(method_setting(s.method));
    settings.push_back(seed_setting(s.seed));
    for (const Setting& setting : settings)
        json[std::string(setting.id)] = setting.json_value();
    return json;
}

std::string picture_identity(const PictureSubject& subject, const RenderSettings& settings, glm::ivec2 size) {
    nlohmann::json identity = settings_json(subject.source, settings, size, 0, {});
    for (const char* ignored : {"spp", "alpha", "variables", "sensor", "crop"})
        identity.erase(ignored);
    identity["camera"] = parse_json(camera_json(subject.camera));
    identity["scene"] = to_string(checksums_of(subject.scene->description(), subject.camera));
    return to_text(identity);
}

std::string identity_difference(const std::string& theirs, const std::string& mine) {
    const nlohmann::json a = parse_json(theirs), b = parse_json(mine);
    for (const auto& [key, value] : b.items())
        if (a.is_object() && key != "scene" && key != "camera" && a.value(key, nlohmann::json()) != value)
            return fmt::format("{} {}, not {}", key, to_text(a.value(key, nlohmann::json())), to_text(value));
    if (!a.is_object() || a.size() != b.size())
        return "another version of the program";
    if (a["camera"] != b["camera"])
        return "another camera";
    const auto my_scene = scene_checksums_from(b.at("scene").get<std::string>());
    const auto their_scene =
        a.at("scene").is_string() ? scene_checksums_from(a.at("scene").get<std::string>()) : std::nullopt;
    if (!my_scene || !their_scene)
        return "another version of the program";
    const std::string parts = difference(*their_scene, *my_scene);
    return parts.empty() ? "" : "another scene (other " + parts + ")";
}

} // namespace tessera
