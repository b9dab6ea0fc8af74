#include "render/load/plugins.h"
#include "tests/fuzz/fuzzed_mesh.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string_view>

// OpenEXR throws its own classes derived from std::exception.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const std::string_view bytes(reinterpret_cast<const char*>(data), size);
        const tessera::Bitmap bitmap = tessera::parse_bitmap(bytes, ".tga", true, [] { return true; }).bitmap;
        const auto pixels = static_cast<std::size_t>(bitmap.width) * static_cast<std::size_t>(bitmap.height);
        tessera::require(bitmap.bytes.size() == 3 * pixels || bitmap.floats.size() == pixels);
    } catch (const std::exception&) { // expected for bad files; anything else is a bug
    }
    return 0;
}
