#include "render/load/mitsuba_xml.h"
#include "render/load/plugins.h"
#include "tests/fuzz/fuzzed_mesh.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tessera {

/// Replaces the reader of image files. A scene in memory has none, so it is never called.
LoadedBitmap read_bitmap(const std::filesystem::path&, bool, const std::function<bool()>&, BitmapChannel) {
    std::abort();
}

} // namespace tessera

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const std::string_view text(reinterpret_cast<const char*>(data), size);
        const tessera::LoadedScene loaded = tessera::parse_mitsuba_xml(text, "fuzz.xml");
        const tessera::SceneDescription& scene = loaded.description;
        for (const tessera::Shape& shape : scene.shapes) {
            tessera::require_placed(shape.mesh);
            tessera::require(shape.material >= 0 &&
                             static_cast<std::size_t>(shape.material) < scene.materials.size());
            tessera::require(shape.area_light < static_cast<int>(scene.area_lights.size()));
        }
    } catch (const tessera::LoadError&) { // expected for bad scenes; anything else is a bug
    }
    return 0;
}
