#pragma once

#include "render/estimator/learned_reuse.h"
#include "render/estimator/reuse_roulette.h"
#include "render/film/counters.h"
#include "render/inspect/path_differentials.h"
#include "render/paths/shift_observer.h"
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

/// A vertex, for display.
struct DisplayVertex {
    glm::vec3 position;
    glm::vec3 normal;      ///< shading normal, unit
    std::string_view bsdf; ///< kind_name()
    float roughness;       ///< alpha of the roughest lobe that is no delta; 0: there is none
};

/// A light sample that contributes, on a surface or at a point light.
struct InspectedLight {
    glm::vec3 position;
    Footprint footprint{}; ///< as for InspectedVertex; area 0 for a light without extent
};

/// A vertex of a base path. Densities are those of BaseVertex; radiances are toward the previous vertex.
struct InspectedVertex : DisplayVertex {
    bool goes_on;      ///< to a next vertex or the environment; otherwise the next four members have no meaning
    bool escapes;      ///< to the environment
    glm::vec3 to_next; ///< unit, world space
    bool is_delta;
    float pdf_w;
    Rgb throughput;                      ///< product of f cos / (pdf survival) up to this vertex
    float survival;                      ///< survival probability of the roulette on path length
    Rgb sampled;                         ///< direct light by emitter sampling, with its MIS weight
    Rgb hit;                             ///< direct light by BSDF sampling, with its MIS weight
    std::optional<InspectedLight> light; ///< the light sample, if it contributes and is not at infinity
    Footprint footprint{};     ///< of one of the samples so far; area 0: unknown, or another pixel's path
    float footprint_width = 0; ///< scalar footprint: side of a square, scene units
};

/// One vertex of a shifted light path, with the numbers of the shift. Steps of the base path in its own pixel have
/// a Jacobian and a ratio of 1.
struct InspectedStep {
    DisplayVertex vertex;
    bool is_joined;        ///< a vertex of the base path beyond the reconnection
    OffsetStep shifted;    ///< the value of the last step includes the light
    Footprint footprint{}; ///< scalar footprint, a square
};

/// One base path shifted to another pixel. A base path carries several light paths; `ratio`, `jacobian`, `weight`
/// and `steps` are those of the one with the largest contribution.
struct InspectedShift {
    glm::ivec2 from, to;              ///< pixels; equal: the base path in its own pixel
    bool is_tried;                    ///< false: the path carries no light, or the roulette on reuse ended it
    ShiftOutcome outcome;             ///< has no meaning unless it was tried
    float ratio;                      ///< r_m, theory (6); 1 for the base path in its own pixel
    float jacobian;                   ///< |J|, the product over all steps; 0: no light was reached
    float weight;                     ///< g/R, theory (20), over the survival probability of the roulette on reuse
    Rgb value;                        ///< contribution to the pixel: sum of weight times c_m, radiance
    std::vector<glm::vec3> offset;    ///< y_1, y_2, ... of the offset path
    std::vector<glm::vec3> beyond;    ///< the base path from the reconnection vertex on; empty: it was not reached
    std::vector<InspectedStep> steps; ///< of one light path; only for shifts of the inspected pixel
    std::string_view ending;          ///< strategy that found the light; empty: no light was reached
};

/// A base path of a sampling set.
struct InspectedBase {
    std::vector<InspectedVertex> path; ///< x_1, x_2, ...; empty: the pixel sees nothing, or the sample is invalid
    Rgb radiance;                      ///< path-tracing estimate, without directly visible emission
    ReuseDecision reuse;
};

/// Path reuse in one sampling set. Vectors have one entry per pixel, except `shifts`.
struct InspectedSet {
    std::vector<glm::ivec2> pixels;
    std::vector<char> is_border;  ///< 1: the pixel is in the additional column or row beside the tile
    std::vector<Rgb> coefficient; ///< SamplingSet::coefficient(), summed over positions
    std::vector<InspectedBase> bases;
    std::vector<InspectedShift> shifts; ///< of base path k to pixel m: [k * pixels.size() + m]

    int size() const { return static_cast<int>(pixels.size()); }
    int index_of(glm::ivec2 pixel) const; ///< -1: the pixel is not in the set
    const InspectedBase& base(int k) const { return bases[k]; }
    const InspectedShift& shift(int k, int m) const { return shifts[k * size() + m]; }
    /// Returns the contributions of the first `count` base paths to pixel m.
    Rgb radiance(int m, int count) const;
    Rgb radiance(glm::ivec2 pixel) const { return radiance(index_of(pixel), size()); }
    /// Returns the shifts of all base paths to a pixel, including its own.
    std::vector<const InspectedShift*> to(glm::ivec2 pixel) const;
    /// Returns the shifts of a pixel's base path to all other pixels.
    std::vector<const InspectedShift*> from(glm::ivec2 pixel) const;
};

/// One sample of one pixel, reproduced.
struct Inspection {
    glm::ivec2 pixel, size;
    int pass;
    Method method;
    glm::vec2 lens;                    ///< CameraSample::lens
    std::vector<InspectedVertex> path; ///< x_1, x_2, ...; empty: the camera ray leaves the scene
    Rgb radiance;                      ///< of the pixel's own base path, without directly visible emission
    Rgb very_direct;
    bool is_invalid; ///< the film rejects the sample: radiance or a gradient is not finite
    /// Sets that contain the pixel: one for each gradient with G-PT, including those of the neighbours on the left
    /// and above; one for each base path in a pixel without reuse; otherwise one.
    std::vector<InspectedSet> sets;

    /// Returns the pixel's radiance: the mean over its sets, weighted by their numbers of pixels.
    Rgb shared_radiance() const;
};

/// All sampling sets of a tile in one pass, reproduced in the order of the pass.
struct TileInspection {
    PixelRect tile; ///< may reach beyond the image; one pixel with PT and G-PT
    int pass;
    RenderSettings settings;
    std::vector<InspectedSet> sets;

    /// Returns the number of base paths of all sets.
    int base_count() const;
};

/// Reproduces and inspects the sample of one pixel in a pass, with the code of render passes. Traces the pixel's
/// sampling sets only.
/// @param learned  state that this pass used
/// @param pass     index of the pass, from 0
Inspection inspect(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
                   const LearnedReuse& learned, int pass, glm::ivec2 pixel);

/// Reproduces all samples of the pixel's tile in a pass, as inspect() does for one pixel.
TileInspection inspect_tile(const Scene& scene, const Camera& camera, glm::ivec2 size,
                            const RenderSettings& settings, const LearnedReuse& learned, int pass,
                            glm::ivec2 pixel);

/// Reproduces the state of a pass bit for bit, as far as the sampling sets of one pixel depend on it. It is not
/// valid for other pixels. Traces again, on one thread: the base paths of earlier passes in the cells of
/// LearnedReuse on which the pixel's tiles depend, mostly one cell of 16 x 16 pixels; the pilot pass of G-PR, at
/// the cost of about one sample of path tracing for the whole picture; and all guiding paths, unless path guiding
/// is off.
/// @param pass  index of the pass, from 0
/// @param stop  ends it early; the result is then not valid
LearnedReuse replay_learning(const Scene& scene, const Camera& camera, glm::ivec2 size,
                             const RenderSettings& settings, int pass, glm::ivec2 pixel,
                             std::stop_token stop = {});

} // namespace tessera
