#include "render/path/vertex.h"

#include "render/scene/scene.h"

namespace tessera {

namespace {

/// The value at barycentric coordinates of an attribute given at the corners.
template <class T>
T interpolate(T a, T b, T c, glm::vec2 barycentric) {
    return (1 - barycentric.x - barycentric.y) * a + barycentric.x * b + barycentric.y * c;
}

/// Normalises the cross product of a triangle's edges, whose square may be beyond floats.
glm::vec3 unit(glm::vec3 n) {
    const float square = glm::dot(n, n);
    if (square > 1e-30f && square < 1e30f)
        return n / std::sqrt(square);
    return glm::vec3(glm::normalize(glm::dvec3(n)));
}

} // namespace

LightPoint Vertex::light_toward(glm::vec3 direction) const {
    const bool front = glm::dot(geometric_normal, direction) > 0;
    return {position, geometric_normal, front ? emitted : Rgb(0), emitter_pdf_a};
}

void make_vertex(const Scene& scene, const Hit& hit, const Ray& ray, Vertex& v) {
    const ShapeRecord& shape = scene.record(hit.shape);
    v.position = ray.origin + hit.distance * ray.direction;
    if (hit.distance > 8 * scene.radius()) {
        // From so far away, that is less exact than steps off surfaces allow for.
        const glm::uvec3 t = shape.triangles[hit.triangle];
        v.position =
            interpolate(shape.positions[t.x], shape.positions[t.y], shape.positions[t.z], hit.barycentric);
    }
    v.geometric_normal = unit(hit.geometric_normal);
    glm::vec3 normal = v.geometric_normal;
    if (shape.normals) {
        const glm::uvec3 t = shape.triangles[hit.triangle];
        const glm::vec3 n0 = shape.normals[t.x], n1 = shape.normals[t.y], n2 = shape.normals[t.z];
        if (glm::dot(n0 + n1 + n2, v.geometric_normal) < 0)
            v.geometric_normal = -v.geometric_normal; // as front_normal() has it
        const glm::vec3 n = interpolate(n0, n1, n2, hit.barycentric);
        const float length = glm::length(n);
        normal = length > 0 ? n / length : v.geometric_normal;
    }
    glm::vec2 uv = hit.barycentric;
    if (shape.uvs) {
        const glm::uvec3 t = shape.triangles[hit.triangle];
        uv = interpolate(shape.uvs[t.x], shape.uvs[t.y], shape.uvs[t.z], hit.barycentric);
    }
    const bool from_behind = glm::dot(normal, ray.direction) > 0;
    v.frame = Frame(shape.material->two_sided && from_behind ? -normal : normal);
    v.bsdf = shape.material->resolve(uv);
    v.to_previous = v.to_local(-ray.direction);
    v.emitted = shape.emitted;
    v.emitter_pdf_a = shape.emitter_pdf_a;
}

} // namespace tessera
