#pragma once

#include "render/paths/base_path.h"
#include "render/paths/offsets.h"
#include "render/paths/shift_observer.h"
#include "render/paths/tracer.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace tessera {

/// A scatter of a base path, repeated at an offset vertex.
struct CopiedScatter {
    glm::vec3 to_next; ///< unit, in the offset vertex's frame
    Rgb f_cos;
    float pdf_w;    ///< per solid angle, or a probability after a delta scatter
    float jacobian; ///< |J|, solid angle at the offset over solid angle at the base; 1 after a delta scatter
};

/// Copies the half vector of a reflection or refraction from base to offset [Kettunen 2015, 5.2], with the
/// Jacobian of theory (15). Each vertex has its own index of refraction. Returns nothing if the offset has no
/// such direction on the same side as the base, or scatters no light there.
/// @param base_to_next  unit, in the base vertex's frame; on the other side than to_previous for a refraction
std::optional<CopiedScatter> copy_half_vector(const Vertex& base, glm::vec3 base_to_next, const Vertex& offset);

/// Repeats a delta scatter at the offset, with |J| = 1. Returns nothing if the offset's BSDF has no such part, or
/// in total internal reflection.
std::optional<CopiedScatter> copy_delta(Scatter scatter, const Vertex& offset);

/// Vertices y_1, one for each pixel of a sampling set.
class PrimaryVertices : public OffsetVertices {
public:
    FloatLanes pixel_width; ///< BasePath::pixel_width

    /// Starts another set.
    void reset(int count) {
        OffsetVertices::reset(count);
        ++set_;
    }
    /// Sets the vertex of a lane to x_1 of a path that is not empty. Keeps a reference to it.
    void set_pixel(int lane, const BasePath& path) {
        set(lane, path[0].vertex);
        pixel_width[lane] = path.pixel_width;
    }

    /// Returns the vertex beyond y_1 in the direction of a delta scatter; null: none. It is the same for all base
    /// paths of the set, so only the first call traces it, with trace(vertex), which returns false if there is
    /// none. The vertex is valid until the next reset().
    template <class Trace>
    const Vertex* beyond(int lane, Scatter scatter, glm::vec3 direction, Trace&& trace) {
        if (beyond_.size() < 2 * static_cast<std::size_t>(count())) // no vertex of this set is in use yet
            beyond_.resize(2 * static_cast<std::size_t>(count()));
        Beyond& b = beyond_[2 * lane + (scatter == Scatter::transmit ? 1 : 0)];
        if (b.set != set_ || b.direction != direction) {
            b.set = set_;
            b.direction = direction;
            b.is_met = trace(b.vertex);
        }
        return b.is_met ? &b.vertex : nullptr;
    }

private:
    struct Beyond {
        std::uint64_t set = 0; ///< the set for which the members are valid; 0: none
        glm::vec3 direction;   ///< unit, world
        bool is_met;
        Vertex vertex;
    };

    std::vector<Beyond> beyond_; ///< two for each lane, reflected and transmitted; never shrinks
    std::uint64_t set_ = 0;
};

/// Outcomes of a shift, one lane for each pixel.
using OutcomeLanes = LaneArray<ShiftOutcome>;

/// Factors of r_m and c_m from the vertices up to the current one, theory (6) and (7). They are products of
/// quotients, as products of densities would underflow.
struct PrefixLanes {
    FloatLanes ratio; ///< pdf of the offset times |J| over the pdf of the base, no unit
    Vec3Lanes value;  ///< f of the offset times |J| over pdf and survival of the base
};

/// Connections from offset vertices y_i to the base's next vertex, x_{i+1}.
struct VertexConnection {
    int vertex;            ///< i; 0 is y_1
    LaneMask eligible;     ///< active offsets that decide on this step as the base does
    ConnectionLanes sight; ///< of x_{i+1} from y_i
    BsdfLanes bsdf;        ///< at y_i, toward x_{i+1}
    LaneMask lit;          ///< eligible offsets that can receive light along the edge
    LaneMask reached;      ///< lit offsets whose edge also joins, theory (18)
    PrefixLanes prefix;    ///< through the edge, by BSDF sampling alone; ratio 0 unless reached
    Vec3Lanes to_previous; ///< unit, from x_{i+1} to y_i, in the frame of x_{i+1}
};

/// Connections from offset vertices y_i to a point on a light, or to a direction at infinity.
struct LightConnection {
    LaneMask eligible; ///< active offsets that decide on this step as the base does
    ConnectionLanes sight;
    LightLanes arriving;
    BsdfLanes bsdf; ///< at y_i, toward the light
};

/// Shifts all light paths x of a base path to the other pixels of its set, theory (5), and computes r_m and c_m,
/// theory (6) and (7). It walks along the base path: as long as an offset path cannot join it, the offset copies
/// half vectors [Bauszat 2017, 3.1] or replays random numbers [Hua 2019, 3.1]. PathReuse does random replay of
/// whole paths. The base path alone decides on every branch, so all lanes do the same arithmetic. The index i of
/// x_i and y_i counts from 0 in this class: i = 0 is x_1 of docs/theory.md.
///
/// shift.cpp has the walk, shift_connections.cpp the connections of offsets to vertices and lights of the base
/// path, and shift_bounces.cpp repeated scatters, whose rays are traced.
class Shift {
public:
    Shift(const Tracer& tracer, const ShiftSettings& settings)
        : tracer_(tracer), settings_(settings), rule_(settings, 0) {}

    /// Shifts a base path to all pixels of `primary`.
    /// @param light     light paths of `base`
    /// @param primary   y_1 of all pixels; lanes without a vertex are not shifted to. Stores vertices beyond
    ///                  delta scatters.
    /// @param self      lane of the base's own pixel, which is left out; -1: none
    /// @param paths     receives r_m and c_m; all shifts must have failed before
    /// @param edges     receives the new edges, which the caller must resolve
    /// @param outcomes  receives ok, or the reason of the first light path that failed
    void run(const BasePath& base, const LightPaths& light, PrimaryVertices& primary, int self, OffsetPaths& paths,
             PendingEdges& edges, OutcomeLanes& outcomes);

    /// Sets the observer of the next runs; null: none.
    void set_observer(ShiftObserver* observer) { observer_ = observer; }

private:
    const BaseVertex& base(int i) const { return (*base_)[i]; }
    bool replays() const { return settings_.shift == ShiftKind::replay_reconnection; }
    /// Returns whether the base connects x_i to its light sample, theory (17).
    bool light_is_connectable(int i) const;
    /// Returns whether the step of the offset path of lane m from y_i, over an edge of this length, is
    /// connectable, theory (17): its lobe is wider than the angle by which the edge turns.
    bool is_connectable(int m, float distance) const {
        return rule_.covers(y_->roughness[m], rule_.turn(apart_[m], distance));
    }

    // Walk (shift.cpp).
    bool start(int self);
    void walk();
    void shift_light(int i);
    void escape(int i);
    void select_lobes(LaneMask& eligible);
    void keep_alike(bool connectable, LaneMask& eligible, ConnectionLanes& sight);
    void record_failures(const LaneMask& eligible, const LaneMask& arrived, ShiftOutcome outcome);
    void fail(int m, ShiftOutcome outcome);

    // Connections (shift_connections.cpp).
    void record_first_scatter(int i, int first_slot, int end_slot, const Vec3Lanes& direction,
                              const BsdfLanes& bsdf);
    void connect_light(int i, bool connectable);
    void connect_infinity(int i);
    void connect_next(int i);
    const VertexConnection& connect_vertex(int i, EdgeGroup& edges);
    void shift_hit(const VertexConnection& connection);
    void shift_light_beyond(const VertexConnection& connection);
    void shift_tail(const VertexConnection& connection);

    // Bounces (shift_bounces.cpp).
    bool bounce(int i);
    bool bounce(int i, int m);
    const Vertex* meet(int i, int m, glm::vec3 direction);
    void bounce_to_light(int i, int m);
    void bounce_out(int i, int m);
    void begin_first_scatter(int i, int first_slot, int end_slot);
    void record_bounce(int m, const CopiedScatter& s, bool is_delta);
    void replay_light(int i, int m, EdgeGroup& edges);
    void end_at_light(int slot, int m, const CopiedScatter& s, glm::vec3 origin, const LightPoint& light,
                      float base_pdf_sum, bool is_delta);
    bool is_joined_alike(int i, int m, float distance, const Vertex& next) const;
    bool may_agree(int i, int m) const;
    std::optional<CopiedScatter> copy_scatter(int i, int m);
    std::optional<CopiedScatter> replay_scatter(int i, int m);

    /// Calls tell(m) for the lanes of a mask, if there is an observer.
    template <class Tell>
    void notify(const LaneMask& lanes, Tell&& tell) const {
        for (int m = 0; observer_ && m < y_->count(); ++m)
            if (lanes[m])
                tell(m);
    }
    /// Returns the last step of a slot's light path in lane m, for the observer.
    OffsetStep last_step(int slot, int m, float pdf_w, float jacobian, bool is_delta = false) const {
        return {light_->vertex_of(slot), pdf_w, is_delta, jacobian, paths_->ratio(slot, m),
                paths_->value(slot, m)};
    }

    Tracer tracer_;
    ShiftSettings settings_;
    ShiftObserver* observer_ = nullptr;
    JoinRule rule_;

    // Arguments of run().
    const BasePath* base_ = nullptr;
    const LightPaths* light_ = nullptr;
    OffsetPaths* paths_ = nullptr;
    PendingEdges* edges_ = nullptr;
    OutcomeLanes* outcomes_ = nullptr;

    // Offset paths at the current vertex of the walk.
    PrimaryVertices* primary_ = nullptr; ///< y_1
    const OffsetVertices* y_ = nullptr;  ///< y_i
    LaneMask active_;                    ///< offsets that continue
    FloatLanes apart_;                   ///< s_i of y_i, theory (16), scene units
    FloatLanes own_width_;               ///< pixel width at y_i (Tracer::width_beyond), scene units, or no_width
    PrefixLanes prefix_;
    FirstScatter* first_scatter_ = nullptr; ///< receives the repeated scatter at y_1; null: not needed
    OffsetVertices moved_;                  ///< y_i beyond the first bounce
    std::vector<Vertex> moved_vertices_;
    std::vector<const Vertex*> next_vertices_; ///< y_{i+1} during a bounce

    // Scratch memory, too large for the stack.
    VertexConnection vertex_connection_;
    LightConnection light_connection_;
    BsdfLanes beyond_;      ///< at x_{i+1}, toward y_i
    FloatLanes ball_pdf_w_; ///< of emitter sampling, at y_i toward a ball at x_{i+1}
};

} // namespace tessera
