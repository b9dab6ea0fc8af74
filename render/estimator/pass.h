#pragma once

#include "render/estimator/learned_reuse.h"
#include "render/estimator/tile_grid.h"
#include "render/paths/tracer.h"
#include "render/sampling/pass_numbers.h"
#include "render/settings/settings.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

struct BasePath;

/// Position of a camera ray in its pixel and on the lens.
struct CameraSample {
    glm::vec2 subpixel; ///< from the pixel's top left corner, pixels; within [0, 1)^2 for the box filter
    glm::vec2 lens{0};  ///< from the centre, in radii of the lens
    float weight = 1;   ///< of the reconstruction filter (FilterSampler::Point)
};

/// One sample per pixel of the whole image: the data that all blocks of a pass use.
class Pass {
public:
    /// Keeps references to scene, settings and `learned`.
    /// @param index  counts passes from 0
    Pass(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
         const LearnedReuse& learned, int index);

    const Scene& scene;
    const RenderSettings& settings;
    const glm::ivec2 size;
    const int index;
    const TileGrid grid;
    const float guiding_fraction; ///< of the base paths: later passes learn guides from these

    /// Returns the camera sample of a pixel. All pixels whose base paths are reused within one block have the
    /// same sample, including the block's border. So the values of the reconstruction filter cancel in gradients
    /// [Bauszat 2017, 3.2], and all these pixels see the scene through one pinhole, with a sharp picture. PT's
    /// pixels have samples of their own. All samples are nets over the passes with different digital shifts: one
    /// net for each pixel of PT, or for each square of 8 x 8 blocks. With the same few positions for a whole
    /// image, edges parallel to pixel rows would be too bright or too dark along their whole length.
    /// @param path  index among several paths of a pixel without reuse; only path 0 can be reused
    CameraSample camera_sample(glm::ivec2 pixel, int path = 0) const {
        return sample_at(PassNumbers::only, pixel, path);
    }

    /// Returns whether a pixel sees several surfaces, so that the pass sees it from camera_positions(settings)
    /// positions to receive light. All such pixels of a block have the same positions.
    bool is_mixed(glm::ivec2 pixel) const { return has_positions(settings) && grid.is_mixed(pixel); }
    /// Returns the number of positions from which the pass sees a set of pixels: one if no pixel is mixed.
    int positions_of(std::span<const glm::ivec2> set) const {
        return std::ranges::any_of(set, [&](glm::ivec2 p) { return is_mixed(p); }) ? camera_positions(settings)
                                                                                   : 1;
    }
    /// Returns the position at which a pixel's base path is reused, if any pixel of its set is mixed.
    int turn(glm::ivec2 pixel) const { return numbers_.turn(pixel + film_offset_); }
    /// Returns the camera sample of a pixel's base path, at the position of its turn if the pixel is mixed.
    /// @param inside  any pixel of the block whose pixels reuse the path
    CameraSample base_sample(glm::ivec2 pixel, glm::ivec2 inside, int path = 0) const {
        return sample_at(is_mixed(pixel) ? turn(pixel) : PassNumbers::only, inside, path);
    }
    CameraSample base_sample(glm::ivec2 pixel, int path = 0) const { return base_sample(pixel, pixel, path); }
    /// Returns the camera sample of one position of mixed pixels. PassNumbers::only stands for all other pixels.
    CameraSample sample_at(int position, glm::ivec2 inside, int path) const;

    Ray camera_ray(int x, int y, const CameraSample& sample) const {
        return projection_.ray(glm::vec2(x, y) + sample.subpixel, sample.lens);
    }

    /// Estimates the directly visible emission of a pixel with edge_emitter_rays camera rays. Their points in the
    /// pixel and on the lens are a net over the passes, with its own scrambling for each pixel. No two rays of a
    /// net share a row or a column, in contrast to a grid, so vertical and horizontal edges have little noise.
    Rgb very_direct(const Tracer& tracer, int x, int y) const;

    /// Returns the albedo a of theory (27) by which a base path's radiance is divided: that of x_1, or of the
    /// surface that mirrors show there; black where the path sees nothing; 1 if settings.basis has no albedo.
    Rgb albedo_of(const BasePath& path) const;
    /// Returns the alpha of a base path with its filter weight: 0 if it sees nothing, as in Mitsuba. A visible
    /// environment counts as something.
    float coverage_of(const BasePath& path) const;
    /// Takes feature sample `point` of a pixel. The points of a pixel are a net that is independent of the
    /// passes' samples, so means of albedos are, too.
    FeatureSample feature_sample(const Tracer& tracer, int x, int y, int point) const;
    /// Traces a camera ray through point `point` of a pixel, the same for all seeds. Returns false if it hits
    /// nothing.
    bool first_vertex(const Tracer& tracer, int x, int y, int point, Vertex& seen) const;

    PixelWidth pixel_width() const { return projection_.pixel_width(); }
    const Projection& projection() const { return projection_; }
    const FilterSampler& filter() const { return filter_; }
    bool has_lens() const { return has_lens_; }

    /// Returns the random numbers of a pixel's path; `path` as in camera_sample(). The numbers at x_1 are a net
    /// over blocks of pixels and over the passes with the same LearnedReuse. They are independent of the earlier
    /// passes, from which LearnedReuse learned.
    Random random(int x, int y, int path = 0) const {
        return numbers_.of_path(glm::ivec2(x, y) + film_offset_, path);
    }

private:
    std::uint32_t place_of(glm::ivec2 pixel) const; // for PassNumbers
    Random shift_of_features(int x, int y) const;
    CameraSample feature_camera_sample(std::uint64_t subpixel, std::uint64_t lens, std::uint32_t point) const;

    Projection projection_;
    glm::ivec2 film_offset_; ///< random numbers are those of the pixel of the whole film
    FilterSampler filter_;
    bool has_lens_;
    PassNumbers numbers_;
};

/// Returns the blocks of this pass's image, one for each task of a worker. Blocks have whole tiles, so they can
/// reach beyond the image.
std::vector<PixelRect> blocks_of(const Pass& pass);

/// Returns the largest number of blocks of a pass over an image of that size, for any origin of its tiles.
std::size_t most_blocks(glm::ivec2 size, const RenderSettings& settings);

} // namespace tessera
