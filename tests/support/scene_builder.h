#pragma once

#include "render/scene/scene.h"

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace tessera::test {

/// Builds small scenes in code. Functions for materials, and light(), return an index.
class SceneBuilder {
public:
    int material(Material m);
    int diffuse(Rgb reflectance);
    int conductor(float alpha, MicrofacetDistribution distribution = MicrofacetDistribution::ggx);
    int brushed(float alpha_u, float alpha_v); ///< anisotropic conductor
    int mirror();
    int glass(float eta = 1.5f, bool thin = false);
    int plastic(Rgb diffuse, float alpha); ///< alpha = 0: a smooth coating
    int rough_diffuse(Rgb reflectance, float alpha);
    int rough_glass(float alpha, float eta = 1.5f);
    int phong(Rgb diffuse, Rgb specular, float exponent);
    int blend(int first, int second, float blend_weight);
    int coated(int base, Rgb sigma_a, float eta = 1.5f);
    int light(Texture radiance);
    void point(PointLight light);
    void directional(DirectionalLight light);
    /// Sets an environment map in latitude and longitude. @param pixels  rows from the top, of `width` pixels
    void environment(const std::vector<Rgb>& pixels, int width, glm::mat3 to_world = glm::mat3(1));
    void sun(SunDisk sun);

    /// Adds a parallelogram. Its front faces cross(edge1, edge2). @param light  -1: none
    void quad(glm::vec3 corner, glm::vec3 edge1, glm::vec3 edge2, int material, int light = -1);
    /// Adds a sphere of triangles with shading normals.
    void sphere(glm::vec3 center, float radius, int material, int rings = 24);
    void quadric(const Quadric& quadric, int material, int light = -1);
    /// Adds a sphere without tessellation.
    void ball(glm::vec3 center, float radius, int material, int light = -1);
    /// Adds the walls of a room [-1, 1]^3 without its front wall (z = 1), facing inward.
    /// @param materials  of floor, ceiling, back, left and right wall
    void room(const std::vector<int>& materials);

    /// Moves the last shapes into a group, which instances place. Returns the index of the group.
    /// @param shapes  number of shapes
    int group_of_last(int shapes);
    void instance(int group, glm::mat4 to_world);

    void camera(glm::vec3 origin, glm::vec3 target, float fov);
    void camera(const Camera& camera);

    std::shared_ptr<const Scene> build() const;

private:
    std::shared_ptr<const Material> copy_of(int material) const;

    SceneDescription description_;
};

/// Returns a sphere of triangles with exact normals at the vertices.
Mesh sphere_mesh(glm::vec3 center, float radius, int rings);

/// Returns the matrix of Mitsuba's `lookat`.
glm::mat4 look_at(glm::vec3 origin, glm::vec3 target, glm::vec3 up = {0, 1, 0});

struct TestScene {
    std::string name;
    std::shared_ptr<const Scene> scene;
    int max_depth;
    float shift_threshold = 0.001f;
    int effort = 1; ///< factor on the number of runs: above 1 in scenes with rare bright paths
    float shift_distance = 1;
};

/// Prints the name, for test reports.
inline void PrintTo(const TestScene& t, std::ostream* out) {
    *out << t.name;
}

/// Returns small scenes. Each tests one feature that an estimator can get wrong.
std::vector<TestScene> all_test_scenes();
/// Returns the scenes for lights, masks, instances and relief, which all_test_scenes() includes.
std::vector<TestScene> light_scenes();

} // namespace tessera::test
