#include "render/surface/mesh.h"

#include <algorithm>

#include <glm/vec3.hpp>

namespace tessera {

const MeshAttribute* Mesh::attribute(std::string_view name) const {
    const auto found = std::ranges::find(attributes, name, &MeshAttribute::name);
    return found == attributes.end() ? nullptr : &*found;
}

Rgb SurfacePoint::attribute(std::string_view name) const {
    const MeshAttribute* found = mesh ? mesh->attribute(name) : nullptr;
    if (!found)
        return Rgb(1);
    const auto value = [&](std::size_t i) { return found->values[i]; };
    if (found->is_of_faces())
        return value(triangle);
    const glm::uvec3 t = mesh->triangles[triangle];
    const float first = 1 - barycentric.x - barycentric.y;
    return first * value(t.x) + barycentric.x * value(t.y) + barycentric.y * value(t.z);
}

} // namespace tessera
