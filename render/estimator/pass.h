#pragma once

#include "recon/image.h"
#include "render/estimator/path_reuse.h"
#include "render/estimator/reuse_policy.h"
#include "render/estimator/sampling_set.h"
#include "render/estimator/tile_grid.h"
#include "render/film/film.h"
#include "render/sampling/pass_numbers.h"
#include "render/settings/settings.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// Where a camera ray goes through its pixel and through the lens.
struct CameraSample {
    glm::vec2 subpixel; ///< within the pixel, [0, 1)^2
    glm::vec2 lens{0};  ///< in radii of the lens, from its middle
};

/// One sample a pixel of a whole image: what all its blocks have in common.
class Pass {
public:
    /// `index` counts passes from 0. Keeps references to scene, settings and plan.
    Pass(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
         const ReusePlan& plan, int index);

    const Scene& scene;
    const RenderSettings& settings;
    const glm::ivec2 size;
    const int index;
    const TileGrid grid;
    const float telling_share; ///< of the base paths: what they find is learnt, to guide later passes

    /// Where within their pixels and on the lens all base paths begin whose light is shared within the block that
    /// a pixel is in, those of the block's border among them: so the values of the box filter cancel in gradients
    /// [Bauszat 2017, 3.2], and all see the scene through the same pinhole, whose picture is sharp. PT's pixels
    /// have positions of their own. All are nets over the passes, each shifted by another pattern of digits: one
    /// for a pixel of PT's, or for a square of 8 x 8 blocks, as an edge along which all pixels had the same few
    /// positions would be too bright, or too dark, all along.
    /// @param path  of several that a pixel takes for itself alone; the first, 0, is the one that can be shared
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
    /// At which of the positions the base path of a pixel is shared, where any pixel of its set is mixed.
    int turn(glm::ivec2 pixel) const { return numbers_.turn(pixel); }
    /// Where the base path of a pixel begins: if it is mixed, at its turn's position.
    /// @param inside  any pixel of the block whose pixels get its light
    CameraSample base_sample(glm::ivec2 pixel, glm::ivec2 inside, int path = 0) const {
        return sample_at(is_mixed(pixel) ? turn(pixel) : PassNumbers::only, inside, path);
    }
    CameraSample base_sample(glm::ivec2 pixel, int path = 0) const { return base_sample(pixel, pixel, path); }
    /// One of the positions of mixed pixels, or PassNumbers::only, that of all others.
    CameraSample sample_at(int position, glm::ivec2 inside, int path) const;

    Ray camera_ray(int x, int y, const CameraSample& sample) const {
        return projection_.ray(glm::vec2(x, y) + sample.subpixel, sample.lens);
    }

    /// Estimates the directly visible emission of a pixel with edge_emitter_rays camera rays. Their points in the
    /// pixel and on the lens are a net over the passes, with its own scrambling for each pixel. No two rays of a
    /// net share a row or a column, in contrast to a grid, so vertical and horizontal edges have little noise.
    Rgb very_direct(const Tracer& tracer, int x, int y) const;

    /// What a base path's radiance is divided by: the albedo at x_1 or of what mirrors show there, black where it
    /// sees nothing; or 1, where settings.basis has no albedo.
    Rgb albedo_of(const BasePath& path) const {
        if (!is_demodulated(settings))
            return Rgb(1);
        return path.empty() ? Rgb(0) : path.albedo;
    }
    /// A look at a point of its own of a pixel. The points of a pixel are a net, which has nothing to do with
    /// where samples lie: means of albedos are independent of the samples.
    Look look_at(const Tracer& tracer, int x, int y, int point) const;
    /// What is seen at a point of a pixel, the same for all seeds; false: nothing.
    bool look_at(const Tracer& tracer, int x, int y, int point, Vertex& seen) const;

    const Projection& projection() const { return projection_; }
    PixelWidth pixel_width() const { return projection_.pixel_width(); }
    bool has_lens() const { return has_lens_; }

    /// The numbers of a pixel's path; `path` as in camera_sample(). What is drawn at x_1 is a net over the passes
    /// that go by one plan, and over blocks of pixels, and independent of the passes before, by which that was
    /// made.
    Random random(int x, int y, int path = 0) const { return numbers_.of_path({x, y}, path); }

private:
    std::uint32_t place_of(glm::ivec2 pixel) const; // for PassNumbers
    Random shift_of_looks(int x, int y) const;
    CameraSample look_from(std::uint64_t subpixel, std::uint64_t lens, std::uint32_t point) const;

    Projection projection_;
    bool has_lens_;
    PassNumbers numbers_;
};

/// The mean of several base paths of a pixel.
struct MeanOfPaths {
    Rgb coefficient{0}, radiance{0}, albedo{0}, very_direct{0};
    Rgb albedo_squares{0}, albedo_values{0}; ///< of the albedo, and of it times radiance

    /// Adds one of `count` paths.
    void add(const Pass& pass, const BasePath& path, int count);
};

/// The base paths of a rectangle of pixels.
class BaseBlock {
public:
    /// For the light that pixels of the block of `inside` get, and no others.
    /// @param number  of the paths, as in Pass::camera_sample()
    void trace(const Pass& pass, const Tracer& tracer, PixelRect rect, glm::ivec2 inside, int number = 0);
    const BasePath& at(int x, int y) const { return paths_[index(x, y)]; }

    /// Whether any of its pixels is mixed (Pass::is_mixed).
    bool is_mixed() const { return !mixed_.empty(); }
    /// Sees the mixed pixels from a position.
    void see_from(const Pass& pass, const Tracer& tracer, int position);
    /// What a pixel sees from the position of the last see_from(): its base path, or if it is mixed and that is
    /// shared at another one, no more than x_1. The base path if there was no see_from() since trace().
    const BasePath& seen(int x, int y) const {
        const std::size_t i = index(x, y);
        return i < glimpse_of_.size() && glimpse_of_[i] >= 0 ? glimpses_[static_cast<std::size_t>(glimpse_of_[i])]
                                                             : paths_[i];
    }

    /// What paths of its own alone bring a pixel that shares nothing; that of others is anything.
    MeanOfPaths& mean(int x, int y) {
        means_.resize(paths_.size());
        return means_[index(x, y)];
    }

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>((y - rect_.y0) * rect_.width() + x - rect_.x0);
    }

    PixelRect rect_{0, 0, 0, 0};
    std::vector<BasePath> paths_; // never shrinks, so that vertices keep their memory
    std::vector<MeanOfPaths> means_;
    glm::ivec2 inside_{0};
    int number_ = 0;
    std::vector<glm::ivec2> mixed_;        ///< pixels
    std::vector<std::int16_t> glimpse_of_; ///< by pixels; -1: it sees its base path
    std::vector<BasePath> glimpses_;       ///< never shrinks
};

/// What a worker carries from block to block: memory and counts.
struct Worker {
    /// Keeps references to all but the camera.
    /// @param guiding  of this pass; null: none
    Worker(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
           const PathGuiding* guiding)
        : tracer{scene,
                 counters,
                 settings,
                 {settings.filter_textures, is_demodulated(settings), camera, size},
                 guiding && guiding->draws() ? guiding : nullptr},
          reuse(tracer, settings) {}
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// About the memory that one takes: that of the base paths of a block, which are as long as they happen to be.
    static std::uint64_t bytes(const RenderSettings& settings);

    Counters counters;
    std::vector<FoundLight> found; ///< by the first base path of each pixel of the block at hand
    double cpu_seconds = 0;
    Tracer tracer;
    PathReuse reuse;
    BaseBlock base;
    BasePath path;
    SamplingSet set;
    SetMeans set_means;         ///< of the block at hand
    ArrivingLight own;          ///< of one base path
    std::vector<Rgb> own_parts; ///< of it
};

/// Cuts the image of this pass into blocks for the workers. Tiles stay whole, so blocks may reach beyond the
/// image.
std::vector<PixelRect> blocks_of(const Pass& pass);

/// How many there are at most in a pass over an image of that size, wherever its tiles begin.
std::size_t most_blocks(glm::ivec2 size, const RenderSettings& settings);

/// Renders the pixels of one block of blocks_of() into the film with the pass's method (methods.cpp). Tiles are
/// cut off at the image's border, nowhere else.
void render_block(const Pass& pass, PixelRect block, Worker& worker, Film& film);

/// Of how many pixels the sampling set is that each pixel of the image has its light from in a pass of PR or G-PR;
/// 1: it shares nothing (methods.cpp).
Image<float> sharers_of(const Pass& pass);

/// Looks at each pixel of the block for the first time.
void take_first_looks(const Pass& pass, PixelRect block, Worker& worker, PixelLooks& looks);

/// Traces the path of one sample of this pass, from there in its pixel and on the lens. One that is not finite is
/// refused, counted, and left empty: it would spoil all pixels that share it.
/// @param number  of the path, as in Pass::camera_sample()
void trace_pixel(const Pass& pass, const Tracer& tracer, int x, int y, const CameraSample& from, BasePath& path,
                 int number = 0);

/// Whether later passes are to learn from what the base path with these random numbers finds.
bool tells_of_light(const Pass& pass, const Random& random);

/// Notes what light the base path of a pixel has found, if it is to tell of it.
void note_light(const Pass& pass, const BasePath& path, std::vector<FoundLight>& found);

/// How many looks it takes to find the edges of lamps: some, as lamps may be narrower than pixels, and surfaces
/// before them may be there for one ray and not for another; with a lens one through each of 16 parts, as what it
/// blurs is seen through some of its points only.
int very_direct_looks(const Pass& pass);

/// Very direct light of the block's pixels, and of those beside it beyond the image's borders, along a ray through
/// one of 16 parts of each, by turns, and through that part of the lens: pixels side by side look through
/// different ones, and differ where a lamp is blurred, too.
/// @param picture  with a pixel more than the image on all four sides
void show_very_direct(const Pass& pass, int look, PixelRect block, const Tracer& tracer, RgbImage& picture);

/// How many points of a pixel tell its projections.
inline constexpr int projection_points = 4;

/// Works out the projections of the block's pixels, before the first pass.
void find_projections(const Pass& pass, PixelRect block, const Tracer& tracer, Film& film);

/// Adds a sample to the film. At the edges of directly visible emitters, several camera rays replace its directly
/// visible emission (Pass::very_direct): such rays are cheap, and no other pixel reuses their result. These edges
/// are found before the first pass, because edges that samples find would bias pixels with a small emitter upward.
void add_sample(const Pass& pass, int x, int y, PixelSample sample, Worker& worker, Film& film);

/// Whether base path k of worker.set is reused. Counted.
ReuseDecision decide_on_reuse(int k, const ReuseRoulette& roulette, Worker& worker);

/// Lets the pixels of worker.set, all of them in worker.base, share the light of their base paths, or if they are
/// seen from several positions of those whose turn it is at the one at hand; the set then holds what each has got.
/// @param kind  a path is reused with the probability q that this kind of ReuseRoulette gives it, and weighs 1/q;
///              a path that is not shares nothing [Bauszat 2017, 3.3]
/// @param watch is called as watch(k, decision) when the light of path k has been shared out; worker.reuse then
///              knows how that went
template <class Watch>
void share_light(const Pass& pass, RouletteKind kind, Worker& worker, Watch&& watch) {
    SamplingSet& set = worker.set;
    set.collect(pass, worker.base);
    const ReuseRoulette roulette(kind, pass.settings, worker.reuse, set.base);
    worker.reuse.begin(set.paths, set.counts);
    const std::uint64_t rays = worker.counters.offset_work();
    for (int k = 0; k < set.size(); ++k) {
        if (set.positions > 1 && pass.turn(set.pixels[static_cast<std::size_t>(k)]) != set.position)
            continue;
        const ReuseDecision decision = decide_on_reuse(k, roulette, worker);
        worker.reuse.share(k, decision.scale, set.radiance, set.arriving.is_kept() ? &set.arriving : nullptr);
        set.count(worker.reuse.outcomes(), k);
        watch(k, decision);
    }
    const int offsets = set.size() * (set.size() - 1);
    set.offset_rays =
        static_cast<float>(worker.counters.offset_work() - rays) / static_cast<float>(std::max(offsets, 1));
}
/// share_light() where nobody wants to know of single paths.
void share_light(const Pass& pass, RouletteKind kind, Worker& worker);

} // namespace tessera
