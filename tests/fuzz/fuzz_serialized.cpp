#include "render/mesh/meshes.h"
#include "tests/fuzz/fuzzed_mesh.h"

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace {

/// Parses a mesh. The first byte is its index in the file; the other bytes are the file.
tessera::Mesh parse(const std::uint8_t* data, std::size_t size) {
    if (size == 0)
        return {};
    std::istringstream stream(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
    return tessera::parse_serialized(stream, data[0]).mesh;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        tessera::Mesh mesh = parse(data, size);
        tessera::require_sound(mesh);
        tessera::place_mesh(mesh, {});
        tessera::require_placed(mesh);
    } catch (const std::runtime_error&) { // expected for bad files; anything else is a bug
    }
    return 0;
}
