#pragma once

#include "render/estimator/base_path.h"
#include "render/estimator/half_vector.h"
#include "render/estimator/offsets.h"
#include "render/estimator/tracer.h"

#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace tessera {

/// A vertex as one looks at it.
struct SeenVertex {
    glm::vec3 position;
    glm::vec3 normal;      ///< unit, of shading
    std::string_view bsdf; ///< kind_name()
    float roughness;       ///< alpha of the roughest part that is no delta; 0: there is none

    SeenVertex(const Vertex& v)
        : position(v.position), normal(v.frame.normal), bsdf(kind_name(v.bsdf)), roughness(v.bsdf.roughness()) {}
};

/// One scattering of an offset path, in the numbers that the shift calculates with.
struct OffsetStep {
    int vertex = 0;  ///< where: 0 is y_1
    float pdf_w = 0; ///< of the way on: per solid angle, or a probability after a delta scatter; at the end of a
                     ///< light path that of all strategies together
    bool is_delta = false;
    float jacobian = 1; ///< solid angle at the offset over solid angle at the base
    float ratio = 0;    ///< so far: density of the offset, with all Jacobians, over that of the base; no unit
    Rgb value{0};       ///< so far: f of the offset with all Jacobians over the base's pdf; at the end of a light
                        ///< path with its light, radiance
};

/// What a shift did to all offset paths, for who wants to look: one a pixel of the sampling set.
class OffsetTrace {
public:
    /// How a light path, a slot of LightPaths, ended in the offset, whatever visibility made of it then.
    struct End {
        bool is_there = false;
        bool joins = false; ///< it goes through `join` to the base's own vertex, where `last` is
        OffsetStep join;
        OffsetStep last;
    };
    struct Path {
        std::vector<SeenVertex> vertices; ///< y_1, y_2, ...
        std::vector<OffsetStep> bounces;  ///< at y_1, y_2, ..., those that led to another vertex
        std::vector<End> ends;            ///< one a slot
    };

    void reset(int offsets, int slots) {
        paths_.resize(static_cast<std::size_t>(offsets));
        for (Path& path : paths_) {
            path.vertices.clear();
            path.bounces.clear();
            path.ends.assign(static_cast<std::size_t>(slots), {});
        }
    }
    void add(int m, const Vertex& y) { at(m).vertices.emplace_back(y); }
    void bounce(int m, const OffsetStep& step) { at(m).bounces.push_back(step); }
    /// A light path ends at a light as the offset sees it, ...
    void end(int m, int slot, const OffsetStep& last) { end_at(m, slot) = {true, false, {}, last}; }
    /// ... or beyond the vertex of the base path that it joins.
    void end_beyond(int m, int slot, const OffsetStep& join, const OffsetStep& last) {
        end_at(m, slot) = {true, true, join, last};
    }

    const Path& operator[](int m) const { return paths_[static_cast<std::size_t>(m)]; }

private:
    Path& at(int m) { return paths_[static_cast<std::size_t>(m)]; }
    End& end_at(int m, int slot) { return at(m).ends[static_cast<std::size_t>(slot)]; }

    std::vector<Path> paths_;
};

/// What the pixels of a sampling set see, x_1 of each.
struct PrimaryVertices : OffsetVertices {
    FloatLanes pixel_width; ///< BasePath::pixel_width

    /// Keeps a reference to the path, which sees something.
    void set_pixel(int lane, const BasePath& path) {
        set(lane, path[0].vertex);
        pixel_width[lane] = path.pixel_width;
    }
};

/// How a shift went, a lane a pixel.
using OutcomeLanes = LaneArray<ShiftOutcome>;

/// Shifts all light paths of a base path to other pixels at once, lane by lane, by the kind of shift in
/// `settings`, but for random replay all the way (PathReuse): until base and offset can be connected, half vectors
/// are copied [Bauszat 2017, 3.1] or random numbers replayed [Hua 2019, 3.1]. The base path alone decides on every
/// branch, so all lanes do the same arithmetic.
class Shift {
public:
    Shift(const Tracer& tracer, const ShiftSettings& settings) : tracer_(tracer), settings_(settings) {}

    /// @param primary  what the pixels see; a lane without a vertex is not shifted to
    /// @param self     the lane of the base's own pixel, which is left alone; -1: none
    /// @param paths    receives densities and values, all failed before
    /// @param edges    receives the new edges, unchecked
    /// @param outcomes receives ok, or why the first light path that failed did so
    void run(const BasePath& base, const LightPaths& light, const PrimaryVertices& primary, int self,
             OffsetPaths& paths, PendingEdges& edges, OutcomeLanes& outcomes);

    /// From now on all is noted in `trace`, which starts anew before each run(); null: no longer.
    void record(OffsetTrace* trace) { trace_ = trace; }

private:
    /// What the way from the camera to the offset vertices has cost: products of ratios, each of them a single
    /// number (never products of densities, which underflow).
    struct Prefix {
        FloatLanes density; ///< pdf of the offset with its Jacobians over the base's
        Vec3Lanes value;    ///< f of the offset with its Jacobians over the base's pdf
    };

    const BaseVertex& base(int i) const { return (*base_)[i]; }
    /// Whether emitter sampling at x_{i+1} goes the way y_i -> x_{i+1}, where that step is connectable.
    bool joins_lights(int i) const { return is_connectable(base(i + 1).vertex) && light_->step_is_long(i); }
    bool is_as_long(int i, int m, glm::vec3 from, const Vertex& next) const;
    bool replays() const { return settings_.shift == ShiftKind::replay_reconnection; }
    bool is_connectable(const Vertex& x) const { return tessera::is_connectable(x, settings_.shift_threshold); }

    bool start(const PrimaryVertices& primary, int self);
    void walk();
    void ask_for_kind(bool connectable);
    void note_others(const LaneMask& asked, const LaneMask& arrived, ShiftOutcome outcome);
    void note(int m, ShiftOutcome outcome);

    // Lights of x_i.
    void shift_lights(int i);
    void connect_light(int i, int sample);
    void bounce_to_light(int i, int sample, int m);
    void replay_light(int i, int sample, int m, EdgeGroup& edges);
    void end_at_light(int slot, int m, const CopiedScatter& s, glm::vec3 origin, const LightPoint& light,
                      float base_pdf_sum, bool is_delta);

    // What lies beyond x_i.
    void escape(int i);
    void connect_infinity(int i);
    void connect_vertex(int i);
    void set_hits(int i, const LaneMask& arrived);
    void connect_beyond(int next, const LaneMask& arrived);
    bool bounce(int i);
    bool bounce(int i, int m);
    std::optional<CopiedScatter> copy_scatter(int i, int m);
    std::optional<CopiedScatter> replay_scatter(int i, int m);

    // For the onlooker: only where there is a trace.
    void trace_end(int slot, int m, float pdf_w, float jacobian, bool is_delta = false);
    void trace_join(int i);
    void trace_beyond(int slot, const LaneMask& arrived, float bsdf_share, float other_pdf_w);

    Tracer tracer_;
    ShiftSettings settings_;

    // The base path at hand.
    const BasePath* base_ = nullptr;
    const LightPaths* light_ = nullptr;
    OffsetPaths* paths_ = nullptr;
    PendingEdges* edges_ = nullptr;
    OutcomeLanes* outcomes_ = nullptr;
    OffsetTrace* trace_ = nullptr;
    std::vector<OffsetStep> traced_joins_; ///< of the connection at hand

    // The offsets.
    const PrimaryVertices* primary_ = nullptr; ///< y_1
    const OffsetVertices* y_ = nullptr;        ///< y_i
    LaneMask active_;                          ///< those that go on
    Prefix prefix_;
    OffsetVertices moved_; ///< y_i beyond the first bounce
    std::vector<Vertex> moved_vertices_;

    // Of the connection at hand.
    LaneMask asked_;
    ConnectionLanes seen_;
    LaneMask reached_; ///< those joined to x_{i+1} by a long edge
    LightLanes arriving_;
    BsdfLanes bsdf_;
    Prefix joined_;
    Vec3Lanes to_previous_; ///< from x_{i+1} to y_i, in its frame
};

} // namespace tessera
