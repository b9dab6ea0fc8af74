#include "render/run/picture_identity.h"

#include "render/io/json_text.h"
#include "render/io/memory.h"
#include "render/run/render.h"
#include "render/scene/camera.h"
#include "render/settings/settings_table.h"

#include <fstream>
#include <iterator>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

nlohmann::json settings_json(const SceneSource& scene, RenderSettings s, glm::ivec2 size, int spp, float alpha) {
    nlohmann::json json{{"version", TESSERA_VERSION},
                        {"scene", to_string(scene)},
                        {"variables", scene.variables},
                        {"camera", scene.camera.string()},
                        {"width", size.x},
                        {"height", size.y},
                        {"spp", spp},
                        {"alpha", alpha}};
    std::vector<Setting> settings = settings_of(s);
    settings.push_back(method_setting(s.method));
    settings.push_back(seed_setting(s.seed));
    for (const Setting& setting : settings)
        json[std::string(setting.id)] = setting.json_value();
    return json;
}

namespace {

std::uint32_t checksum_of(const RgbImage& image, std::uint32_t before) {
    return checksum(std::as_bytes(std::span(image.data(), image.size())), before);
}

std::uint32_t checksum_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    return checksum(std::as_bytes(std::span(text.data(), text.size())));
}

std::uint32_t checksum_of_samples(const PictureSubject& subject, const RenderSettings& settings,
                                  ThreadPool& pool) {
    Render small(subject.scene, subject.camera, {48, 27}, settings);
    for (int i = 0; i < 4; ++i)
        small.pass(pool);
    const GradientImages images = small.take_images();
    std::uint32_t sum = checksum_of(subject.source.file);
    for (const RgbImage* image : {&images.primal, &images.dx, &images.dy, &images.very_direct})
        sum = checksum_of(*image, sum);
    return sum;
}

} // namespace

std::string picture_identity(const PictureSubject& subject, const RenderSettings& settings, glm::ivec2 size,
                             ThreadPool& pool) {
    nlohmann::json identity = settings_json(subject.source, settings, size, 0, 0);
    for (const char* other : {"spp", "alpha", "variables"})
        identity.erase(other);
    identity["camera"] = nlohmann::json::parse(camera_json(subject.camera));
    identity["scene"] = checksum_of_samples(subject, settings, pool);
    return to_text(identity);
}

std::string identity_difference(const std::string& theirs, const std::string& mine) {
    const nlohmann::json a = nlohmann::json::parse(theirs), b = nlohmann::json::parse(mine);
    for (const auto& [key, value] : b.items())
        if (key != "scene" && key != "camera" && a.value(key, nlohmann::json()) != value)
            return fmt::format("{} {}, not {}", key, to_text(a.value(key, nlohmann::json())), to_text(value));
    if (a.size() != b.size())
        return "another version of the program";
    if (a["camera"] != b["camera"])
        return "another camera";
    return a["scene"] == b["scene"] ? "" : "another scene (or other samples of it)";
}

} // namespace tessera
