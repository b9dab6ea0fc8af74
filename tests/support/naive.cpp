#include "tests/support/naive.h"

#include "render/path/vertex.h"

#include <random>

#include <glm/exponential.hpp>

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

    Rgb radiance(Ray ray, int max_depth) {
        Rgb sum(0), throughput(1);
        for (int edges = 1; edges <= max_depth; ++edges) {
            Hit hit;
            if (!scene_.intersector().closest(ray, hit))
                break;
            Vertex v;
            make_vertex(scene_, hit, ray, v);
            if (edges > 1)
                sum += throughput * v.light_toward(-ray.direction).radiance;
            const float lobe = uniform();
            const auto s = v.bsdf.sample(v.to_previous, lobe, uniform_2d());
            if (!s)
                break;
            throughput *= s->f_cos / s->pdf_w;
            const glm::vec3 direction = v.to_world(s->to_next);
            ray = {scene_.intersector().off_surface(v.position, v.geometric_normal, direction), direction};
        }
        return sum;
    }

private:
    const Scene& scene_;
    std::mt19937 engine_;
};

} // namespace

Measured render_naive(const Scene& scene, glm::ivec2 size, int max_depth, int samples, std::uint32_t seed) {
    Walk walk(scene, seed);
    Measured result{RgbImage(size.x, size.y), RgbImage(size.x, size.y)};
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            glm::dvec3 sum(0), squares(0);
            for (int i = 0; i < samples; ++i) {
                const glm::vec2 inside = walk.uniform_2d();
                const glm::dvec3 value =
                    walk.radiance(scene.camera().ray(glm::vec2(x, y) + inside, size), max_depth);
                sum += value;
                squares += value * value;
            }
            const glm::dvec3 mean = sum / double(samples);
            result.mean(x, y) = Rgb(mean);
            result.standard_error(x, y) =
                Rgb(glm::sqrt(glm::max(squares / double(samples) - mean * mean, 0.0) / double(samples)));
        }
    return result;
}

} // namespace tessera::test
