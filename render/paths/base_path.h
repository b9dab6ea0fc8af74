#pragma once

#include "render/paths/join_rule.h"
#include "render/paths/tracer.h"

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// A point on a light, drawn by emitter sampling at a vertex x_i. Every pdf is per solid angle at x_i.
struct LightSample {
    LightPoint light;
    glm::vec3 to_light; ///< unit, in the vertex's frame
    Rgb f_cos{0};
    float pdf_w = 0;   ///< of emitter sampling
    float pdf_sum = 0; ///< of all strategies that could have found this light together
    /// Radiance toward x_{i-1}, with its MIS weight: f cos Le / pdf_sum; black: nothing was sampled, or the way is
    /// blocked.
    Rgb brings{0};
};

/// A vertex x_i of a base path with what BSDF sampling found from it. Every pdf is per solid angle at x_i, or a
/// probability after a delta scatter. Valid when the path has a next vertex, or leaves the scene here.
struct BaseVertex {
    Vertex vertex;

    bool escapes = false; ///< it leaves the scene toward an environment: its light counts as a hit
    glm::vec3 to_next;
    Rgb f_cos{0};
    float pdf_w = 0;
    float survival = 1; ///< probability of the roulette on path length that the path went on; not part of pdf_w
    bool is_delta = false;
    Scatter scatter = Scatter::reflect;
    float next_geometry = 0; ///< |cos| at x_{i+1} over the squared distance: what turns pdf_w into pdf_a

    float hit_pdf_w = 0; ///< of emitter sampling at the emitter met: x_{i+1}, or infinity; 0: cannot be sampled
    Rgb hit_brings{0};   ///< radiance from that emitter, with its MIS weight
    Rgb arriving{0};     ///< radiance from x_{i+1} by all longer light paths, with their MIS weights

    /// What light from beyond is multiplied by on its way through x_i.
    Rgb throughput() const { return f_cos / (pdf_w * survival); }
};

/// A path from the camera and the light it found. One vertex list carries many light paths: for each vertex one
/// that ends by emitter sampling and one that ends by hitting an emitter.
struct BasePath {
    Rgb very_direct{0}; ///< emission seen by the camera itself, straight or in mirrors
    Rgb direct{0};      ///< sum over its light paths of two edges
    Rgb indirect{0};    ///< sum over all longer ones
    Rgb albedo{1};      ///< of x_1, about (Bsdf::albedo), or of what mirrors show there; 1 where it sees nothing
    Random random{0, 0, 0};
    float pixel_width = 0; ///< at x_1, across the view: scene units
    float pixel_angle = 0; ///< what that grows by with distance from the camera (PixelWidth)
    int mirrors = 0;       ///< so many of x_1, x_2, ... are mirrors, before any other
    float own_width = 0;   ///< of its pixel at the last vertex so far, as Tracer::width_beyond() has it

    /// Without very direct light: an unbiased estimate for the pixel.
    Rgb radiance() const { return direct + indirect; }

    /// x_1, x_2, ...; none: the camera ray left the scene. Vertex 0 is x_1.
    int size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const BaseVertex& operator[](int i) const { return vertices_[i]; }
    BaseVertex& operator[](int i) { return vertices_[i]; }

    /// The light sample of vertex i.
    const LightSample& light(int i) const { return lights_[i]; }
    LightSample& light(int i) { return lights_[i]; }

    /// Starts anew, without vertices, with random numbers for all that follows.
    void reset(const Random& numbers);
    /// Room for one more vertex, which counts only once keep() is called. Old references end here.
    BaseVertex& spare();
    void keep() { ++size_; }
    /// Leaves x_1 alone.
    void cut() {
        size_ = 1;
        mirrors = std::min(mirrors, 1);
    }

private:
    // Never shrink: paths are traced into the memory of earlier ones.
    std::vector<BaseVertex> vertices_;
    std::vector<LightSample> lights_;
    int size_ = 0;
};

/// Traces the path of one sample, with the numbers of `random`. Light paths have tracer.settings.max_depth edges
/// at most, as in Mitsuba.
/// @param pixel_width  of the camera ray's picture
void trace_base_path(const Tracer& tracer, const Ray& camera_ray, PixelWidth pixel_width, const Random& random,
                     BasePath& path);

/// What a pixel sees from one more position, from where it only receives light: x_1, and very direct light, which
/// takes mirrors. It carries no light paths.
void trace_first_vertex(const Tracer& tracer, const Ray& camera_ray, PixelWidth pixel_width, const Random& random,
                        BasePath& path);

/// Traces the path that takes the numbers of `random` from x_1 of another path, which sees something: random
/// replay.
/// @param last  light is looked for at x_1 to x_last
void replay_base_path(const Tracer& tracer, const BasePath& seen, const Random& random, int last, BasePath& path);

/// Draws the light sample of vertex x_index by emitter sampling, weighted against BSDF sampling, without
/// visibility. Returns false if it brings no light. The radiance of the environment stays black until
/// complete_light() looks it up: the lookup is slow, and many of these samples are occluded.
/// @param way  segment that must be unoccluded
bool draw_light(const Tracer& tracer, const Vertex& x, const Random& random, int index, LightSample& drawn,
                Segment& way);

inline void complete_light(const Tracer& tracer, LightSample& drawn) {
    if (drawn.light.kind != LightPoint::Kind::environment)
        return;
    tracer.scene.lights().complete(drawn.light);
    drawn.brings = drawn.f_cos * drawn.light.radiance / drawn.pdf_sum;
}

/// The light paths that a base path carries, as slots in the order of their ends, and what each brings: for every
/// vertex one for its light sample, and one for the emitter that BSDF sampling hits. Where shifts join
/// base and offset, all light paths through the same vertices beyond the join share their ratios of value and of
/// density, so they are one slot, the tail: the suffix is summed once. Vertices count from 0 here: vertex 0 is
/// x_1.
class LightPaths {
public:
    /// Lists the light paths of `path`; keeps no reference to it.
    void reset(const BasePath& path, const ShiftSettings& settings);

    /// Slot of the light path that ends at the light sample of the vertex.
    static int emitter_slot(int vertex) { return 2 * vertex; }
    /// Slot of the light path whose BSDF sample at the vertex hits an emitter.
    static int hit_slot(int vertex) { return 2 * vertex + 1; }
    static int vertex_of(int slot) { return slot / 2; }   ///< not for the tail
    int tail_slot() const { return hit_slot(join_) + 1; } ///< ends further on; only where has_join()

    /// The vertex at which offsets join the base path: the first j >= 1 that the step from j-1 joins, and that is
    /// not left by a delta scatter.
    int join() const { return join_; }
    bool has_join() const { return join_ > 0; }

    /// Slots before this one are not shifted: their light stays where it is.
    int first_shared() const { return first_shared_; }
    int slot_count() const { return static_cast<int>(carried_.size()); }

    /// What the slot brings to the base's own pixel: f / (sum of pdfs, times survival), radiance: c_k.
    Rgb carried(int slot) const { return carried_[slot]; }
    bool is_alive(int slot) const { return slot <= last_alive_ && !is_black(carried(slot)); }
    bool is_alive(int first, int end) const {
        while (first < end && !is_alive(first))
            ++first;
        return first < end;
    }
    /// The last slot that carries light; -1: none does.
    int last_alive() const { return last_alive_; }

    /// Whether offsets are joined to what the step from the vertex onward meets (there is one, perhaps to
    /// infinity), for the light that it gives.
    bool step_is_connectable(int vertex) const { return steps_[vertex].is_connectable; }
    /// Whether that holds for light from beyond the next vertex, too, unless it gets there by a delta scatter.
    bool step_joins(int vertex) const { return steps_[vertex].joins; }
    /// How far apart the vertex lies for other pixels (JoinRule).
    float apart(int vertex) const { return steps_[vertex].apart; }

private:
    struct Step {
        float apart;
        bool is_connectable = false, joins = false;
    };
    Step step_from(const BasePath& path, const JoinRule& rule, int vertex, float apart) const;

    std::vector<Rgb> carried_;
    std::vector<Step> steps_; ///< one a vertex, the last one perhaps without a step
    int join_ = 0;
    int first_shared_ = 0;
    int last_alive_ = -1;
};

} // namespace tessera
