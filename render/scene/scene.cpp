#include "render/scene/scene.h"

#include <chrono>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

namespace {

ShapeRecord make_record(const Shape& shape, const SceneDescription& description, const LightTable& lights) {
    const Mesh& mesh = shape.mesh;
    const Material& material = description.materials[static_cast<std::size_t>(shape.material)];
    ShapeRecord record{
        mesh.triangles.data(), mesh.positions.data(), nullptr, nullptr, nullptr, &material, Rgb(0), 0};
    if (!mesh.normals.empty())
        record.normals = mesh.normals.data();
    if (!mesh.uvs.empty() && material.is_textured())
        record.uvs = mesh.uvs.data();
    if (!mesh.colors.empty() && material.is_textured())
        record.colors = mesh.colors.data();
    if (shape.area_light >= 0) {
        record.emitted = description.area_lights[static_cast<std::size_t>(shape.area_light)].radiance;
        record.emitter_pdf_a = lights.pdf_a(shape.area_light);
    }
    return record;
}

} // namespace

Scene::Scene(SceneDescription description)
    : description_(std::move(description)), lights_(description_.shapes, description_.area_lights) {
    const auto start = std::chrono::steady_clock::now();
    intersector_ = Intersector(description_.shapes);
    bvh_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    for (const Shape& shape : description_.shapes)
        records_.push_back(make_record(shape, description_, lights_));

    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    for (const Shape& shape : description_.shapes)
        for (glm::vec3 p : shape.mesh.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    if (low.x <= high.x) {
        center_ = 0.5f * (low + high);
        radius_ = std::max(0.5f * glm::length(high - low), std::numeric_limits<float>::min());
    }
}

std::size_t Scene::triangle_count() const {
    std::size_t sum = 0;
    for (const Shape& shape : description_.shapes)
        sum += shape.mesh.triangles.size();
    return sum;
}

} // namespace tessera
