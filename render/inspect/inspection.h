#pragma once

#include "render/estimator/learned_reuse.h"
#include "render/estimator/reuse_roulette.h"
#include "render/paths/shift_onlooker.h"
#include "render/film/counters.h"
#include "render/inspect/path_differentials.h"
#include "render/settings/settings.h"

#include <optional>
#include <stop_token>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tessera {

class Scene;
struct Camera;

/// A vertex as one looks at it.
struct SeenVertex {
    glm::vec3 position;
    glm::vec3 normal;      ///< unit, of shading
    std::string_view bsdf; ///< kind_name()
    float roughness;       ///< alpha of the roughest part that is no delta; 0: there is none
};

/// A light sample that brings light, on a surface or a point.
struct InspectedLight {
    glm::vec3 position;
    Footprint footprint{}; ///< as InspectedVertex has it; a point: a light without extent
};

/// A vertex of a base path as one looks at it. Densities as in BaseVertex; radiances are toward the vertex before.
struct InspectedVertex : SeenVertex {
    bool goes_on;      ///< there is a next vertex, or the environment; the next four are meaningless otherwise
    bool escapes;      ///< toward the environment
    glm::vec3 to_next; ///< unit, world
    bool is_delta;
    float pdf_w;
    Rgb throughput;                      ///< of the path through this vertex: product of f cos / (pdf survival)
    float survival;                      ///< probability of the roulette on path length
    Rgb sampled;                         ///< direct light by emitter sampling, with its MIS weight
    Rgb hit;                             ///< direct light by BSDF sampling, with its MIS weight
    std::optional<InspectedLight> light; ///< the light sample, if it brings light and is not at infinity
    /// What the path stands for there, as one of the samples so far; a point: not known, or none of this pixel's
    /// own.
    Footprint footprint{};
    float footprint_width = 0; ///< about the same by the scalar form: side of a square, units of the scene
};

/// One vertex of a light path that was shifted, in the numbers that the shift calculated with. The base path's own
/// have a Jacobian and a ratio of 1.
struct InspectedStep {
    SeenVertex vertex;
    bool is_joined; ///< it is the base path's own vertex, seen from the offset
    /// Jacobian, pdf_w, ratio and value so far; the last one's with the light that the path ends at.
    OffsetStep shifted;
    /// What it stands for there, as InspectedVertex has it, by the scalar form: a square.
    Footprint footprint{};
};

/// One base path shifted to another pixel. A base path carries several light paths; `ratio`, `jacobian`, `weight`
/// and `steps` are those of the one that brings most.
struct InspectedShift {
    glm::ivec2 from, to; ///< pixels; equal: what the base path brings to its own pixel
    bool is_tried; ///< not where the path is dark or the roulette ended it: it brings only what is not shared
    ShiftOutcome outcome; ///< meaningless where it was not tried
    float ratio; ///< r_m, no unit: density of the shifted path with its Jacobian over the base's; 1 for the base
    float jacobian;                   ///< |J| of that: the product of all steps'; 0: it came to no end
    float weight;                     ///< 1/R, over the probability of survival
    Rgb value;                        ///< what the pixel gets: sum over light paths of c_m times weight, radiance
    std::vector<glm::vec3> offset;    ///< y_1, y_2, ... of the offset path, as far as it came
    std::vector<glm::vec3> beyond;    ///< the base path from where they join it; empty: they did not get there
    std::vector<InspectedStep> steps; ///< of one light path, at the inspected pixel only
    std::string_view ending;          ///< how that finds its light; empty: it came to no end
};

/// A base path of a sampling set.
struct InspectedBase {
    std::vector<InspectedVertex> path; ///< x_1, x_2, ...; empty: nothing is seen, or it is refused
    Rgb radiance;                      ///< what it brings if nobody shares; without very direct light
    ReuseDecision reuse;
};

/// How the light of a sampling set was shared out. Lists have one entry a pixel.
struct InspectedSet {
    std::vector<glm::ivec2> pixels;
    std::vector<char> is_border;  ///< 1: the pixel is not of the tile that the set is of, but beside it
    std::vector<Rgb> coefficient; ///< what the pixel gets, over albedos (SamplingSet::coefficient)
    std::vector<InspectedBase> bases;
    std::vector<InspectedShift> shifts; ///< of base k to pixel m: [k * pixels.size() + m]; k = m: its own

    int size() const { return static_cast<int>(pixels.size()); }
    int index_of(glm::ivec2 pixel) const; ///< -1: it is not in the set
    const InspectedBase& base(int k) const { return bases[k]; }
    const InspectedShift& shift(int k, int m) const { return shifts[k * size() + m]; }
    /// All that a pixel gets from the first `bases` base paths.
    Rgb radiance(int m, int bases) const;
    Rgb radiance(glm::ivec2 pixel) const { return radiance(index_of(pixel), size()); }
    /// The shifts of every base path to a pixel, its own among them.
    std::vector<const InspectedShift*> to(glm::ivec2 pixel) const;
    /// The shifts of a pixel's base path to all other pixels.
    std::vector<const InspectedShift*> from(glm::ivec2 pixel) const;
};

/// One sample of one pixel, done again.
struct Inspection {
    glm::ivec2 pixel, size;
    int pass;
    Method method;
    glm::vec2 lens;                    ///< where camera rays go through it, in radii from its middle
    std::vector<InspectedVertex> path; ///< x_1, x_2, ...; empty: the camera ray leaves the scene
    Rgb radiance;                      ///< of the pixel's own base path, without very direct light
    Rgb very_direct;
    bool is_refused; ///< a path, or what the pixel and its neighbours got, is not finite: it was left out
    /// The sets that the pixel's values come from: one, but for G-PT, which has one a gradient, those of the
    /// neighbours above and on the left among them; and where the pixel shares nothing, one for each of the paths
    /// whose mean it takes.
    std::vector<InspectedSet> sets;

    /// What the pixel gets from its sets: their mean, by their pixels.
    Rgb shared_radiance() const;
};

/// All sampling sets of a tile in one pass, done again, in the order in which the pass takes them.
struct TileInspection {
    PixelRect tile; ///< may reach beyond the image; of PT and G-PT the pixel alone
    int pass;
    RenderSettings settings;
    std::vector<InspectedSet> sets;

    /// Base paths of all sets together.
    int base_count() const;
};

/// Takes the sample of a pass at one pixel again, with the passes' own code, and looks at it. Quick: no more than
/// the pixel's tile and those that take it into their sets are traced.
/// @param learned  the one that this pass had
/// @param pass  counts from 0
Inspection inspect(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
                   const LearnedReuse& learned, int pass, glm::ivec2 pixel);

/// Takes all samples of the pixel's tile in a pass again, as inspect() does for one pixel.
TileInspection inspect_tile(const Scene& scene, const Camera& camera, glm::ivec2 size,
                            const RenderSettings& settings, const LearnedReuse& learned, int pass,
                            glm::ivec2 pixel);

/// LearnedReuse that a pass of a render had, as far as the sets of one pixel go: bit for bit, and good for no
/// other pixel. It is learnt again from the base paths of the passes before, of the few pixels that decide on
/// these tiles; this costs as much as path tracing some 16 x 16 pixels as often, or where tiles lie between
/// several cells of LearnedReuse, a few times that; and of G-PR as a sample of path tracing of the whole picture,
/// on one thread; and unless path guiding is off, as the paths that guides were learnt from.
/// @param pass  counts from 0
/// @param stop  ends it early: it has then learnt less, and is good for nothing
LearnedReuse replay_learning(const Scene& scene, const Camera& camera, glm::ivec2 size,
                             const RenderSettings& settings, int pass, glm::ivec2 pixel,
                             std::stop_token stop = {});

} // namespace tessera
