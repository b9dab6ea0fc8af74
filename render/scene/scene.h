#pragma once

#include "render/scene/camera.h"
#include "render/scene/light.h"
#include "render/surface/material.h"
#include "render/surface/mesh.h"
#include "render/trace/intersector.h"

#include <deque>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// All that a scene file says, and nothing derived: what a loader fills in.
struct SceneDescription {
    std::vector<Shape> shapes;
    std::deque<ShapeGroup> groups; ///< seen only where instances put them; they stay in place while more come
    std::vector<Instance> instances;
    std::vector<Material> materials;
    std::vector<AreaLight> area_lights;
    std::vector<PointLight> point_lights;
    std::vector<DirectionalLight> directional_lights;
    EnvironmentDescription environment;
    Camera camera;
    glm::ivec2 size{768, 576}; ///< of the film, pixels
    int max_depth = 65; ///< edges of a light path, as in Mitsuba: 1 is emission only; -1 in a file becomes 65
};

/// Calls visit(shape) for all shapes, as hits count them: the scene's own, and then those of the groups.
template <class Visit>
void for_each_shape(const SceneDescription& scene, Visit&& visit) {
    for (const Shape& shape : scene.shapes)
        visit(shape);
    for (const ShapeGroup& group : scene.groups)
        for (const Shape& shape : group.shapes)
            visit(shape);
}

/// What a hit needs of its shape, close together; pointers into the shape's mesh.
struct ShapeRecord {
    const glm::uvec3* triangles;
    const glm::vec3* positions;
    const glm::vec3* normals; ///< null: every triangle has its own normal
    const glm::vec2* uvs;     ///< null: none, or nothing looks them up
    const Mesh* attributed;   ///< null: it has no attributes, or nothing looks them up
    const Material* material;
    Rgb emitted;                 ///< radiance given off on the front side, where it is the same everywhere
    const Texture* emission_map; ///< null: it is
    float emitter_pdf_a;         ///< 0: no light
    bool has_frame_along_u;      ///< whether frames of shading must lie along the texture's u
};

/// A scene ready to be rendered: immutable, shared by all who render it.
class Scene {
public:
    /// Builds the light tables and the BVH. Materials without area and shapes without triangles are harmless.
    explicit Scene(SceneDescription description);
    Scene(const Scene&) = delete; // records point into it
    Scene& operator=(const Scene&) = delete;

    const std::vector<Shape>& shapes() const { return description_.shapes; }
    const std::vector<Material>& materials() const { return description_.materials; }
    const SceneDescription& description() const { return description_; }
    const Camera& camera() const { return description_.camera; }
    glm::ivec2 size() const { return description_.size; }
    int max_depth() const { return description_.max_depth; }
    const LightTable& lights() const { return lights_; }
    const Intersector& intersector() const { return intersector_; }
    /// Of a shape as hits count them.
    const ShapeRecord& record(std::uint32_t shape) const { return records_[shape]; }

    /// Whether anything may be a mirror (Material::may_be_mirror).
    bool has_mirrors() const { return has_mirrors_; }
    /// Whether any shape is there for one ray and not for another, by its opacity.
    bool has_masks() const { return has_masks_; }

    /// A sphere around all triangles.
    glm::vec3 center() const { return center_; }
    float radius() const { return radius_; }

    /// Of all shapes; those of a group count once.
    std::size_t triangle_count() const;
    double bvh_seconds() const { return bvh_seconds_; }

private:
    SceneDescription description_;
    LightTable lights_;
    Intersector intersector_;
    std::vector<ShapeRecord> records_;
    bool has_mirrors_ = false, has_masks_ = false;
    glm::vec3 center_{0};
    float radius_ = 1;
    double bvh_seconds_ = 0;

    void measure();
};

/// What a scene contains, and so what a renderer must reckon with: whatever has a count of 0 needs no code and
/// costs nothing. Only materials that some shape is made of count. An upper bound: a texture is taken to reach all
/// its values.
struct SceneTraits {
    int delta_lobes = 0;      ///< materials with perfect reflection or refraction: no connection at them
    int glossy_lobes = 0;     ///< materials with microfacets of alpha below 0.1, but not perfectly smooth
    int transmission = 0;     ///< materials that let light through
    int textures = 0;         ///< materials that look up any texture
    int mesh_attributes = 0;  ///< materials that look up attributes of meshes, such as colours of vertices
    int relief = 0;           ///< materials with a bump or normal map
    int masks = 0;            ///< materials with an opacity other than 1
    int shading_normals = 0;  ///< shapes whose normals are interpolated
    int instances = 0;        ///< of groups of shapes
    int area_lights = 0;      ///< emitting shapes
    int point_lights = 0;     ///< lights without extent: points, spots, directions
    bool environment = false; ///< light from infinitely far away

    bool operator==(const SceneTraits&) const = default;
};

SceneTraits traits_of(const SceneDescription& scene);

} // namespace tessera
