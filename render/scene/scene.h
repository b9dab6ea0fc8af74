#pragma once

#include "render/scene/camera.h"
#include "render/scene/light.h"
#include "render/scene/sensor.h"
#include "render/surface/material.h"
#include "render/surface/mesh.h"
#include "render/trace/intersector.h"

#include <deque>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// The contents of a scene file as filled in by a loader, without derived data.
struct SceneDescription {
    std::vector<Shape> shapes;
    std::deque<ShapeGroup> groups; ///< visible only through instances; addresses stay valid as groups are added
    std::vector<Instance> instances;
    std::vector<Material> materials;
    std::vector<AreaLight> area_lights;
    std::vector<PointLight> point_lights;
    std::vector<DirectionalLight> directional_lights;
    EnvironmentDescription environment;
    Camera camera;
    glm::ivec2 size{768, 576}; ///< of the picture: the crop window, or the film; pixels
    int max_depth = 65; ///< maximum edges of a light path, as in Mitsuba; 1: emission only; a file's -1 is 65
    PixelFormat format = PixelFormat::rgb;
    bool hides_emitters = false;   ///< camera rays pass through emitters, and see no environment
    std::vector<Sensor> sensors{}; ///< of the file, in its order; camera, size and format are those of one of them

    /// Makes camera, size and format those of a sensor.
    void use(const Sensor& sensor) {
        camera = sensor.camera;
        size = sensor.size;
        format = sensor.format;
    }
};

/// Calls visit(shape) for all shapes in the order of Hit::shape: the scene's own, then those of the groups.
template <class Visit>
void for_each_shape(const SceneDescription& scene, Visit&& visit) {
    for (const Shape& shape : scene.shapes)
        visit(shape);
    for (const ShapeGroup& group : scene.groups)
        for (const Shape& shape : group.shapes)
            visit(shape);
}

/// The data of a shape that shading needs, packed for locality. Pointers refer to the shape's mesh.
struct ShapeRecord {
    const glm::uvec3* triangles;
    const glm::vec3* positions;
    const glm::vec3* normals; ///< null: triangles are flat
    const glm::vec2* uvs;     ///< of a mesh; null: absent or unused
    const Mesh* attributed;   ///< mesh with attributes; null: absent or unused
    const Material* material;
    Rgb emitted;                 ///< radiance on the front side, or its mean if textured
    const Texture* emission_map; ///< textured radiance; null: constant
    float emitter_pdf; ///< of emitter sampling: per area on a mesh, probability of a quadric; 0: not an emitter
    bool has_frame_along_u; ///< whether shading tangents must follow the texture's u
    const Quadric* quadric; ///< null: a mesh
    bool quadric_uses_uv;   ///< whether shading of the quadric needs u and v

    bool has_uv() const { return uvs || quadric_uses_uv; }
};

/// A scene ready to be rendered; immutable, so that threads can share it.
class Scene {
public:
    /// Builds the light table and the BVH. Unused materials and shapes without triangles are allowed.
    explicit Scene(SceneDescription description);
    Scene(const Scene&) = delete; // records_ points into description_
    Scene& operator=(const Scene&) = delete;

    const std::vector<Shape>& shapes() const { return description_.shapes; }
    const std::vector<Material>& materials() const { return description_.materials; }
    const SceneDescription& description() const { return description_; }
    const Camera& camera() const { return description_.camera; }
    glm::ivec2 size() const { return description_.size; }
    /// Returns the size of the picture on a film of another size; empty: on the scene's own film.
    glm::ivec2 size(std::optional<glm::ivec2> film) const { return film ? camera().crop.size_on(*film) : size(); }
    int max_depth() const { return description_.max_depth; }
    /// Returns whether the camera sees no emitters, but only the light that they cast.
    bool hides_emitters() const { return description_.hides_emitters; }
    const LightTable& lights() const { return lights_; }
    const Intersector& intersector() const { return intersector_; }
    /// Returns the record of a shape by Hit::shape.
    const ShapeRecord& record(std::uint32_t shape) const { return records_[shape]; }

    /// Returns whether any material may be a mirror (Material::may_be_mirror).
    bool has_mirrors() const { return has_mirrors_; }
    /// Returns whether any shape has an opacity other than 1, so that it stops rays at random.
    bool has_masks() const { return has_masks_; }

    /// Bounding sphere of all surfaces.
    glm::vec3 center() const { return center_; }
    float radius() const { return radius_; }

    /// Returns the number of triangles; those of a group count once.
    std::size_t triangle_count() const;
    /// Returns the number of quadrics; those of a group count once.
    std::size_t quadric_count() const;
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

/// Counts of the features that a scene uses. Only materials that some shape uses count. Counts are upper bounds,
/// because a texture counts with its smallest value even if no surface shows it.
struct SceneTraits {
    int delta_lobes = 0;      ///< materials with perfect reflection or refraction
    int glossy_lobes = 0;     ///< materials with microfacets of alpha below 0.1 that are not perfectly smooth
    int transmission = 0;     ///< materials that transmit light
    int textures = 0;         ///< materials with a texture that is not constant
    int mesh_attributes = 0;  ///< materials that look up mesh attributes such as vertex colours
    int relief = 0;           ///< materials with a bump or normal map
    int masks = 0;            ///< materials with an opacity other than 1
    int shading_normals = 0;  ///< shapes with interpolated normals
    int instances = 0;        ///< instances of groups of shapes
    int area_lights = 0;      ///< emitting shapes
    int point_lights = 0;     ///< point, spot, projector and directional lights
    bool environment = false; ///< whether there is an environment map or a sun

    bool operator==(const SceneTraits&) const = default;
};

SceneTraits traits_of(const SceneDescription& scene);

} // namespace tessera
