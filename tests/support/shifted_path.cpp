#include "tests/support/shifted_path.h"

#include "render/paths/shift.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera::test {

namespace {

/// End of the light path of a slot. If neither is_tail nor is_hit holds, it ends by emitter sampling at `vertex`.
struct SlotEnd {
    bool is_tail; ///< light paths that end beyond the reconnection vertex
    bool is_hit;  ///< BSDF sampling at `vertex` hits a light
    int vertex;   ///< last vertex at which a direction or light is sampled; for the tail the reconnection vertex
};

SlotEnd end_of(const LightPaths& light, int slot) {
    if (light.has_join() && slot == light.tail_slot())
        return {true, false, light.join()};
    const int vertex = light.vertex_of(slot);
    return {false, slot == light.hit_slot(vertex), vertex};
}

class Builder {
public:
    Builder(const Tracer& tracer, const ShiftSettings& settings, const BasePath& base, int slot)
        : tracer_(tracer), settings_(settings), base_(base) {
        light_.reset(base, settings);
        end_ = end_of(light_, slot);
    }

    std::optional<BasePath> build(const BasePath& other) {
        path_.reset(base_.random);
        path_.pixel_width = other.pixel_width;
        path_.pixel_angle = other.pixel_angle;
        path_.own_width = other.pixel_width;
        keep(other[0].vertex);
        const int steps = end_.vertex + (end_.is_hit || end_.is_tail);
        for (int i = 0; i < steps; ++i)
            if (!step(i))
                return {};
        if (end_.is_tail)
            append_suffix();
        else if (!end_.is_hit && !end_by_emitter_sampling())
            return {};
        return path_;
    }

private:
    bool ends_by_hit(int i) const { return end_.is_hit && i == end_.vertex; }

    /// Returns whether the edge from vertex i leads to the base's next vertex.
    bool connects(int i) const {
        if (light_.has_join() && i >= light_.join())
            return true; // the base's own vertices
        if (!light_.step_is_connectable(i))
            return false;
        const bool joins = light_.has_join() && i + 1 >= light_.join();
        const bool is_lit = !end_.is_hit && i + 1 == end_.vertex && light_.step_joins(i);
        return ends_by_hit(i) || joins || is_lit;
    }

    void keep(const Vertex& vertex) {
        path_.spare().vertex = vertex;
        path_.mirrors += path_.mirrors == path_.size() && vertex.bsdf.is_mirror();
        path_.keep();
        BaseVertex& y = path_[path_.size() - 1];
        y.hit_pdf_w = 0;
        y.hit_contribution = y.arriving = Rgb(0);
    }

    bool step(int i) {
        const BaseVertex& x = base_[i];
        BaseVertex& y = path_[i];
        y.survival = x.survival;
        y.is_delta = x.is_delta;
        y.scatter = x.scatter;
        return connects(i) ? step_to_base(i) : step_by_copy(i);
    }

    bool step_to_base(int i) {
        const BaseVertex& x = base_[i];
        BaseVertex& y = path_[i];
        const glm::vec3 direction = x.escapes ? x.vertex.to_world(x.to_next)
                                              : glm::normalize(base_[i + 1].vertex.position - y.vertex.position);
        y.to_next = y.vertex.to_local(direction);
        const BsdfValue b = y.vertex.bsdf.evaluate(y.vertex.to_previous, y.to_next);
        y.f_cos = b.f_cos;
        y.pdf_w = b.pdf_w;
        if (!(b.pdf_w > 0))
            return false;
        if (x.escapes)
            return escape(y, direction);
        Vertex next = base_[i + 1].vertex;
        next.to_previous = next.to_local(-direction);
        return arrive(i, next, direction);
    }

    bool step_by_copy(int i) {
        BaseVertex& y = path_[i];
        const std::optional<CopiedScatter> s = copy(i, y.vertex);
        if (!s)
            return false;
        y.to_next = s->to_next;
        y.f_cos = s->f_cos;
        y.pdf_w = s->pdf_w;
        const glm::vec3 direction = y.vertex.to_world(s->to_next);
        Vertex next;
        if (!tracer_.closest(
                tracer_.leave(y.vertex, direction), next, RayKind::shift_bounce,
                tracer_.lookup(tracer_.width_beyond(path_.own_width, 0, y.is_delta), base_.mirrors > i)))
            return ends_by_hit(i) && escape(y, direction);
        path_.own_width =
            tracer_.width_beyond(path_.own_width, glm::distance(y.vertex.position, next.position), y.is_delta);
        return arrive(i, next, direction);
    }

    std::optional<CopiedScatter> copy(int i, const Vertex& y) const {
        const BaseVertex& x = base_[i];
        if (settings_.shift == ShiftKind::replay_reconnection) {
            const auto s = y.bsdf.sample(y.to_previous, base_.random.draw(i + 1, Draw::lobe),
                                         base_.random.draw_2d(i + 1, Draw::direction));
            return s ? std::optional(CopiedScatter{s->to_next, s->f_cos, s->pdf_w, 1}) : std::nullopt;
        }
        return x.is_delta ? copy_delta(x.scatter, y) : copy_half_vector(x.vertex, x.to_next, y);
    }

    bool escape(BaseVertex& y, glm::vec3 direction) {
        y.escapes = true;
        const LightPoint light = tracer_.environment_toward(direction);
        set_hit(y, light.radiance, light.pdf);
        return true;
    }

    bool arrive(int i, const Vertex& next, glm::vec3 direction) {
        keep(next);
        BaseVertex& y = path_[i]; // after keep(), which invalidates references
        const glm::vec3 d = next.position - y.vertex.position;
        y.next_geometry = std::abs(glm::dot(next.geometric_normal, direction)) / glm::dot(d, d);
        if (ends_by_hit(i)) {
            const LightPoint light = next.light_toward(-direction);
            set_hit(y, light.radiance, light.pdf_w(y.vertex.position, y.next_geometry));
        }
        return y.next_geometry > 0;
    }

    static void set_hit(BaseVertex& y, Rgb radiance, float pdf_w) {
        y.hit_pdf_w = y.is_delta || is_black(radiance) ? 0 : pdf_w;
        y.hit_contribution = radiance * (y.pdf_w / (y.pdf_w + y.hit_pdf_w));
    }

    /// Ends the light path by emitter sampling at the last vertex. Returns whether that is possible.
    bool end_by_emitter_sampling() {
        const Vertex& y = path_[end_.vertex].vertex;
        const LightSample& x = base_.light(end_.vertex);
        LightSample& drawn = path_.light(end_.vertex);
        const Vertex& last = base_[end_.vertex].vertex;
        const JoinRule rule(settings_, base_.pixel_angle);
        // After a step that joins, the last vertex is the base's own.
        const bool is_joined = end_.vertex > 0 && light_.step_joins(end_.vertex - 1);
        const bool connectable =
            is_joined || rule.covers(last.bsdf.roughness(),
                                     rule.turn(light_.apart(end_.vertex), x.light.distance_from(last.position)));
        if (!connectable && settings_.shift == ShiftKind::replay_reconnection) {
            Segment way;
            if (!draw_light(tracer_, y, base_.random, end_.vertex + 1, drawn, way))
                return false;
            complete_light(tracer_, drawn);
            return true;
        }
        drawn.light = x.light;
        if (!connectable && x.light.can_be_hit()) {
            const auto s = copy_half_vector(base_[end_.vertex].vertex, x.to_light, y);
            if (!s)
                return false;
            Vertex scratch;
            const Ray ray = tracer_.leave(y, y.to_world(s->to_next));
            drawn.light = tracer_.light_along(ray, scratch, RayKind::shift_bounce, tracer_.lookup());
        }
        const std::optional<LightRay> seen = drawn.light.seen_from(y.position);
        if (!seen)
            return false;
        drawn.to_light = y.to_local(seen->direction);
        const BsdfValue b = y.bsdf.evaluate(y.to_previous, drawn.to_light);
        drawn.pdf_w = seen->pdf_w;
        drawn.fixed_pdf_w = seen->fixed_pdf_w;
        drawn.pdf_sum = seen->pdf_w + (drawn.light.can_be_hit() ? b.pdf_w : 0);
        drawn.brings = b.f_cos * seen->radiance / drawn.pdf_sum;
        return true;
    }

    /// Appends the base's vertices beyond the reconnection vertex.
    void append_suffix() {
        const int join = end_.vertex;
        path_[join].arriving = base_[join].arriving;
        for (int i = join + 1; i < base_.size(); ++i) {
            if (i > join + 1)
                keep(base_[i].vertex);
            path_[i] = base_[i];
        }
    }

    const Tracer& tracer_;
    const ShiftSettings& settings_;
    const BasePath& base_;
    LightPaths light_;
    SlotEnd end_;
    BasePath path_;
};

} // namespace

BasePath isolated(const BasePath& path, const ShiftSettings& settings, int slot) {
    LightPaths light;
    light.reset(path, settings);
    const SlotEnd end = end_of(light, slot);
    BasePath one = path;
    one.direct = one.indirect = one.very_direct = Rgb(0);
    for (int i = 0; i < one.size(); ++i) {
        if (end.is_tail && i > end.vertex)
            break; // part of the tail
        if (end.is_tail || end.is_hit || i != end.vertex)
            one.light(i).brings = Rgb(0);
        if (!end.is_hit || i != end.vertex)
            one[i].hit_contribution = Rgb(0);
        if (!end.is_tail)
            one[i].arriving = Rgb(0);
    }
    return one;
}

std::optional<BasePath> shifted(const Tracer& tracer, const ShiftSettings& settings, const BasePath& base,
                                int slot, const BasePath& other) {
    if (settings.shift != ShiftKind::replay)
        return Builder(tracer, settings, base, slot).build(other);
    LightPaths light;
    light.reset(base, settings);
    BasePath path;
    replay_base_path(tracer, other, base.random, light.vertex_of(slot) + 1, path);
    LightPaths own;
    own.reset(path, settings);
    if (!own.is_alive(slot))
        return {};
    return isolated(path, settings, slot);
}

} // namespace tessera::test
