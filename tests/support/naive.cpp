#include "tests/support/naive.h"

#include "render/paths/tracer.h"

#include <array>
#include <limits>
#include <random>
#include <vector>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace tessera::test {

namespace {

class Walk {
public:
    Walk(const Scene& scene, std::uint32_t seed) : scene_(scene), engine_(seed) {}

    float uniform() { return std::uniform_real_distribution<float>(0, 0x1.fffffep-1f)(engine_); }
    glm::vec2 uniform_2d() {
        const float u = uniform();
        return {u, uniform()};
    }

    /// Samples by rejection, unlike the estimators.
    glm::vec2 point_in_disk() {
        for (;;) {
            const glm::vec2 p = 2.0f * uniform_2d() - 1.0f;
            if (glm::dot(p, p) <= 1)
                return p;
        }
    }

    /// Returns the radiance of one path: directly visible emission, all other radiance, and the latter over
    /// `albedo`.
    std::array<Rgb, 3> radiance(Ray ray, int max_depth) {
        std::array<Rgb, 3> sums{Rgb(0), Rgb(0), Rgb(0)};
        Rgb throughput(1);
        albedo = Rgb(1);
        by_direction.clear();
        ByDirection onward;
        bool goes_on = false, is_very_direct = true;
        for (int edges = 1; edges <= max_depth; ++edges) {
            Hit hit;
            if (!scene_.intersector().closest(ray, hit)) {
                if (const Environment* around = scene_.lights().environment())
                    sums[is_very_direct ? 0 : 1] += throughput * around->radiance(ray.direction);
                break;
            }
            Vertex v;
            make_vertex(scene_, hit, ray, v);
            if (edges == 1)
                albedo = v.bsdf.albedo(v.to_previous);
            else if (is_very_direct && !scene_.has_masks()) // seen in mirrors only
                albedo = glm::max(throughput * v.bsdf.albedo(v.to_previous), Rgb(1e-4f));
            sums[is_very_direct ? 0 : 1] += throughput * v.light_toward(-ray.direction).radiance;
            is_very_direct = is_very_direct && v.bsdf.is_mirror();
            if (edges < max_depth)
                sums[1] += throughput * from_lights_without_extent(v, edges == 1);
            const float lobe = uniform();
            const auto s = v.bsdf.sample(v.to_previous, lobe, uniform_2d());
            if (!s)
                break;
            throughput *= s->f_cos / s->pdf_w;
            const glm::vec3 direction = v.to_world(s->to_next);
            if (edges == 1) {
                onward = {direction, s->is_delta ? Rgb(std::numeric_limits<float>::infinity()) : s->f_cos,
                          -sums[1]};
                goes_on = true;
            }
            ray = {scene_.intersector().off_surface(v.position, v.geometric_normal, direction), direction};
        }
        sums[2] = sums[1] / albedo;
        if (goes_on) {
            onward.carried += sums[1]; // minus the sum at x_1: radiance found after it
            by_direction.push_back(onward);
        }
        return sums;
    }

    // Results of the last radiance().
    Rgb albedo; ///< of the first surface that is no mirror, times the throughput of mirrors before it
    std::vector<ByDirection> by_direction;

private:
    /// Returns the reflected radiance of all point lights and directional lights.
    Rgb from_lights_without_extent(const Vertex& v, bool is_first) {
        Rgb sum(0);
        const auto add = [&](glm::vec3 direction, Rgb arriving) {
            const Rgb value = f_cos(v, direction);
            sum += value * arriving;
            if (is_first)
                by_direction.push_back({direction, value, value * arriving});
        };
        for (const PointLight& light : scene_.lights().points()) {
            const glm::vec3 d = light.position - v.position;
            const glm::vec3 direction = glm::normalize(d);
            if (visible(v, direction, light.position))
                add(direction, light.toward(-direction) / glm::dot(d, d));
        }
        for (const DirectionalLight& light : scene_.lights().directionals())
            if (visible(v, light.to_light, v.position + 100 * scene_.radius() * light.to_light))
                add(light.to_light, light.irradiance);
        return sum;
    }
    static Rgb f_cos(const Vertex& v, glm::vec3 direction) {
        return v.bsdf.evaluate(v.to_previous, v.to_local(direction)).f_cos;
    }
    bool visible(const Vertex& v, glm::vec3 direction, glm::vec3 end) const {
        const glm::vec3 start = scene_.intersector().off_surface(v.position, v.geometric_normal, direction);
        return !scene_.intersector().occluded(Segment{start, end});
    }

    const Scene& scene_;
    std::mt19937 engine_;
};

struct Moments {
    glm::dvec3 sum{0}, squares{0};

    void add(glm::dvec3 value) {
        sum += value;
        squares += value * value;
    }
    void measure(double count, int x, int y, Measured& result) const {
        const glm::dvec3 mean = sum / count;
        result.mean(x, y) = Rgb(mean);
        result.standard_error(x, y) = Rgb(glm::sqrt(glm::max(squares / count - mean * mean, 0.0) / count));
    }
};

} // namespace

NaiveMeasured render_naive(const Scene& scene, glm::ivec2 size, int max_depth, int samples, std::uint32_t seed) {
    Walk walk(scene, seed);
    const Measured black{RgbImage(size.x, size.y), RgbImage(size.x, size.y)};
    NaiveMeasured result{black, black, black};
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            std::array<Moments, 3> moments;
            for (int i = 0; i < samples; ++i) {
                const glm::vec2 inside = walk.uniform_2d();
                const glm::vec2 lens = scene.camera().aperture_radius > 0 ? walk.point_in_disk() : glm::vec2(0);
                const Ray ray = scene.camera().ray(glm::vec2(x, y) + inside, size, lens);
                const auto values = walk.radiance(ray, max_depth);
                for (std::size_t component = 0; component < moments.size(); ++component)
                    moments[component].add(values[component]);
            }
            moments[0].measure(samples, x, y, result.very_direct);
            moments[1].measure(samples, x, y, result.light);
            moments[2].measure(samples, x, y, result.coefficient);
        }
    return result;
}

std::vector<Measured> render_naive_components(const Scene& scene, glm::ivec2 size, int max_depth, int samples,
                                              std::uint32_t seed, int components,
                                              const ComponentsOf& components_of) {
    Walk walk(scene, seed);
    std::vector<Measured> result(static_cast<std::size_t>(components),
                                 {RgbImage(size.x, size.y), RgbImage(size.x, size.y)});
    std::vector<Rgb> values(static_cast<std::size_t>(components));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            std::vector<Moments> moments(static_cast<std::size_t>(components));
            for (int i = 0; i < samples; ++i) {
                walk.radiance(scene.camera().ray(glm::vec2(x, y) + walk.uniform_2d(), size), max_depth);
                components_of({x, y}, walk.albedo, walk.by_direction, values);
                for (std::size_t l = 0; l < values.size(); ++l)
                    moments[l].add(values[l]);
            }
            for (std::size_t l = 0; l < values.size(); ++l)
                moments[l].measure(samples, x, y, result[l]);
        }
    return result;
}

} // namespace tessera::test
