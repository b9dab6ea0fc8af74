#pragma once

#include "render/paths/join_rule.h"
#include "render/paths/tracer.h"

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

/// A point on a light that emitter sampling draws at a vertex x_i. Every pdf is per solid angle at x_i.
struct LightSample {
    LightPoint light;
    glm::vec3 to_light; ///< unit, in the vertex's frame
    Rgb f_cos{0};
    float pdf_w = 0;       ///< of emitter sampling
    float fixed_pdf_w = 0; ///< LightRay::fixed_pdf_w
    float pdf_sum = 0;     ///< of emitter and BSDF sampling together, theory (3)
    /// Radiance toward x_{i-1} with its MIS weight, f cos Le / pdf_sum; black: no sample was drawn, or
    /// the light is occluded.
    Rgb brings{0};
};

/// A vertex x_i of a base path, and the step that BSDF sampling took from it. Every pdf is per solid angle at
/// x_i, or a probability after a delta scatter. The step is valid if the path has a next vertex or `escapes`.
struct BaseVertex {
    Vertex vertex;

    bool escapes = false; ///< the path leaves the scene here, and hits the environment
    glm::vec3 to_next;
    Rgb f_cos{0};
    float pdf_w = 0;
    float survival = 1; ///< probability that Russian roulette on path length continues; not part of pdf_w
    bool is_delta = false;
    Scatter scatter = Scatter::reflect;
    float next_geometry = 0; ///< |cos| at x_{i+1} over the squared distance: pdf per area over pdf_w

    float hit_pdf_w = 0;     ///< of emitter sampling for the emitter that is hit; 0: it cannot be sampled
    Rgb hit_contribution{0}; ///< radiance from that emitter times its MIS weight
    Rgb arriving{0};         ///< radiance from x_{i+1} by all longer light paths, with their MIS weights

    /// Returns the factor by which x_i scales radiance from beyond.
    Rgb throughput() const { return f_cos / (pdf_w * survival); }
};

/// A path from the camera and the light that it found. It carries two light paths for each vertex: one ends by
/// emitter sampling, the other by hitting an emitter.
struct BasePath {
    Rgb very_direct{0}; ///< directly visible emission, straight or in mirrors; includes `weight`
    Rgb direct{0};      ///< sum over the light paths of two edges, theory (4)
    Rgb indirect{0};    ///< sum over all longer light paths
    Rgb albedo{1};      ///< approximate, of x_1 or of the surface in mirrors; 1 if the path is empty
    Random random{0, 0, 0};
    float pixel_width = 0; ///< at x_1, across the view, scene units
    float pixel_angle = 0; ///< growth of that with distance, radians (PixelWidth)
    int mirrors = 0;       ///< number of mirrors that the path begins with
    float weight = 1;      ///< of the reconstruction filter at its camera ray (FilterSampler::Point)
    float own_width = 0;   ///< pixel width at the last vertex, scene units, or no_width (Tracer::width_beyond)

    /// Returns the radiance along the camera ray without directly visible emission. Times `weight`, it is an
    /// unbiased estimate for the pixel.
    Rgb radiance() const { return direct + indirect; }
    /// Sets the weight of a traced path, which has the weight 1.
    void set_weight(float new_weight) {
        weight = new_weight;
        very_direct *= new_weight;
    }

    /// Number of vertices; 0: the camera ray leaves the scene. Vertex 0 is x_1.
    int size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const BaseVertex& operator[](int i) const { return vertices_[i]; }
    BaseVertex& operator[](int i) { return vertices_[i]; }

    /// Returns the light sample of vertex i.
    const LightSample& light(int i) const { return lights_[i]; }
    LightSample& light(int i) { return lights_[i]; }

    /// Removes all vertices. The path then uses the random numbers `numbers`.
    void reset(const Random& numbers);
    /// Returns memory for one more vertex, which keep() adds to the path. Invalidates references to vertices.
    BaseVertex& spare();
    void keep() { ++size_; }
    /// Removes all vertices but x_1.
    void cut() {
        size_ = 1;
        mirrors = std::min(mirrors, 1);
    }

private:
    // Never shrink, so paths reuse the memory of earlier ones.
    std::vector<BaseVertex> vertices_;
    std::vector<LightSample> lights_;
    int size_ = 0;
};

/// Traces the base path of one sample, with the numbers of `random`. Its light paths have at most
/// tracer.settings.max_depth edges, as in Mitsuba.
void trace_base_path(const Tracer& tracer, const Ray& camera_ray, PixelWidth pixel_width, const Random& random,
                     BasePath& path);

/// Traces what a pixel sees from a position at which it only receives light: x_1, and directly visible emission,
/// which can be behind mirrors. The path carries no light paths.
void trace_first_vertex(const Tracer& tracer, const Ray& camera_ray, PixelWidth pixel_width, const Random& random,
                        BasePath& path);

/// Random replay: traces a path from x_1 of `seen` with the numbers of `random`. `seen` must not be empty.
/// @param last  light is sampled at x_1 to x_last
void replay_base_path(const Tracer& tracer, const BasePath& seen, const Random& random, int last, BasePath& path);

/// Draws the light sample of vertex x_index by emitter sampling, with its MIS weight and without visibility.
/// Returns false if it has no radiance. The radiance of the environment stays black until complete_light() looks
/// it up: the lookup is slow, and many of these samples are occluded.
/// @param way  segment that must be unoccluded
bool draw_light(const Tracer& tracer, const Vertex& x, const Random& random, int index, LightSample& drawn,
                Segment& way);

/// Looks up the radiance of a light sample on the environment.
inline void complete_light(const Tracer& tracer, LightSample& drawn) {
    if (drawn.light.kind != LightPoint::Kind::environment)
        return;
    tracer.scene.lights().complete(drawn.light);
    drawn.brings = drawn.f_cos * drawn.light.radiance / drawn.pdf_sum;
}

/// The light paths of a base path as slots, in the order of their ends, with c_k of each, theory (4). Every
/// vertex has a slot for its light sample and a slot for the emitter that BSDF sampling hits. All light paths
/// that continue beyond the join have the same r_m and c_m / c_k, so they are one slot, the tail, whose suffix is
/// summed once. Vertex 0 is x_1.
class LightPaths {
public:
    /// Lists the light paths of `path`; keeps no reference to it.
    void reset(const BasePath& path, const ShiftSettings& settings);

    /// Returns the slot of the light path that ends at the light sample of a vertex.
    static int emitter_slot(int vertex) { return 2 * vertex; }
    /// Returns the slot of the light path that BSDF sampling at a vertex ends at an emitter.
    static int hit_slot(int vertex) { return 2 * vertex + 1; }
    static int vertex_of(int slot) { return slot / 2; }   ///< not for the tail
    int tail_slot() const { return hit_slot(join_) + 1; } ///< of all light paths beyond; requires has_join()

    /// Returns the vertex at which offset paths join the base path: the first j >= 1 such that the step from j-1
    /// joins, theory (18), and the scatter at j is no delta. 0: there is none.
    int join() const { return join_; }
    bool has_join() const { return join_ > 0; }

    /// Returns the first slot that is shifted. The radiance of slots before stays at the base's pixel.
    int first_shared() const { return first_shared_; }
    int slot_count() const { return static_cast<int>(carried_.size()); }

    /// Returns c_k of a slot, theory (4), divided by the survival of roulette on path length: radiance.
    Rgb carried(int slot) const { return carried_[slot]; }
    /// Returns whether a slot, or any of the slots [first, end), carries light.
    bool is_alive(int slot) const { return slot <= last_alive_ && !is_black(carried(slot)); }
    bool is_alive(int first, int end) const {
        while (first < end && !is_alive(first))
            ++first;
        return first < end;
    }
    /// Returns the last slot that carries light; -1: none does.
    int last_alive() const { return last_alive_; }

    /// Returns whether the step from a vertex is connectable, theory (17): offsets connect to its end for the
    /// light that this emits. The step must exist, perhaps to infinity.
    bool step_is_connectable(int vertex) const { return steps_[vertex].is_connectable; }
    /// Returns whether the step joins, theory (18): light from beyond its end uses the connection, too, unless
    /// it arrives there by a delta scatter.
    bool step_joins(int vertex) const { return steps_[vertex].joins; }
    /// Returns s_i of a vertex, theory (16), in scene units.
    float apart(int vertex) const { return steps_[vertex].apart; }

private:
    struct Step {
        float apart;
        bool is_connectable = false, joins = false;
    };
    Step step_from(const BasePath& path, const JoinRule& rule, int vertex, float apart) const;

    std::vector<Rgb> carried_;
    std::vector<Step> steps_; ///< by vertex; the last vertex may have no step
    int join_ = 0;
    int first_shared_ = 0;
    int last_alive_ = -1;
};

} // namespace tessera
