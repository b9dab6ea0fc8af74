#include "render/scene/scene.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace tessera {

namespace {

ShapeRecord make_record(const Shape& shape, const SceneDescription& description, const LightTable& lights) {
    const Mesh& mesh = shape.mesh;
    const Material& material = description.materials[shape.material];
    ShapeRecord record{};
    record.triangles = mesh.triangles.data();
    record.positions = mesh.positions.data();
    record.material = &material;
    if (!mesh.normals.empty())
        record.normals = mesh.normals.data();
    bool is_textured = material.is_textured();
    if (shape.area_light >= 0) {
        const Texture& radiance = description.area_lights[shape.area_light].radiance;
        record.emitter_pdf = shape.quadric ? lights.probability_of(*shape.quadric, shape.area_light)
                                           : lights.pdf_a(shape.area_light);
        record.emitted = radiance.mean();
        if (!radiance.is_constant())
            record.emission_map = &radiance;
        is_textured = is_textured || !radiance.is_constant();
    }
    record.has_frame_along_u = material.is_anisotropic();
    const bool uses_uv = is_textured || record.has_frame_along_u;
    if (!mesh.uvs.empty() && uses_uv)
        record.uvs = mesh.uvs.data();
    record.quadric = shape.quadric ? &*shape.quadric : nullptr;
    record.quadric_uses_uv = shape.quadric && uses_uv;
    if (!mesh.attributes.empty() && is_textured)
        record.attributed = &mesh;
    return record;
}

/// Returns the opacity of each shape; null if it is opaque. Emitters count as opaque: as in Mitsuba, their whole
/// surface emits, and emitter sampling ignores opacity.
std::vector<const Texture*> opacities_of(const SceneDescription& description) {
    std::vector<const Texture*> opacities;
    for_each_shape(description, [&](const Shape& shape) {
        const Material& material = description.materials[shape.material];
        opacities.push_back(material.is_mask() && shape.area_light < 0 ? &*material.opacity : nullptr);
    });
    return opacities;
}

struct Box {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};

    bool is_empty() const { return low.x > high.x; }
    void add(glm::vec3 p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

void add(const std::vector<Shape>& shapes, Box& box) {
    for (const Shape& shape : shapes) {
        for (glm::vec3 p : shape.mesh.positions)
            box.add(p);
        if (shape.quadric) {
            const Quadric::Bounds bounds = shape.quadric->bounds();
            box.add(bounds.low);
            box.add(bounds.high);
        }
    }
}

/// Adds the transformed corners of a group's box.
void add(const Box& group_box, const glm::mat4& to_world, Box& box) {
    if (group_box.is_empty())
        return;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? group_box.low.x : group_box.high.x,
                          corner & 2 ? group_box.low.y : group_box.high.y,
                          corner & 4 ? group_box.low.z : group_box.high.z);
        box.add(glm::vec3(to_world * glm::vec4(p, 1)));
    }
}

} // namespace

Scene::Scene(SceneDescription description) : description_(std::move(description)) {
    measure();
    lights_ = LightTable(description_, radius_);
    const auto start = std::chrono::steady_clock::now();
    const std::vector<const Texture*> opacities = opacities_of(description_);
    has_masks_ = std::ranges::any_of(opacities, [](const Texture* opacity) { return opacity; });
    intersector_ = Intersector(description_.shapes, opacities, description_.groups, description_.instances);
    bvh_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (const std::vector<double> factors = learn_light_selection(*this); !factors.empty())
        lights_ = LightTable(description_, radius_, factors);
    for_each_shape(description_,
                   [&](const Shape& shape) { records_.push_back(make_record(shape, description_, lights_)); });
    has_mirrors_ =
        std::ranges::any_of(records_, [](const ShapeRecord& record) { return record.material->may_be_mirror(); });
}

/// Computes the bounding sphere of all surfaces; instances count with the boxes of their groups.
void Scene::measure() {
    Box box;
    add(description_.shapes, box);
    std::vector<Box> group_boxes(description_.groups.size());
    for (std::size_t i = 0; i < group_boxes.size(); ++i)
        add(description_.groups[i].shapes, group_boxes[i]);
    for (const Instance& instance : description_.instances)
        add(group_boxes[instance.group], instance.to_world, box);
    if (!box.is_empty()) {
        center_ = 0.5f * (box.low + box.high);
        radius_ = std::max(0.5f * glm::length(box.high - box.low), std::numeric_limits<float>::min());
    }
}

std::size_t Scene::triangle_count() const {
    std::size_t sum = 0;
    for_each_shape(description_, [&](const Shape& shape) { sum += shape.mesh.triangles.size(); });
    return sum;
}

std::size_t Scene::quadric_count() const {
    std::size_t sum = 0;
    for_each_shape(description_, [&](const Shape& shape) { sum += shape.quadric.has_value(); });
    return sum;
}

} // namespace tessera
