#pragma once

#include "render/method/pass.h"

#include <string_view>
#include <vector>

namespace tessera {

/// A vertex of a base path as one looks at it. Densities as in BaseVertex; radiances are toward the vertex before.
struct InspectedVertex {
    glm::vec3 position;
    std::string_view bsdf; ///< kind_name()
    float roughness;       ///< alpha of the roughest part that is no delta; 0: there is none
    bool goes_on;          ///< there is a next vertex, or the environment; the next four are meaningless otherwise
    bool escapes;          ///< toward the environment
    glm::vec3 to_next;     ///< unit, world
    bool is_delta;
    float pdf_w;
    float survival;                      ///< probability of the roulette on path length
    Rgb sampled;                         ///< direct light by emitter sampling, with its MIS weight
    Rgb hit;                             ///< direct light by BSDF sampling, with its MIS weight
    std::vector<glm::vec3> light_points; ///< on surfaces, those that bring light
};

/// One base path shifted to another pixel. A base path carries several light paths; `ratio` and `weight` are those
/// of the one that brings most.
struct InspectedShift {
    glm::ivec2 from, to; ///< pixels; equal: what the base path brings to its own pixel
    bool is_tried; ///< not where the path is dark or the roulette ended it: it brings only what is not shared
    ShiftOutcome outcome; ///< meaningless where it was not tried
    float ratio;          ///< r_m, no unit: density of the shifted path over the base's; 1 for the base itself
    float weight;         ///< 1/R, over the probability of survival
    Rgb value;            ///< what the pixel gets: sum over light paths of c_m times weight, radiance
    std::vector<glm::vec3> offset; ///< y_1, y_2, ... of the offset path, as far as it came
    std::vector<glm::vec3> beyond; ///< the base path from where they join it; empty: they did not get there
};

/// How the light of a sampling set was shared out, seen from one of its pixels, k.
struct InspectedSet {
    std::vector<glm::ivec2> pixels;
    float scale;                        ///< one over the probability that k's path is reused; 0: it is not
    std::vector<InspectedShift> from_k; ///< to each other pixel m
    std::vector<InspectedShift> to_k;   ///< from every pixel m, k itself among them
    Rgb radiance;                       ///< all that k gets
};

/// One sample of one pixel, done again.
struct Inspection {
    glm::ivec2 pixel, size;
    int pass;
    Method method;
    std::vector<InspectedVertex> path; ///< x_1, x_2, ...; empty: the camera ray leaves the scene
    Rgb radiance;                      ///< of the pixel's own base path, without very direct light
    Rgb very_direct;
    bool is_refused; ///< the path is not finite, and took no part
    /// Those that the pixel's values come from: one, but for G-PT, which has one a gradient (right, below).
    std::vector<InspectedSet> sets;
};

/// Takes the sample of a pass at one pixel again, with the passes' own code, and looks at it. Quick: no more than
/// the pixel's tile is traced.
/// @param plan  the one that this pass had
/// @param pass  counts from 0
Inspection inspect(const Scene& scene, const Camera& camera, glm::ivec2 size, const RenderSettings& settings,
                   const ReusePlan& plan, int pass, glm::ivec2 pixel);

} // namespace tessera
