#pragma once

#include "render/paths/base_path.h"
#include "render/paths/offsets.h"
#include "render/paths/shift_onlooker.h"
#include "render/paths/tracer.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace tessera {

/// A scattering of a base path as it is done again at an offset vertex.
struct CopiedScatter {
    glm::vec3 to_next; ///< in the offset vertex's frame
    Rgb f_cos;
    float pdf_w;    ///< per solid angle, or a probability after a delta scatter
    float jacobian; ///< solid angle at the offset over solid angle at the base; 1 after a copied delta scatter
};

/// Copies the half vector of a reflection or, where base_to_next is on the other side, of a refraction from the
/// base's frame to the offset's [Kettunen 2015, 5.2; Jacobians from Walter 2007, eq. 14 and 17]. The index of
/// refraction is each vertex's own.
/// Empty: light cannot go that way at the offset, or only on the other side; the offset then carries nothing.
std::optional<CopiedScatter> copy_half_vector(const Vertex& base, glm::vec3 base_to_next, const Vertex& offset);

/// Repeats a delta scatter at the offset. Empty: it has no such part, or all light is reflected.
std::optional<CopiedScatter> copy_delta(Scatter scatter, const Vertex& offset);

/// What the pixels of a sampling set see, x_1 of each.
class PrimaryVertices : public OffsetVertices {
public:
    FloatLanes pixel_width; ///< BasePath::pixel_width

    /// Begins another set.
    void reset(int count) {
        OffsetVertices::reset(count);
        ++set_;
    }
    /// Keeps a reference to the path, which sees something.
    void set_pixel(int lane, const BasePath& path) {
        set(lane, path[0].vertex);
        pixel_width[lane] = path.pixel_width;
    }

    /// What lies beyond x_1 in the direction of a delta scatter: that is the same for every base path of the set,
    /// so it is traced for the first alone, by trace(vertex), which says whether there is anything. Null: nothing
    /// is. It stays until the next set.
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
        std::uint64_t set = 0; ///< of which it is known; 0: of none
        glm::vec3 direction;   ///< unit, world
        bool is_met;
        Vertex vertex;
    };

    std::vector<Beyond> beyond_; ///< two a lane, reflected and transmitted; never shrinks
    std::uint64_t set_ = 0;
};

/// How a shift went, a lane a pixel.
using OutcomeLanes = LaneArray<ShiftOutcome>;

/// What the way from the camera to the offset vertices has cost: products of ratios, each of them a single number
/// (never products of densities, which underflow).
struct PrefixLanes {
    FloatLanes ratio; ///< pdf of the offset with its Jacobians over the base's, no unit
    Vec3Lanes value;  ///< f of the offset with its Jacobians over the base's pdf
};

/// Offset vertices y_i joined to the base's next vertex, x_{i+1}.
struct VertexConnection {
    int vertex;            ///< i, from 0
    LaneMask asked;        ///< the offsets that go on, and are of the base's kind there
    SightLanes sight;      ///< of x_{i+1} from y_i
    BsdfLanes bsdf;        ///< at y_i, toward x_{i+1}
    LaneMask lit;          ///< those of `asked` to which light can come that way
    LaneMask reached;      ///< those of `lit` whose edge is long enough for light from beyond x_{i+1}
    PrefixLanes prefix;    ///< through that edge, by BSDF sampling alone; ratio 0 where it is not reached
    Vec3Lanes to_previous; ///< unit, from x_{i+1} to y_i, in the frame of x_{i+1}
};

/// Offset vertices y_i joined to a point on a light, or to a direction at infinity.
struct LightConnection {
    LaneMask asked; ///< the offsets that go on, and are of the base's kind there
    SightLanes sight;
    LightLanes arriving;
    BsdfLanes bsdf; ///< at y_i, toward the light
};

/// Shifts all light paths of a base path to other pixels at once, lane by lane, by the kind of shift in
/// `settings`, but for random replay all the way (PathReuse): until base and offset can be connected, half vectors
/// are copied [Bauszat 2017, 3.1] or random numbers replayed [Hua 2019, 3.1]. The base path alone decides on every
/// branch, so all lanes do the same arithmetic. In x_i and y_i, i counts from 0
/// in this class, as vertices do: i = 0 is what METHODS.md calls x_1.
///
/// The walk along the base path is in shift.cpp; how offsets are joined to a vertex or a light of the base path in
/// shift_connections.cpp; how a scatter is done again, and a ray traced, in shift_bounces.cpp.
class Shift {
public:
    Shift(const Tracer& tracer, const ShiftSettings& settings)
        : tracer_(tracer), settings_(settings), rule_(settings, 0) {}

    /// @param primary  what the pixels see; a lane without a vertex is not shifted to. It
    ///                 remembers what lies beyond delta scatters
    /// @param self     the lane of the base's own pixel, which is left alone; -1: none
    /// @param paths    receives ratios and values, all failed before
    /// @param edges    receives the new edges, unchecked
    /// @param outcomes receives ok, or why the first light path that failed did so
    void run(const BasePath& base, const LightPaths& light, PrimaryVertices& primary, int self, OffsetPaths& paths,
             PendingEdges& edges, OutcomeLanes& outcomes);

    /// @param onlooker  is told of all that the next runs do; null: nobody is
    void set_onlooker(ShiftOnlooker* onlooker) { onlooker_ = onlooker; }

private:
    const BaseVertex& base(int i) const { return (*base_)[i]; }
    bool replays() const { return settings_.shift == ShiftKind::replay_reconnection; }
    /// Whether offsets at x_i are joined to the light sample there.
    bool joins_light(int i) const;
    /// Whether an offset at y_i would be joined to what it meets at that distance, for the light that it gives.
    bool joins(int m, float distance) const {
        return rule_.covers(y_->roughness[m], rule_.turn(apart_[m], distance));
    }

    // The walk.
    bool start(int self);
    void walk();
    void shift_light(int i);
    void escape(int i);
    void ask_for_lobes(LaneMask& asked);
    void keep_alike(bool joined, LaneMask& asked, SightLanes& sight);
    void fail_others(const LaneMask& asked, const LaneMask& arrived, ShiftOutcome outcome);
    void fail(int m, ShiftOutcome outcome);

    // Connections.
    void keep_scatter(int i, int first_slot, int end_slot, const Vec3Lanes& direction, const BsdfLanes& bsdf);
    void connect_light(int i, bool is_joined);
    void connect_infinity(int i);
    void connect_next(int i);
    const VertexConnection& connect_vertex(int i, EdgeGroup& edges);
    void shift_hit(const VertexConnection& connection);
    void shift_light_beyond(const VertexConnection& connection);
    void shift_tail(const VertexConnection& connection);

    // Bounces.
    bool bounce(int i);
    bool bounce(int i, int m);
    const Vertex* meet(int i, int m, glm::vec3 direction);
    void bounce_to_light(int i, int m);
    void bounce_out(int i, int m);
    void ask_for_scatter(int i, int first_slot, int end_slot);
    void keep_bounce(int m, const CopiedScatter& s, bool is_delta);
    void replay_light(int i, int m, EdgeGroup& edges);
    void end_at_light(int slot, int m, const CopiedScatter& s, glm::vec3 origin, const LightPoint& light,
                      float base_pdf_sum, bool is_delta);
    bool is_joined_alike(int i, int m, float distance, const Vertex& next) const;
    bool may_be_alike(int i, int m) const;
    std::optional<CopiedScatter> copy_scatter(int i, int m);
    std::optional<CopiedScatter> replay_scatter(int i, int m);

    /// Calls tell(m) for the lanes of the mask, if anybody looks on.
    template <class Tell>
    void tell_of(const LaneMask& lanes, Tell&& tell) const {
        for (int m = 0; onlooker_ && m < y_->count(); ++m)
            if (lanes[m])
                tell(m);
    }
    /// How the light path of a slot has ended in lane m.
    OffsetStep last_step(int slot, int m, float pdf_w, float jacobian, bool is_delta = false) const {
        return {light_->vertex_of(slot), pdf_w, is_delta, jacobian, paths_->ratio(slot, m),
                paths_->value(slot, m)};
    }

    Tracer tracer_;
    ShiftSettings settings_;
    ShiftOnlooker* onlooker_ = nullptr;
    JoinRule rule_;

    // The base path at hand and what becomes of it.
    const BasePath* base_ = nullptr;
    const LightPaths* light_ = nullptr;
    OffsetPaths* paths_ = nullptr;
    PendingEdges* edges_ = nullptr;
    OutcomeLanes* outcomes_ = nullptr;

    // The offsets, as far as the walk has come.
    PrimaryVertices* primary_ = nullptr; ///< y_1
    const OffsetVertices* y_ = nullptr;  ///< y_i
    LaneMask active_;                    ///< those that go on
    FloatLanes apart_;                   ///< how far y_i lies from other pixels' (JoinRule)
    FloatLanes own_width_;               ///< of a pixel at y_i, as Tracer::width_beyond() has it
    PrefixLanes prefix_;
    FirstScatter* bounced_ = nullptr; ///< the scatter at y_1 that is done again, lane by lane; null: nobody asks
    OffsetVertices moved_;            ///< y_i beyond the first bounce
    std::vector<Vertex> moved_vertices_;
    std::vector<const Vertex*> met_; ///< y_{i+1} while it is looked for

    // Memory that is too large for the stack, written before it is read by whoever makes a connection.
    VertexConnection vertex_connection_;
    LightConnection light_connection_;
    BsdfLanes beyond_; ///< at x_{i+1}, toward y_i
};

} // namespace tessera
