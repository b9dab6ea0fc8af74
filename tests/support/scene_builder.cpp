#include "tests/support/scene_builder.h"

#include "render/sampling/sampling.h"

#include <utility>
#include <variant>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace tessera::test {

int SceneBuilder::material(Material m) {
    description_.materials.push_back(std::move(m));
    return static_cast<int>(description_.materials.size()) - 1;
}

int SceneBuilder::diffuse(Rgb reflectance) {
    return material({"diffuse", DiffuseMaterial{{reflectance}}, true});
}

int SceneBuilder::conductor(float alpha, MicrofacetDistribution distribution) {
    ConductorMaterial m;
    m.distribution = distribution;
    m.alpha = Texture(Rgb(alpha));
    m.eta = Rgb(1.65746f, 0.880369f, 0.521229f);
    m.k = Rgb(9.22387f, 6.26952f, 4.837f);
    return material({"conductor", m, true});
}

int SceneBuilder::brushed(float alpha_u, float alpha_v) {
    const int index = conductor(alpha_u);
    std::get<ConductorMaterial>(description_.materials.back().kind).alpha_v = Texture(Rgb(alpha_v));
    return index;
}

int SceneBuilder::mirror() {
    return material({"mirror", ConductorMaterial{}, true});
}

int SceneBuilder::glass(float eta, bool thin) {
    DielectricMaterial m;
    m.thin = thin;
    m.eta = eta;
    return material({"glass", m, false});
}

int SceneBuilder::plastic(Rgb diffuse, float alpha) {
    PlasticMaterial m;
    m.eta = 1.5f;
    m.facets = {MicrofacetDistribution::ggx, alpha};
    m.coating = std::make_shared<const Coating>(m.eta, m.facets.distribution, alpha);
    m.diffuse_reflectance = Texture(diffuse);
    return material({"plastic", m, true});
}

int SceneBuilder::rough_diffuse(Rgb reflectance, float alpha) {
    return material({"rough diffuse", DiffuseMaterial{{reflectance}, {Rgb(alpha)}}, true});
}

int SceneBuilder::rough_glass(float alpha, float eta) {
    DielectricMaterial m;
    m.eta = eta;
    m.distribution = MicrofacetDistribution::ggx;
    m.alpha = Texture(Rgb(alpha));
    return material({"rough glass", m, false});
}

int SceneBuilder::phong(Rgb diffuse, Rgb specular, float exponent) {
    return material({"phong", PhongMaterial{{Rgb(exponent)}, {diffuse}, {specular}}, true});
}

std::shared_ptr<const Material> SceneBuilder::copy_of(int material) const {
    return std::make_shared<const Material>(description_.materials.at(static_cast<std::size_t>(material)));
}

int SceneBuilder::blend(int first, int second, float blend_weight) {
    MixtureMaterial m{{copy_of(first), copy_of(second)}};
    m.blend_weight = Texture(Rgb(blend_weight));
    const bool two_sided = m.parts[0]->two_sided && m.parts[1]->two_sided;
    return material({"blend", m, two_sided});
}

int SceneBuilder::coated(int base, Rgb sigma_a, float eta) {
    CoatedMaterial m;
    m.eta = eta;
    m.sigma_a = Texture(sigma_a);
    m.base = copy_of(base);
    return material({"coated", m, true});
}

int SceneBuilder::light(Texture radiance) {
    description_.area_lights.push_back({radiance});
    return static_cast<int>(description_.area_lights.size()) - 1;
}

void SceneBuilder::point(PointLight light) {
    description_.point_lights.push_back(light);
}

void SceneBuilder::directional(DirectionalLight light) {
    description_.directional_lights.push_back(light);
}

void SceneBuilder::environment(const std::vector<Rgb>& pixels, int width, glm::mat3 to_world) {
    Bitmap bitmap;
    bitmap.width = width;
    bitmap.height = static_cast<int>(pixels.size()) / width;
    bitmap.floats.assign(pixels.begin(), pixels.end());
    description_.environment.map = {std::make_shared<const Bitmap>(std::move(bitmap)), 1, to_world};
}

void SceneBuilder::sun(SunDisk sun) {
    description_.environment.sun = sun;
}

void SceneBuilder::quad(glm::vec3 corner, glm::vec3 edge1, glm::vec3 edge2, int material, int light) {
    Shape shape;
    shape.name = "quad";
    shape.mesh.positions = {corner, corner + edge1, corner + edge1 + edge2, corner + edge2};
    shape.mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    shape.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    shape.material = material;
    shape.area_light = light;
    description_.shapes.push_back(std::move(shape));
}

Mesh sphere_mesh(glm::vec3 center, float radius, int rings) {
    Mesh mesh;
    const int around = 2 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j <= around; ++j) {
            const float theta = pi * static_cast<float>(i) / static_cast<float>(rings);
            const float phi = 2 * pi * static_cast<float>(j) / static_cast<float>(around);
            const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
            mesh.positions.push_back(center + radius * n);
            mesh.normals.push_back(n);
            mesh.uvs.emplace_back(static_cast<float>(j) / static_cast<float>(around), 0.0f);
        }
    const auto row = static_cast<unsigned>(around + 1);
    for (unsigned i = 0; i < static_cast<unsigned>(rings); ++i)
        for (unsigned j = 0; j + 1 < row; ++j) {
            const unsigned a = i * row + j;
            if (i > 0)
                mesh.triangles.push_back({a, a + row, a + 1});
            if (i + 1 < static_cast<unsigned>(rings))
                mesh.triangles.push_back({a + 1, a + row, a + row + 1});
        }
    return mesh;
}

void SceneBuilder::sphere(glm::vec3 center, float radius, int material, int rings) {
    Shape shape;
    shape.name = "sphere";
    shape.mesh = sphere_mesh(center, radius, rings);
    shape.material = material;
    description_.shapes.push_back(std::move(shape));
}

void SceneBuilder::quadric(const Quadric& quadric, int material, int light) {
    Shape shape;
    shape.name = "quadric";
    shape.quadric = quadric;
    shape.material = material;
    shape.area_light = light;
    description_.shapes.push_back(std::move(shape));
}

void SceneBuilder::ball(glm::vec3 center, float radius, int material, int light) {
    glm::mat4 to_world(radius);
    to_world[3] = glm::vec4(center, 1);
    quadric(Quadric(Quadric::Kind::sphere, to_world, false), material, light);
}

int SceneBuilder::group_of_last(int shapes) {
    ShapeGroup& group = description_.groups.emplace_back();
    group.shapes.assign(description_.shapes.end() - shapes, description_.shapes.end());
    description_.shapes.resize(description_.shapes.size() - static_cast<std::size_t>(shapes));
    return static_cast<int>(description_.groups.size()) - 1;
}

void SceneBuilder::instance(int group, glm::mat4 to_world) {
    description_.instances.push_back({group, to_world});
}

void SceneBuilder::room(const std::vector<int>& m) {
    quad({-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, m[0]);
    quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, m[1]);
    quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, m[2]);
    quad({-1, -1, 1}, {0, 0, -2}, {0, 2, 0}, m[3]);
    quad({1, -1, -1}, {0, 0, 2}, {0, 2, 0}, m[4]);
}

glm::mat4 look_at(glm::vec3 origin, glm::vec3 target, glm::vec3 up) {
    const glm::vec3 forward = glm::normalize(target - origin);
    const glm::vec3 left = glm::normalize(glm::cross(up, forward));
    const glm::vec3 top = glm::cross(forward, left);
    return {glm::vec4(left, 0), glm::vec4(top, 0), glm::vec4(forward, 0), glm::vec4(origin, 1)};
}

void SceneBuilder::camera(glm::vec3 origin, glm::vec3 target, float fov) {
    description_.camera = {look_at(origin, target), fov, FovAxis::x};
}

void SceneBuilder::camera(const Camera& camera) {
    description_.camera = camera;
}

std::shared_ptr<const Scene> SceneBuilder::build() const {
    return std::make_shared<const Scene>(description_);
}

} // namespace tessera::test
