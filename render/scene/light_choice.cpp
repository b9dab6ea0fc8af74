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

constexpr glm::ivec2 paths(16, 9);
constexpr int most_vertices = 3;
constexpr int samples = 4;             // of each light at each vertex
constexpr float albedo = 0.5f;         // of everything
constexpr std::size_t most_alone = 32; // lights that are learnt one by one; the weaker ones are learnt together
// What was learnt may have missed a light that matters to a few pixels: shares of the samples go by power and to
// all lights alike.
constexpr double share_by_power = 0.1, share_of_all = 0.1;

/// What one sample of a group's lights brings to a pixel.
struct Brought {
    double light = 0; // luminance, as a share of the pixel's; 0: nothing
    double bsdf_density =
        0; // of BSDF sampling in that direction over that of the group's; 0: it cannot find the light
};

/// Lights that are learnt together, most often one alone.
struct Group {
    std::vector<std::size_t> lights;
    double power = 0;
    double share = 0; // of all samples
    LightTable table; // of these alone
    std::vector<Brought> samples;
};

std::vector<Group> groups_of(const Scene& scene) {
    const std::vector<double> power = scene.lights().powers();
    std::vector<std::size_t> order(power.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order, [&](std::size_t i) { return !(power[i] > 0); });
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return power[a] > power[b]; });
    std::vector<Group> groups(std::min(order.size(), most_alone));
    for (std::size_t i = 0; i < order.size(); ++i) {
        Group& group = groups[std::min(i, groups.size() - 1)];
        group.lights.push_back(order[i]);
        group.power += power[order[i]];
    }
    for (Group& group : groups) {
        std::vector<double> only(power.size(), 0.0);
        for (const std::size_t light : group.lights)
            only[light] = 1;
        group.table = LightTable(scene.description(), scene.radius(), only);
    }
    return groups;
}

/// A point that light arrives at, as if it were diffuse.
struct Receiver {
    glm::vec3 position, geometric_normal, normal; ///< the latter on the side that it is seen from
};

Brought sample_group(const Scene& scene, const LightTable& table, const Receiver& at, const Random& random,
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

/// Tries all groups at all vertices of a path.
void learn_from(const Scene& scene, Ray ray, const Random& random, std::vector<Group>& groups) {
    const std::size_t first = groups.front().samples.size(); // of this path
    const int count = static_cast<int>(groups.size());
    double total = 0, throughput = 1;
    for (int vertex = 0; vertex < most_vertices; ++vertex, throughput *= albedo) {
        const std::optional<Receiver> at = receiver_at(scene, ray);
        if (!at)
            break;
        for (int i = 0; i < samples * count; ++i) {
            Group& group = groups[i % count];
            Brought brought = sample_group(scene, group.table, *at, random, 1 + vertex * samples * count + i);
            brought.light *= throughput;
            total += brought.light / samples;
            group.samples.push_back(brought);
        }
        const glm::vec3 direction =
            Frame(at->normal).to_world(sample_cosine_hemisphere(random.draw_2d(vertex, Draw::direction)));
        ray = {scene.intersector().off_surface(at->position, at->geometric_normal, direction), direction};
    }
    for (Group& group : groups)
        for (std::size_t i = first; i < group.samples.size(); ++i)
            group.samples[i].light /= total > 0 ? total : 1;
}

/// The shares p_k that minimise the second moment of what emitter and BSDF sampling find together, weighted by the
/// balance heuristic: sum_k E_k[c^2 / (p_k + b)], where c is what a sample of group k brings and b the density of
/// BSDF sampling over that of k. Its derivatives are equal where p_k is in proportion to sqrt(E_k[(c p_k / (p_k +
/// b))^2]), the root of what a sample brings after its weight. False: nothing brings any light.
bool find_shares(std::vector<Group>& groups) {
    constexpr int rounds = 16;
    for (Group& group : groups)
        group.share = 1.0 / static_cast<double>(groups.size());
    for (int round = 0; round < rounds; ++round) {
        double sum = 0;
        for (Group& group : groups) {
            double squares = 0;
            for (const Brought& brought : group.samples) {
                const double weighted = brought.light * group.share / (group.share + brought.bsdf_density);
                squares += weighted * weighted;
            }
            group.share = std::sqrt(squares);
            sum += group.share;
        }
        if (!(sum > 0))
            return false;
        for (Group& group : groups)
            group.share = std::max(group.share / sum, 1e-6); // 0 would stay 0
    }
    return true;
}

} // namespace

std::vector<double> learn_light_factors(const Scene& scene) {
    std::vector<Group> groups = groups_of(scene);
    if (groups.size() < 2)
        return {};
    const Projection projection(scene.camera(), paths);
    for (int y = 0; y < paths.y; ++y)
        for (int x = 0; x < paths.x; ++x) {
            const Random random(0x6c69'6768'7473u, static_cast<std::uint32_t>(y * paths.x + x), 0);
            learn_from(scene, projection.ray(glm::vec2(x, y) + random.draw_2d(0, Draw::lobe)), random, groups);
        }
    if (!find_shares(groups))
        return {};
    double power = 0;
    for (const Group& group : groups)
        power += group.power;
    std::vector<double> factors(scene.lights().powers().size(), 0.0);
    for (const Group& group : groups) {
        const double by_power = group.power / power;
        const double share = (1 - share_by_power - share_of_all) * group.share + share_by_power * by_power +
                             share_of_all / static_cast<double>(groups.size());
        for (const std::size_t light : group.lights)
            factors[light] = share / by_power;
    }
    return factors;
}

} // namespace tessera
