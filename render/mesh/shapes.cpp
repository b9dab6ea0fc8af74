#include "render/mesh/meshes.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

Mesh make_rectangle() {
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

Mesh make_cube() {
    // A face, given by its corner at uv (0, 1) and the edges from there along +u and -v.
    struct Face {
        glm::vec3 corner, along_u, against_v;
    };
    static constexpr Face faces[] = {
        {{1, -1, -1}, {0, 0, 2}, {-2, 0, 0}}, {{1, 1, -1}, {-2, 0, 0}, {0, 0, 2}},
        {{1, -1, -1}, {0, 2, 0}, {0, 0, 2}},  {{1, -1, 1}, {0, 2, 0}, {-2, 0, 0}},
        {{-1, -1, 1}, {0, 2, 0}, {0, 0, -2}}, {{1, 1, -1}, {0, -2, 0}, {-2, 0, 0}},
    };
    Mesh mesh;
    for (const Face& face : faces) {
        const auto first = static_cast<unsigned>(mesh.positions.size());
        for (const glm::vec2 uv : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)}) {
            mesh.positions.push_back(face.corner + uv.x * face.along_u + (1 - uv.y) * face.against_v);
            mesh.uvs.push_back(uv);
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first + 3, first, first + 2});
    }
    return mesh;
}

} // namespace tessera
