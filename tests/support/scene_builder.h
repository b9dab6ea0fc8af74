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

/// Puts small scenes together in code.
class SceneBuilder {
public:
    int material(Material m);
    int diffuse(Rgb reflectance);
    int conductor(float alpha, MicrofacetDistribution distribution = MicrofacetDistribution::ggx);
    int brushed(float alpha_u, float alpha_v); ///< a conductor
    int mirror();
    int glass(float eta = 1.5f, bool thin = false);
    int plastic(Rgb diffuse, float alpha); ///< alpha = 0: a smooth coating
    int rough_diffuse(Rgb reflectance, float alpha);
    int rough_glass(float alpha, float eta = 1.5f);
    int phong(Rgb diffuse, Rgb specular, float exponent);
    int blend(int first, int second, float share_of_second); ///< of materials made before
    int coated(int base, Rgb sigma_a, float eta = 1.5f);     ///< over a material made before
    int light(Texture radiance);
    void point(PointLight light);
    void directional(DirectionalLight light);
    /// Latitude and longitude, rows from the top; `width` pixels a row.
    void environment(const std::vector<Rgb>& pixels, int width, glm::mat3 to_world = glm::mat3(1));
    void sun(SunDisk sun);

    /// A parallelogram; its front is the side of cross(edge1, edge2).
    void quad(glm::vec3 corner, glm::vec3 edge1, glm::vec3 edge2, int material, int light = -1);
    void sphere(glm::vec3 center, float radius, int material, int rings = 24);
    /// The walls of a room [-1, 1]^3 without its front wall (z = 1), seen from inside, in the order floor,
    /// ceiling, back, left, right.
    void room(const std::vector<int>& materials);

    /// Makes a group of the shapes that were added last, which are then seen only where instances are.
    int group_of_last(int shapes);
    void instance(int group, glm::mat4 to_world);

    void camera(glm::vec3 origin, glm::vec3 target, float fov);
    void camera(const Camera& camera);

    std::shared_ptr<const Scene> build() const;

private:
    std::shared_ptr<const Material> copy_of(int material) const;

    SceneDescription description_;
};

/// The matrix of Mitsuba's lookat.
glm::mat4 look_at(glm::vec3 origin, glm::vec3 target, glm::vec3 up = {0, 1, 0});

struct TestScene {
    std::string name;
    std::shared_ptr<const Scene> scene;
    int max_depth;
    float shift_threshold = 0.001f;
    int effort = 1; ///< factor on the runs: more where rare bright paths would leave too few for statistics
    float shift_distance = 1;
};

/// The name alone, for test reports.
inline void PrintTo(const TestScene& t, std::ostream* out) {
    *out << t.name;
}

/// Small scenes, each for one thing that an estimator can get wrong.
std::vector<TestScene> all_test_scenes();
/// The test scenes that are about lights, masks and relief.
std::vector<TestScene> light_scenes();

} // namespace tessera::test
