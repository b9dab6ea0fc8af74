#include "render/estimator/pass.h"

#include "render/estimator/guiding_learner.h"
#include "render/paths/base_path.h"

#include <bit>

#include <glm/common.hpp>

namespace tessera {

namespace {
float guiding_fraction_of(glm::ivec2 size, const RenderSettings& settings, const PathGuiding* guiding, int index) {
    if (settings.path_guiding == Guiding::off)
        return 0;
    return GuidingLearner::fraction_of_paths(size.x * size.y, index, guiding && guiding->draws());
}

/// Returns the pass with which the low-discrepancy nets of random numbers at x_1 (PassNumbers) begin: the first
/// pass that uses LearnedReuse, or the last power of two, whichever is later. Nets begin at powers of two even if
/// the render learns nothing.
int begin_of_nets(const LearnedReuse& learned, int pass) {
    return std::max(learned.first_pass(), static_cast<int>(std::bit_floor(static_cast<unsigned>(pass))));
}
} // namespace

Pass::Pass(const Scene& scene_, const Camera& camera, glm::ivec2 size_, const RenderSettings& settings_,
           const LearnedReuse& learned, int index_)
    : scene(scene_), settings(settings_), size(size_), index(index_),
      grid(size_, settings_, learned, index_, Projection(camera, size_).film_offset()),
      guiding_fraction(guiding_fraction_of(size_, settings_, learned.guiding(), index_)),
      projection_(camera, size_), film_offset_(projection_.film_offset()),
      filter_(settings_.filter == FilterKind::scene ? camera.filter : default_filter(settings_.filter)),
      has_lens_(camera.aperture_radius > 0),
      numbers_(settings_.seed, index_, begin_of_nets(learned, index_), camera_positions(settings_)) {}

/// Returns the key of a pixel's net. Blocks move with the grid of tiles, but the squares of 8 x 8 blocks keep
/// their keys, so few pixels change from one net to another between passes.
std::uint32_t Pass::place_of(glm::ivec2 pixel) const {
    constexpr int blocks = 8;
    const glm::ivec2 at = settings.method == Method::pt ? pixel + film_offset_ : grid.block_of(pixel) / blocks;
    return pixel_number(at);
}

CameraSample Pass::sample_at(int position, glm::ivec2 inside, int path) const {
    const std::uint32_t place = place_of(inside);
    const FilterSampler::Point point = filter_.sample(numbers_.subpixel(place, path, position));
    return {point.subpixel, has_lens_ ? sample_disk(numbers_.lens(place, path, position)) : glm::vec2(0),
            point.weight};
}

namespace {

// Keys of the nets over the feature samples of a pixel.
constexpr std::uint64_t features_in_pixel = 0x6c6f'6f6b'7069'786cu, features_on_lens = 0x6c6f'6f6b'6c65'6e73u;

} // namespace

/// Returns one point of the nets over feature samples.
/// @param subpixel, lens  digital shifts of the points
CameraSample Pass::feature_camera_sample(std::uint64_t subpixel, std::uint64_t lens, std::uint32_t point) const {
    const auto at = [&](std::uint64_t shift, std::uint64_t net) {
        return unit_square(shift ^ net_point(point, net));
    };
    const FilterSampler::Point seen = filter_.sample(at(subpixel, features_in_pixel));
    return {seen.subpixel, has_lens_ ? sample_disk(at(lens, features_on_lens)) : glm::vec2(0), seen.weight};
}

/// Returns the digital shifts of all feature samples of a pixel. They belong to no pass.
Random Pass::shift_of_features(int x, int y) const {
    return {settings.seed, pixel_number(glm::ivec2(x, y) + film_offset_), 0xffffffffu};
}

Rgb Pass::very_direct(const Tracer& tracer, int x, int y) const {
    const Random shift = shift_of_features(x, y);
    const std::uint64_t subpixel = shift.digits(2, Draw::direction), lens = shift.digits(3, Draw::direction);
    constexpr std::uint32_t rays = edge_emitter_rays;
    const std::uint32_t first = static_cast<std::uint32_t>(index) * rays;
    Rgb sum(0);
    for (std::uint32_t i = 0; i < rays; ++i) {
        const CameraSample from = feature_camera_sample(subpixel, lens, first + i);
        sum += from.weight * tracer.very_direct_along(camera_ray(x, y, from));
    }
    return sum / static_cast<float>(rays);
}

Rgb Pass::albedo_of(const BasePath& path) const {
    if (!is_demodulated(settings))
        return Rgb(1);
    return path.empty() ? Rgb(0) : path.albedo;
}

float Pass::coverage_of(const BasePath& path) const {
    const bool sees = !path.empty() || (scene.lights().environment() && !scene.hides_emitters());
    return sees ? path.weight : 0;
}

FeatureSample Pass::feature_sample(const Tracer& tracer, int x, int y, int point) const {
    const Random shift = shift_of_features(x, y);
    const CameraSample sample = feature_camera_sample(
        shift.digits(0, Draw::direction), shift.digits(1, Draw::direction), static_cast<std::uint32_t>(point));
    const Random numbers(settings.seed, pixel_number(glm::ivec2(x, y) + film_offset_),
                         0xfffffffcu - static_cast<std::uint32_t>(point)); // no pass has this number
    return feature_sample_along(tracer, camera_ray(x, y, sample), numbers);
}

bool Pass::first_vertex(const Tracer& tracer, int x, int y, int point, Vertex& seen) const {
    constexpr std::uint64_t middle = 0x8000'0000'8000'0000u; // of the first point
    const CameraSample sample =
        feature_camera_sample(middle ^ net_point(0, features_in_pixel), middle ^ net_point(0, features_on_lens),
                              static_cast<std::uint32_t>(point));
    return tracer.closest(tracer.visible_part(camera_ray(x, y, sample)), seen, RayKind::camera,
                          tracer.first_lookup());
}

std::size_t most_blocks(glm::ivec2 size, const RenderSettings& settings) {
    const int edge = block_edge_of(settings);
    const glm::ivec2 most = (size + 2 * (edge - 1)) / edge; // the first block begins less than a block before
    return static_cast<std::size_t>(most.x) * static_cast<std::size_t>(most.y);
}

std::vector<PixelRect> blocks_of(const Pass& pass) {
    const int edge = pass.grid.block_edge;
    const glm::ivec2 origin = pass.grid.block_origin;
    std::vector<PixelRect> blocks;
    for (int y = origin.y; y < pass.size.y; y += edge)
        for (int x = origin.x; x < pass.size.x; x += edge)
            if (!PixelRect{x, y, x + edge, y + edge}.clipped(pass.size).empty())
                blocks.push_back({x, y, x + edge, y + edge});
    return blocks;
}

} // namespace tessera
