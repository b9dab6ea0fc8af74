#include "render/mesh/meshes.h"
#include "tests/fuzz/fuzzed_mesh.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        tessera::Mesh mesh = tessera::parse_ply(std::string_view(reinterpret_cast<const char*>(data), size)).mesh;
        tessera::require_sound(mesh);
        tessera::place_mesh(mesh, {});
        tessera::require_placed(mesh);
    } catch (const std::runtime_error&) { // expected for bad files; anything else is a bug
    }
    return 0;
}
