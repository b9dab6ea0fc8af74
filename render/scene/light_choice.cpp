#include "render/scene/light.h"
#include "render/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

// These constants are not tuned.
constexpr glm::ivec2 path_grid(16, 9);
constexpr int max_vertices = 3;
constexpr int samples_per_vertex = 4;  // of each group
constexpr float albedo = 0.5f;         // assumed for all surfaces
constexpr std::size_t max_groups = 32; // all weaker lights share the last group
// Fractions of the samples chosen by power and uniformly, because learning may miss a light that matters to few
// pixels.
constexpr double power_fraction = 0.1, uniform_fraction = 0.1;

/// The contribution of one light sample to a pixel.
struct Contribution {
    double light = 0; // luminance, as a fraction of the pixel's
    double bsdf_density =
        0; // pdf of BSDF sampling over that of emitter sampling of the light's Group; 0: it cannot hit
};

/// Lights that share one probability; usually a single light.
struct Group {
    std::vector<std::size_t> lights;
    double power = 0;
    double probability = 0; // of sampling this group
    LightTable table;       // of the group's lights only
    std::vector<Contribution> samples;
};

std::vector<Group> groups_of(const Scene& scene) {
    const std::vector<double> power = scene.lights().powers();
    std::vector<std::size_t> order(power.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order, [&](std::size_t i) { return !(power[i] > 0); });
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return power[a] > power[b]; });
    std::vector<Group> groups(std::min(order.size(), max_groups));
    for (std::size_t i = 0; i < order.size(); ++i) {
        Group& group = groups[std::min(i, groups.size() - 1)];
        group.lights.push_back(order[i]);
        group.power += power[order[i]];
    }
    for (Group& group : groups) {
        std::vector<double> factors(power.size(), 0.0);
        for (const std::size_t light : group.lights)
            factors[light] = 1;
        group.table = LightTable(scene.description(), scene.radius(), factors);
    }
    return groups;
}

/// A surface point that receives light; treated as diffuse.
struct Receiver {
    glm::vec3 position, geometric_normal;
    glm::vec3 normal; ///< the geometric normal turned to the viewer's side
};

Contribution sample_group(const Scene& scene, const LightTable& table, const Receiver& at, const Random& random,
                          int number) {
    LightPoint light;
    if (!table.sample(at.position, random, number, light))
        return {};
    table.complete(light);
    const std::optional<LightRay> ray = light.seen_from(at.position);
    const float cos = ray ? glm::dot(ray->direction, at.normal) : 0;
    if (!(cos > 0) || !(ray->pdf_w > 0))
        return {};
    const Intersector& intersector = scene.intersector();
    const glm::vec3 start = intersector.off_surface(at.position, at.geometric_normal, ray->direction);
    const glm::vec3 end =
        light.is_at_infinity()
            ? start + 2.02f * (glm::distance(at.position, scene.center()) + scene.radius()) * ray->direction
            : intersector.off_surface(light.position, light.normal, -ray->direction);
    if (intersector.occluded({start, end}))
        return {};
    return {luminance(ray->radiance) * cos / ray->pdf_w, light.can_be_hit() ? inv_pi * cos / ray->pdf_w : 0};
}

std::optional<Receiver> receiver_at(const Scene& scene, const Ray& ray) {
    Hit hit;
    if (!scene.intersector().closest(ray, hit))
        return {};
    const glm::vec3 normal = hit.geometric_normal;
    return Receiver{ray.origin + hit.distance * ray.direction, normal,
                    glm::dot(normal, ray.direction) < 0 ? normal : -normal};
}

/// Samples all groups at all vertices of a path and appends the contributions, normalised by the path's total.
void sample_groups_along(const Scene& scene, Ray ray, const Random& random, std::vector<Group>& groups) {
    const std::size_t first_sample = groups.front().samples.size();
    const int count = static_cast<int>(groups.size());
    double total = 0, throughput = 1;
    for (int vertex = 0; vertex < max_vertices; ++vertex, throughput *= albedo) {
        const std::optional<Receiver> at = receiver_at(scene, ray);
        if (!at)
            break;
        for (int i = 0; i < samples_per_vertex * count; ++i) {
            Group& group = groups[i % count];
            Contribution contribution =
                sample_group(scene, group.table, *at, random, 1 + vertex * samples_per_vertex * count + i);
            contribution.light *= throughput;
            total += contribution.light / samples_per_vertex;
            group.samples.push_back(contribution);
        }
        const glm::vec3 direction =
            Frame(at->normal).to_world(sample_cosine_hemisphere(random.draw_2d(vertex, Draw::direction)));
        ray = {scene.intersector().off_surface(at->position, at->geometric_normal, direction), direction};
    }
    for (Group& group : groups)
        for (std::size_t i = first_sample; i < group.samples.size(); ++i)
            group.samples[i].light /= total > 0 ? total : 1;
}

/// Finds the probabilities p_k that minimise the second moment of emitter and BSDF sampling combined by the
/// balance heuristic, sum_k E_k[c^2 / (p_k + b)]. Here c is Contribution::light of a sample of group k, and b its
/// bsdf_density. At the minimum, p_k is in proportion to sqrt(E_k[(c p_k / (p_k + b))^2]), which is iterated.
/// Returns false if no sample contributes.
bool optimise_probabilities(std::vector<Group>& groups) {
    constexpr int rounds = 16;
    for (Group& group : groups)
        group.probability = 1.0 / static_cast<double>(groups.size());
    for (int round = 0; round < rounds; ++round) {
        double sum = 0;
        for (Group& group : groups) {
            double squares = 0;
            for (const Contribution& contribution : group.samples) {
                const double weighted =
                    contribution.light * group.probability / (group.probability + contribution.bsdf_density);
                squares += weighted * weighted;
            }
            group.probability = std::sqrt(squares);
            sum += group.probability;
        }
        if (!(sum > 0))
            return false;
        for (Group& group : groups)
            group.probability = std::max(group.probability / sum, 1e-6); // a probability of 0 would never grow
    }
    return true;
}

} // namespace

std::vector<double> learn_light_selection(const Scene& scene) {
    std::vector<Group> groups = groups_of(scene);
    if (groups.size() < 2)
        return {};
    const Projection projection(scene.camera(), path_grid);
    for (int y = 0; y < path_grid.y; ++y)
        for (int x = 0; x < path_grid.x; ++x) {
            const Random random(0x6c69'6768'7473u, static_cast<std::uint32_t>(y * path_grid.x + x), 0);
            sample_groups_along(scene, projection.ray(glm::vec2(x, y) + random.draw_2d(0, Draw::lobe)), random,
                                groups);
        }
    if (!optimise_probabilities(groups))
        return {};
    double power = 0;
    for (const Group& group : groups)
        power += group.power;
    std::vector<double> factors(scene.lights().powers().size(), 0.0);
    for (const Group& group : groups) {
        const double by_power = group.power / power;
        const double probability = (1 - power_fraction - uniform_fraction) * group.probability +
                                   power_fraction * by_power +
                                   uniform_fraction / static_cast<double>(groups.size());
        for (const std::size_t light : group.lights)
            factors[light] = probability / by_power;
    }
    return factors;
}

} // namespace tessera
