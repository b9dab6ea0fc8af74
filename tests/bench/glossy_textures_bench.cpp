// glossy_textures_bench [FOLDER [SCENE.xml]]: texture filtering in distributed ray tracing, the first application
// of path differentials [Suykens 2001, 5.1].
//
// Compares three texture lookups in glossy reflections and refractions: at points, over footprints, and over
// footprints limited by the path gradient. As in the paper, paths end at diffuse surfaces, which reflect only
// direct light, and each glossy surface continues them in four stratified directions. The paper has one ray per
// pixel, through its centre; grids of 4 and 16 rays are measured, too.
//
// Writes FOLDER/all-RAYS.png: the three pictures, and below them the reference of 25 random rays with point
// lookups. Prints relMSE without the reference's noise, and CPU seconds of one thread.
#include "recon/metrics/metrics.h"
#include "render/inspect/path_differentials.h"
#include "render/io/plain_images.h"
#include "render/load/mitsuba_xml.h"
#include "render/paths/base_path.h"
#include "render/run/thread_pool.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

namespace tessera {

namespace {

constexpr glm::ivec2 size(320, 180);
constexpr int splits_edge = 2, splits = splits_edge * splits_edge;
constexpr int max_scatters = 4;
constexpr float diffuse_roughness = 0.9f; ///< paths end at surfaces of at least this roughness

enum class Lookup : std::uint8_t { point, footprint, limited };
constexpr const char* names[] = {"point", "footprint", "limited"};

/// The distributed ray tracer. Each thread needs its own.
class RayTracer {
public:
    RayTracer(const Scene& scene, Lookup lookup, int rays_edge)
        : scene_(scene), tracer_{scene, counters_, {max_scatters + 2, 0}}, projection_(scene.camera(), size),
          lookup_(lookup), rays_edge_(rays_edge),
          rule_{static_cast<float>(rays_edge * rays_edge), false,
                lookup == Lookup::limited ? DeltaRule::published_change : 0, static_cast<float>(splits)} {}

    /// Returns the radiance of a pixel.
    /// @param jitters  draws each ray within its grid cell; otherwise rays pass through the centres of the cells
    Rgb pixel(glm::ivec2 p, std::uint64_t seed, bool jitters) {
        Rgb sum(0);
        for (int i = 0; i < rays_edge_ * rays_edge_; ++i) {
            random_ = Random(seed, static_cast<std::uint32_t>(p.y * size.x + p.x), static_cast<std::uint32_t>(i));
            draws_ = 0;
            const glm::vec2 place = jitters ? random_.draw_2d(0, Draw::direction) : glm::vec2(0.5f);
            const glm::vec2 at = glm::vec2(p) + (glm::vec2(i % rays_edge_, i / rays_edge_) + place) /
                                                    static_cast<float>(rays_edge_);
            std::optional<Differentiation> differential;
            if (lookup_ != Lookup::point)
                differential.emplace().start(projection_, at, glm::vec2(0));
            sum += radiance(projection_.ray(at), differential ? &*differential : nullptr, 0);
        }
        return sum / static_cast<float>(rays_edge_ * rays_edge_);
    }

private:
    /// Returns the radiance that arrives along a ray.
    /// @param differential  of the ray, by the random numbers so far; null: textures are looked up at points
    Rgb radiance(const Ray& ray, Differentiation* differential, int scatters) {
        Hit hit;
        if (!scene_.intersector().closest(ray, hit))
            return tracer_.environment_toward(ray.direction).radiance;
        Vertex x;
        if (differential) {
            differential->arrive(ray, hit.distance, hit.geometric_normal);
            const Footprint f = footprint(differential->derivatives(), rule_);
            const TextureView view(TextureView::Sides{f.a, f.b});
            make_vertex(scene_, hit, ray, x, &view);
        } else {
            make_vertex(scene_, hit, ray, x);
        }
        if (x.bsdf.roughness() >= diffuse_roughness)
            return x.light_toward(-ray.direction).radiance + direct(x);
        if (scatters == max_scatters)
            return Rgb(0);
        Rgb sum(0);
        const int offset = draws_;
        draws_ += splits;
        for (int i = 0; i < splits; ++i)
            sum += scattered(ray, hit, x, differential, scatters, offset, i) / static_cast<float>(splits);
        return sum;
    }

    /// Returns the radiance that stratum i of the scattered directions brings.
    Rgb scattered(const Ray& ray, const Hit& hit, const Vertex& x, const Differentiation* differential,
                  int scatters, int offset, int i) {
        const glm::vec2 u =
            (glm::vec2(i % splits_edge, i / splits_edge) + random_.draw_2d(offset + i, Draw::direction)) /
            static_cast<float>(splits_edge);
        // A random rotation decorrelates the strata of the lobe choice from those of the directions.
        const int rotation = static_cast<int>(random_.draw(offset, Draw::path_survival) * splits);
        const float lobe =
            (static_cast<float>((5 * i + rotation) % splits) + random_.draw(offset + i, Draw::lobe)) /
            static_cast<float>(splits);
        const auto s = x.sample(lobe, u);
        if (!s)
            return Rgb(0);
        const Ray next = tracer_.leave(x, x.to_world(s->to_next));
        std::optional<Differentiation> next_differential;
        if (differential)
            next_differential.emplace(*differential)
                .scatter(scene_, ray, hit, x,
                         {lobe, u, s->to_next, s->f_cos, s->pdf_w, s->is_delta, s->scatter, 1});
        return s->f_cos / s->pdf_w *
               radiance(next, next_differential ? &*next_differential : nullptr, scatters + 1);
    }

    /// Returns the reflected radiance of all point and directional lights, without noise.
    Rgb direct(const Vertex& x) {
        Rgb sum(0);
        for (const PointLight& light : scene_.lights().points())
            sum += direct(x, {LightPoint::Kind::point, light.position, glm::vec3(0), light.intensity, 1, &light});
        for (const DirectionalLight& light : scene_.lights().directionals())
            sum += direct(x, {LightPoint::Kind::directional, light.to_light, glm::vec3(0), light.irradiance, 1});
        return sum;
    }
    Rgb direct(const Vertex& x, const LightPoint& light) {
        const std::optional<LightRay> ray = light.seen_from(x.position);
        if (!ray)
            return Rgb(0);
        const Rgb f_cos = x.evaluate(x.to_local(ray->direction)).f_cos;
        if (is_black(f_cos) || tracer_.occluded(tracer_.toward_light(x, light, ray->direction), RayKind::light))
            return Rgb(0);
        return f_cos * ray->radiance / ray->pdf_w;
    }

    const Scene& scene_;
    Counters counters_;
    Tracer tracer_;
    Projection projection_;
    Lookup lookup_;
    int rays_edge_;
    DeltaRule rule_;
    Random random_{0, 0, 0};
    int draws_ = 0;
};

struct Rendered {
    RgbImage image;
    double cpu_seconds;
};

Rendered render(const Scene& scene, Lookup lookup, int rays_edge, std::uint64_t seed, bool jitters,
                ThreadPool& pool) {
    Rendered r{RgbImage(size.x, size.y, Rgb(0)), 0};
    const double begin = pool.cpu_seconds();
    pool.parallel_for(size.y, [&](int y, int) {
        RayTracer tracer(scene, lookup, rays_edge);
        for (int x = 0; x < size.x; ++x)
            r.image(x, y) = tracer.pixel({x, y}, seed, jitters);
    });
    r.cpu_seconds = pool.cpu_seconds() - begin;
    return r;
}

/// Returns the pictures in one column.
RgbImage strip(const std::vector<RgbImage>& pictures) {
    const int width = size.x, height = size.y * static_cast<int>(pictures.size());
    RgbImage all(width, height, Rgb(0));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            all(x, y) = pictures[static_cast<std::size_t>(y / size.y)](x, y % size.y);
    return all;
}

void run(const std::filesystem::path& folder, const Scene& scene) {
    std::filesystem::create_directories(folder);
    ThreadPool pool;
    ThreadPool single_thread(1);
    constexpr int reference_edge = 5;
    const RgbImage references[] = {render(scene, Lookup::point, reference_edge, 1001, true, pool).image,
                                   render(scene, Lookup::point, reference_edge, 1002, true, pool).image};
    for (const int edge : {1, 2, 4}) {
        std::vector<RgbImage> pictures;
        for (const Lookup lookup : {Lookup::point, Lookup::footprint, Lookup::limited}) {
            const char* name = names[static_cast<std::size_t>(lookup)];
            const Rendered r = render(scene, lookup, edge, 7, false, single_thread);
            fmt::print("{:2} rays a pixel, {:9}: relMSE {:.5f}, {:.2f} CPU s\n", edge * edge, name,
                       measure_floor_free_error(r.image, references[0], references[1]).relative_mse,
                       r.cpu_seconds);
            pictures.push_back(r.image);
        }
        pictures.push_back(references[0]);
        write_png(folder / fmt::format("all-{}.png", edge * edge), strip(pictures));
    }
}

} // namespace

} // namespace tessera

int main(int count, char** arguments) {
    const std::filesystem::path scene =
        count > 2 ? arguments[2] : TESSERA_SOURCE_DIR "/assets/footprints/pieces.xml";
    tessera::run(count > 1 ? arguments[1] : "glossy-textures",
                 tessera::Scene(tessera::load_mitsuba_xml(scene).description));
}
