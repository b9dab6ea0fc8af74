#include "render/scene/scene.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tessera {

namespace {

ShapeRecord make_record(const Shape& shape, const SceneDescription& description, const LightTable& lights) {
    const Mesh& mesh = shape.mesh;
    const Material& material = description.materials[static_cast<std::size_t>(shape.material)];
    ShapeRecord record{};
    record.triangles = mesh.triangles.data();
    record.positions = mesh.positions.data();
    record.material = &material;
    if (!mesh.normals.empty())
        record.normals = mesh.normals.data();
    bool is_textured = material.is_textured();
    if (shape.area_light >= 0) {
        const Texture& radiance = description.area_lights[static_cast<std::size_t>(shape.area_light)].radiance;
        record.emitter_pdf_a = lights.pdf_a(shape.area_light);
        record.emitted = radiance.mean();
        if (!radiance.is_constant())
            record.emission_map = &radiance;
        is_textured = is_textured || !radiance.is_constant();
    }
    record.has_frame_along_u = material.is_anisotropic();
    if (!mesh.uvs.empty() && (is_textured || record.has_frame_along_u))
        record.uvs = mesh.uvs.data();
    if (!mesh.attributes.empty() && is_textured)
        record.attributed = &mesh;
    return record;
}

/// The opacity of each shape; null: it is opaque. So is what gives light: emitter sampling does not ask, and as in
/// Mitsuba all of the surface shines.
std::vector<const Texture*> opacities_of(const SceneDescription& description) {
    std::vector<const Texture*> opacities;
    for (const Shape& shape : description.shapes) {
        const Material& material = description.materials[static_cast<std::size_t>(shape.material)];
        opacities.push_back(material.opacity && shape.area_light < 0 ? &*material.opacity : nullptr);
    }
    return opacities;
}

} // namespace

Scene::Scene(SceneDescription description) : description_(std::move(description)) {
    measure();
    lights_ = LightTable(description_, radius_);
    const auto start = std::chrono::steady_clock::now();
    intersector_ = Intersector(description_.shapes, opacities_of(description_));
    bvh_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (const std::vector<double> factors = learn_light_factors(*this); !factors.empty())
        lights_ = LightTable(description_, radius_, factors);
    for (const Shape& shape : description_.shapes)
        records_.push_back(make_record(shape, description_, lights_));
}

/// Finds the sphere around all triangles.
void Scene::measure() {
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
