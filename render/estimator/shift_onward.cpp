#include "render/estimator/shift.h"

#include <algorithm>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

// Shift: what lies beyond a vertex of the base path.

/// The base leaves the scene at its last vertex, x_i, and meets the environment.
void Shift::escape(int i) {
    const BaseVertex& x = base(i);
    if (light_->hit_slot(i) < light_->first_shared())
        return;
    if (light_->step_is_connectable(i))
        return connect_infinity(i);
    for (int m = 0; m < y_->count(); ++m) {
        if (!active_[m])
            continue;
        const Vertex& y = (*y_)[m];
        const std::optional<CopiedScatter> s = copy_scatter(i, m);
        if (!s)
            continue;
        Vertex scratch;
        const LightPoint light =
            tracer_.light_along(tracer_.leave(y, y.to_world(s->to_next)), scratch, RayKind::shift_bounce);
        end_at_light(light_->hit_slot(i), m, *s, y.position, light, x.pdf_w + x.hit_pdf_w, x.is_delta);
    }
}

/// Joins the offsets to the environment: the same direction, so with a Jacobian of 1.
void Shift::connect_infinity(int i) {
    const BaseVertex& x = base(i);
    const int slot = light_->hit_slot(i);
    const LightPoint infinity{LightPoint::Kind::environment, x.vertex.to_world(x.to_next), glm::vec3(0), Rgb(0),
                              0};
    ask_for_kind(true);
    for (int m = 0; m < padded(y_->count()); ++m)
        seen_.direction.set(m, infinity.position);
    y_->evaluate(seen_.direction, asked_, bsdf_);
    OffsetRow& row = paths_->row(slot);
    EdgeGroup& edges = edges_->add(slot, slot + 1);
    for (int m = 0; m < padded(y_->count()); ++m) {
        // hit_brings is the radiance times pdf_w over the summed pdfs.
        const float density = prefix_.density[m] * (bsdf_.pdf_w[m] + x.hit_pdf_w) / (x.pdf_w + x.hit_pdf_w);
        row.set(m, asked_[m] ? density : 0.0f, prefix_.value[m] * bsdf_.f_cos[m] * x.hit_brings / x.pdf_w);
        edges.exists[m] = row.density[m] > 0 ? -1 : 0;
    }
    for (int m = 0; trace_ && m < y_->count(); ++m)
        if (edges.exists[m])
            trace_end(slot, m, bsdf_.pdf_w[m] + x.hit_pdf_w, 1);
    edges_to_light(tracer_, *y_, seen_.direction, infinity, edges.segments);
    note_others(asked_, edges.exists, ShiftOutcome::no_light);
}

/// Joins the offsets to x_{i+1}: for its emission, for emitter sampling there, and beyond it if that is where
/// offsets join.
void Shift::connect_vertex(int i) {
    const BaseVertex& x = base(i);
    const Vertex& next = base(i + 1).vertex;
    // The slots that go through this edge: a light path that leaves x_{i+1} by a half vector takes another way.
    int end = light_->hit_slot(i) + 1;
    if (light_->join() == i + 1)
        end = light_->tail_slot() + 1;
    else if (joins_lights(i))
        end = light_->hit_slot(i + 1);
    const int first = std::max(light_->hit_slot(i), light_->first_shared());
    if (!light_->is_alive(first, end))
        return;
    ask_for_kind(true);
    connect_to_point(*y_, asked_, next.position, next.geometric_normal, false, seen_);
    y_->evaluate(seen_.direction, seen_.valid, bsdf_);
    EdgeGroup& edges = edges_->add(first, end);
    const float length_a_width = least_length(settings_, 1);
    const FloatLanes& pixel_width = primary_->pixel_width;
    for (int m = 0; m < padded(y_->count()); ++m) {
        const float jacobian = seen_.geometry[m] / x.next_geometry; // of solid angles
        const float scale = jacobian / x.pdf_w;
        const bool is_lit = (bsdf_.f_cos.x[m] > 0) | (bsdf_.f_cos.y[m] > 0) | (bsdf_.f_cos.z[m] > 0);
        edges.exists[m] = is_lit ? seen_.valid[m] : 0;
        const float least = length_a_width * pixel_width[m];
        reached_[m] = seen_.distance2[m] >= least * least ? edges.exists[m] : 0;
        joined_.density[m] = reached_[m] ? prefix_.density[m] * bsdf_.pdf_w[m] * scale : 0.0f;
        joined_.value.x[m] = prefix_.value.x[m] * bsdf_.f_cos.x[m] * scale;
        joined_.value.y[m] = prefix_.value.y[m] * bsdf_.f_cos.y[m] * scale;
        joined_.value.z[m] = prefix_.value.z[m] * bsdf_.f_cos.z[m] * scale;
        to_previous_.set(m, next.to_local(-seen_.direction[m]));
    }
    if (trace_)
        trace_join(i);
    if (first == light_->hit_slot(i) && light_->is_alive(first))
        set_hits(i, edges.exists);
    connect_beyond(i + 1, reached_);
    edges_to_point(tracer_, *y_, seen_.direction, next.position, next.geometric_normal, edges.segments);
    note_others(asked_, edges.exists, ShiftOutcome::no_light);
    if (end > light_->hit_slot(i) + 1)
        note_others(edges.exists, reached_, ShiftOutcome::kind_mismatch);
    for (int m = 0; m < padded(y_->count()); ++m)
        active_[m] = asked_[m]; // from another kind of vertex nothing can be shifted any more
}

/// x_{i+1} gives light itself: both strategies could have ended there.
void Shift::set_hits(int i, const LaneMask& arrived) {
    const BaseVertex& x = base(i);
    const Vertex& next = base(i + 1).vertex;
    const LightPoint front = tracer_.light_of(next, next.geometric_normal);
    const glm::vec3 normal = next.geometric_normal;
    OffsetRow& row = paths_->row(light_->hit_slot(i));
    for (int m = 0; m < padded(y_->count()); ++m) {
        const bool faces =
            seen_.direction.x[m] * normal.x + seen_.direction.y[m] * normal.y + seen_.direction.z[m] * normal.z <
            0;
        // joined_ has the pdf of BSDF sampling alone, over the base's alone.
        const float scale = seen_.geometry[m] / (x.next_geometry * (x.pdf_w + x.hit_pdf_w));
        const float density = prefix_.density[m] * (bsdf_.pdf_w[m] + front.pdf / seen_.geometry[m]) * scale;
        row.set(m, faces && arrived[m] ? density : 0.0f,
                prefix_.value[m] * bsdf_.f_cos[m] * front.radiance * scale);
    }
    for (int m = 0; trace_ && m < y_->count(); ++m)
        if (arrived[m])
            trace_end(light_->hit_slot(i), m, bsdf_.pdf_w[m] + front.pdf / seen_.geometry[m],
                      seen_.geometry[m] / x.next_geometry);
}

/// The light that comes to x_next, seen from other directions than the base's. Nothing else changes.
void Shift::connect_beyond(int next, const LaneMask& arrived) {
    const BaseVertex& x = base(next);
    const int count = y_->count();
    for (int sample = 0; joins_lights(next - 1) && sample < base_->light_samples(); ++sample) {
        const LightSample& l = base_->lights(next)[static_cast<std::size_t>(sample)];
        const int slot = light_->emitter_slot(next, sample);
        if (!light_->is_alive(slot))
            continue;
        const std::optional<LightRay> seen = l.light.seen_from(x.vertex.position);
        if (!seen)
            continue;
        evaluate(x.vertex.bsdf, to_previous_, l.to_light, arrived, count, bsdf_);
        const float bsdf_counts = l.light.can_be_hit() ? 1 : 0, scale = 1 / l.pdf_sum;
        OffsetRow& row = paths_->row(slot);
        for (int m = 0; m < padded(count); ++m)
            row.set(m, joined_.density[m] * (bsdf_.pdf_w[m] * bsdf_counts + l.pdf_w) * scale,
                    joined_.value[m] * bsdf_.f_cos[m] * seen->radiance * scale);
        if (trace_)
            trace_beyond(slot, arrived, bsdf_counts, l.pdf_w);
    }
    if (light_->join() != next || light_->last_alive() < light_->hit_slot(next))
        return;
    evaluate(x.vertex.bsdf, to_previous_, x.to_next, arrived, count, bsdf_);
    OffsetRow &hit = paths_->row(light_->hit_slot(next)), &tail = paths_->row(light_->tail_slot());
    const float scale = 1 / (x.pdf_w * x.survival), hit_scale = 1 / (x.pdf_w + x.hit_pdf_w);
    for (int m = 0; m < padded(count); ++m) {
        const Rgb value = joined_.value[m] * bsdf_.f_cos[m] * scale;
        // hit_brings is the radiance times pdf_w over the summed pdfs.
        hit.set(m, joined_.density[m] * (bsdf_.pdf_w[m] + x.hit_pdf_w) * hit_scale, value * x.hit_brings);
        tail.set(m, joined_.density[m] * bsdf_.pdf_w[m] / x.pdf_w, value * x.arriving);
    }
    if (trace_) {
        trace_beyond(light_->hit_slot(next), arrived, 1, x.hit_pdf_w);
        trace_beyond(light_->tail_slot(), arrived, 1, 0);
    }
}

/// Does the scatter at x_i again in all lanes that go on, and makes y_{i+1} what lies there. False: none is left.
bool Shift::bounce(int i) {
    const int count = y_->count();
    moved_vertices_.resize(static_cast<std::size_t>(count));
    bool any = false;
    for (int m = 0; m < count; ++m) {
        active_[m] = active_[m] && bounce(i, m) ? -1 : 0;
        any = any || active_[m];
    }
    moved_.reset(count);
    for (int m = 0; m < count; ++m)
        if (active_[m])
            moved_.set(m, moved_vertices_[static_cast<std::size_t>(m)]);
    for (int m = 0; trace_ && m < count; ++m)
        if (active_[m])
            trace_->add(m, moved_[m]);
    y_ = &moved_;
    return any;
}

bool Shift::bounce(int i, int m) {
    const BaseVertex& x = base(i);
    const std::optional<CopiedScatter> s = copy_scatter(i, m);
    if (!s)
        return false;
    const Vertex& y = (*y_)[m];
    Vertex& next = moved_vertices_[static_cast<std::size_t>(m)]; // perhaps y itself
    const glm::vec3 direction = y.to_world(s->to_next);
    const glm::vec3 origin = y.position;
    const bool is_inside = tracer_.closest(tracer_.leave(y, direction), next, RayKind::shift_bounce);
    // From a connectable vertex, an emitter is reached by connecting (done before); else by this very ray.
    if (!light_->step_is_connectable(i) && light_->is_alive(light_->hit_slot(i))) {
        const LightPoint met =
            is_inside ? tracer_.light_of(next, -direction) : tracer_.environment_toward(direction);
        end_at_light(light_->hit_slot(i), m, *s, origin, met, x.pdf_w + x.hit_pdf_w, x.is_delta);
    }
    if (!is_inside) {
        note(m, ShiftOutcome::outside);
        return false;
    }
    if (!is_as_long(i, m, origin, next)) {
        note(m, ShiftOutcome::kind_mismatch);
        return false;
    }
    const float scale = s->jacobian / x.pdf_w;
    prefix_.density[m] *= s->pdf_w * scale;
    prefix_.value.set(m, prefix_.value[m] * s->f_cos * scale);
    if (trace_)
        trace_->bounce(m, {i, s->pdf_w, x.is_delta, s->jacobian, prefix_.density[m], prefix_.value[m]});
    return true;
}

/// Whether the way back would be this one, as far as that depends on lengths: shortness alone, or neither there
/// nor here, keeps the edge from being joined. (Lengths alone would not do: from a mirror beside smooth plastic
/// one comes to both long and short edges, between which there is no way, and the weights of the three would not
/// add up to 1.)
bool Shift::is_as_long(int i, int m, glm::vec3 from, const Vertex& next) const {
    if (!light_->step_is_connectable(i))
        return true;
    const bool is_only_short =
        is_connectable(next) && !is_long(from, next.position, least_length(settings_, primary_->pixel_width[m]));
    return is_only_short == (is_connectable(base(i + 1).vertex) && !light_->step_is_long(i));
}

/// The scatter at x_i done again at y: both must be of one kind.
std::optional<CopiedScatter> Shift::copy_scatter(int i, int m) {
    if (replays())
        return replay_scatter(i, m);
    const BaseVertex& x = base(i);
    const Vertex& y = (*y_)[m];
    if (x.is_delta) {
        const std::optional<CopiedScatter> s = copy_delta(x.scatter, y);
        if (!s)
            note(m, x.scatter == Scatter::transmit && y.bsdf.roughness() <= 0 ? ShiftOutcome::total_reflection
                                                                              : ShiftOutcome::kind_mismatch);
        return s;
    }
    if (y.bsdf.roughness() <= 0 || is_connectable(x.vertex) != is_connectable(y)) {
        note(m, ShiftOutcome::kind_mismatch);
        return {};
    }
    const std::optional<CopiedScatter> s = copy_half_vector(x.vertex, x.to_next, y);
    if (!s)
        note(m, ShiftOutcome::no_light);
    return s;
}

/// The scatter at x_i done again at y with the same random numbers. Both must be of one kind, or one side would
/// connect where the other does not.
std::optional<CopiedScatter> Shift::replay_scatter(int i, int m) {
    const BaseVertex& x = base(i);
    const Vertex& y = (*y_)[m];
    const auto s = y.bsdf.sample(y.to_previous, base_->random.draw(i + 1, Draw::lobe),
                                 base_->random.draw_2d(i + 1, Draw::direction));
    if (!s) {
        note(m, ShiftOutcome::no_light);
        return {};
    }
    if (s->is_delta != x.is_delta || is_connectable(x.vertex) != is_connectable(y)) {
        note(m, ShiftOutcome::kind_mismatch);
        return {};
    }
    // In the space of random numbers the shift is the identity, so its Jacobian undoes the ratio of the pdfs.
    return CopiedScatter{s->to_next, s->f_cos, s->pdf_w, x.pdf_w / s->pdf_w};
}

// Shift: what an onlooker is told. The numbers are those that were just calculated with.

/// The light path of a slot ends at a light, as seen from y_i.
/// @param pdf_w  of all strategies together
void Shift::trace_end(int slot, int m, float pdf_w, float jacobian, bool is_delta) {
    const OffsetRow& row = paths_->row(slot);
    trace_->end(m, slot, {light_->vertex_of(slot), pdf_w, is_delta, jacobian, row.density[m], row.value[m]});
}

/// All y_i have been joined to x_{i+1}.
void Shift::trace_join(int i) {
    traced_joins_.clear();
    for (int m = 0; m < y_->count(); ++m)
        traced_joins_.push_back({i, bsdf_.pdf_w[m], false, seen_.geometry[m] / base(i).next_geometry,
                                 joined_.density[m], joined_.value[m]});
}

/// The light path of a slot goes on from the x_{i+1} that is joined to: nothing is stretched there.
/// @param bsdf_share  0: BSDF sampling could not have gone on that way
/// @param other_pdf_w of emitter sampling for the same
void Shift::trace_beyond(int slot, const LaneMask& arrived, float bsdf_share, float other_pdf_w) {
    const OffsetRow& row = paths_->row(slot);
    for (int m = 0; m < y_->count(); ++m) {
        if (!arrived[m])
            continue;
        const OffsetStep& join = traced_joins_[static_cast<std::size_t>(m)];
        const float pdf_w = bsdf_.pdf_w[m] * bsdf_share + other_pdf_w;
        trace_->end_beyond(m, slot, join, {join.vertex + 1, pdf_w, false, 1, row.density[m], row.value[m]});
    }
}

} // namespace tessera
