#include "render/scene/scene_checksums.h"

#include "render/scene/scene_digest.h"

#include <cstdio>
#include <utility>

#include <fmt/core.h>

namespace tessera {

SceneChecksums checksums_of(const SceneDescription& scene, const Camera& camera) {
    const auto& [shapes, materials, area_lights, point_lights, directional_lights, environment, own_camera, size,
                 max_depth] = scene;
    BitmapChecksums bitmaps;
    std::vector<std::uint32_t> of_materials;
    for (const Material& material : materials)
        of_materials.push_back(SceneDigest(bitmaps).add(material).checksum());
    SceneDigest geometry(bitmaps), looks(bitmaps), lights(bitmaps);
    for (const auto& [name, mesh, material, area_light] : shapes) {
        geometry.add(mesh);
        looks.add(
            of_materials.at(static_cast<std::size_t>(material))); // not its index: unused ones may come and go
        lights.add(area_light >= 0);
        if (area_light >= 0)
            lights.add(area_lights.at(static_cast<std::size_t>(area_light)));
    }
    lights.add(point_lights, directional_lights, environment);
    return {geometry.checksum(), looks.checksum(), lights.checksum(), SceneDigest(bitmaps).add(camera).checksum()};
}

std::string to_string(const SceneChecksums& sums) {
    return fmt::format("geometry {:08x} materials {:08x} lights {:08x} camera {:08x}", sums.geometry,
                       sums.materials, sums.lights, sums.camera);
}

std::optional<SceneChecksums> scene_checksums_from(const std::string& text) {
    SceneChecksums sums;
    if (std::sscanf(text.c_str(), "geometry %x materials %x lights %x camera %x", &sums.geometry, &sums.materials,
                    &sums.lights, &sums.camera) != 4)
        return {};
    return sums;
}

std::string difference(const SceneChecksums& a, const SceneChecksums& b) {
    std::vector<std::string> parts;
    for (const auto& [name, differs] :
         {std::pair("geometry", a.geometry != b.geometry), std::pair("materials", a.materials != b.materials),
          std::pair("lights", a.lights != b.lights), std::pair("camera", a.camera != b.camera)})
        if (differs)
            parts.emplace_back(name);
    std::string text;
    for (std::size_t i = 0; i < parts.size(); ++i)
        text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
    return text;
}

} // namespace tessera
