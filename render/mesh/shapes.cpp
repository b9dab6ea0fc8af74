#include "render/mesh/meshes.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
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

namespace {

constexpr unsigned segments = 256; // of disk and cylinder; not tuned
// A triangle's centre is about step^2 / 4 below the sphere through its corners; half of that remains after
// scaling to the exact area. See make_sphere() for the resulting error.
constexpr unsigned sphere_rings = 96;
constexpr unsigned sphere_segments = 2 * sphere_rings;

constexpr double pi_d = std::numbers::pi;

glm::dvec2 on_circle(double turns) {
    return {std::cos(2 * pi_d * turns), std::sin(2 * pi_d * turns)};
}

double area(const Mesh& mesh) {
    double sum = 0;
    for (const glm::uvec3 t : mesh.triangles) {
        const glm::dvec3 corner = mesh.positions[t.x];
        sum += 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - corner,
                                            glm::dvec3(mesh.positions[t.z]) - corner));
    }
    return sum;
}

void add_vertex(Mesh& mesh, glm::dvec3 position, glm::dvec2 uv) {
    mesh.positions.emplace_back(position);
    mesh.uvs.emplace_back(uv);
}

} // namespace

Mesh make_sphere() {
    Mesh mesh;
    const unsigned row = sphere_segments + 1; // the seam has vertices at u = 0 and at u = 1
    for (unsigned i = 0; i <= sphere_rings; ++i)
        for (unsigned j = 0; j < row; ++j) {
            const bool is_pole = i == 0 || i == sphere_rings;
            const double v = static_cast<double>(i) / sphere_rings;
            const double u = (j + (is_pole ? 0.5 : 0.0)) / sphere_segments; // one pole vertex per triangle
            const double sine = is_pole ? 0 : std::sin(pi_d * v);
            add_vertex(mesh, {sine * on_circle(u), std::cos(pi_d * v)}, {u, v});
        }
    for (unsigned i = 0; i < sphere_rings; ++i)
        for (unsigned j = 0; j < sphere_segments; ++j) {
            const unsigned upper = i * row + j;
            const unsigned lower = upper + row;
            if (i > 0)
                mesh.triangles.emplace_back(upper, lower, upper + 1);
            if (i + 1 < sphere_rings)
                mesh.triangles.emplace_back(i > 0 ? upper + 1 : upper, lower, lower + 1);
        }
    mesh.normals = mesh.positions;
    const auto scale = static_cast<float>(std::sqrt(4 * pi_d / area(mesh)));
    for (glm::vec3& p : mesh.positions)
        p *= scale;
    return mesh;
}

Mesh make_disk() {
    Mesh mesh;
    const double step = 2 * pi_d / segments;
    const double rim = std::sqrt(step / std::sin(step)); // gives the polygon the area pi
    for (unsigned j = 0; j <= segments; ++j) {
        const double v = static_cast<double>(j) / segments;
        add_vertex(mesh, {rim * on_circle(v), 0}, {1, v});
    }
    for (unsigned j = 0; j < segments; ++j) {
        add_vertex(mesh, glm::dvec3(0), {0, (j + 0.5) / segments});
        mesh.triangles.emplace_back(segments + 1 + j, j, j + 1);
    }
    return mesh;
}

Mesh make_cylinder() {
    Mesh mesh;
    const double half_step = pi_d / segments;
    const double rim = half_step / std::sin(half_step); // gives the polygon the perimeter 2 pi
    for (unsigned j = 0; j <= segments; ++j) {
        const double u = static_cast<double>(j) / segments;
        for (const double z : {0.0, 1.0}) {
            add_vertex(mesh, {rim * on_circle(u), z}, {u, z});
            mesh.normals.emplace_back(glm::dvec3(on_circle(u), 0));
        }
        if (j == segments)
            break;
        const unsigned low = 2 * j;
        mesh.triangles.emplace_back(low, low + 2, low + 3);
        mesh.triangles.emplace_back(low, low + 3, low + 1);
    }
    return mesh;
}

} // namespace tessera
