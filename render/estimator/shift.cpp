#include "render/estimator/shift.h"

#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace tessera {

void Shift::run(const BasePath& base, const LightPaths& light, const PrimaryVertices& primary, int self,
                OffsetPaths& paths, PendingEdges& edges, OutcomeLanes& outcomes) {
    base_ = &base;
    light_ = &light;
    paths_ = &paths;
    edges_ = &edges;
    outcomes_ = &outcomes;
    if (start(primary, self))
        walk();
}

/// False: there is nothing to shift to.
bool Shift::start(const PrimaryVertices& primary, int self) {
    y_ = primary_ = &primary;
    for (int m = 0; m < padded(primary.count()); ++m) {
        active_[m] = primary.exists[m];
        prefix_.density[m] = prefix_.value.x[m] = prefix_.value.y[m] = prefix_.value.z[m] = 1;
    }
    for (int m = 0; m < primary.count(); ++m)
        (*outcomes_)[m] = primary.exists[m] ? ShiftOutcome::ok : ShiftOutcome::outside;
    if (self >= 0)
        active_[self] = 0;
    for (int m = 0; trace_ && m < primary.count(); ++m)
        if (active_[m])
            trace_->add(m, primary[m]);
    std::int32_t any = 0;
    for (int m = 0; m < padded(primary.count()); ++m)
        any |= active_[m];
    return any != 0;
}

/// Goes along the base path, x_1, x_2, ... (vertices 0, 1, ...), and takes the offsets along.
void Shift::walk() {
    const auto alive_from = [&](int slot) { return slot <= light_->last_alive(); };
    bool lights_are_connected = false; // emitter sampling at x_i went the way y_{i-1} -> x_i
    for (int i = 0; i < base_->size(); ++i) {
        if (!lights_are_connected)
            shift_lights(i);
        if (!alive_from(light_->hit_slot(i)))
            return;
        if (base(i).survival < 1) // all that ends further on has survived the roulette on path length here
            for (int m = 0; m < y_->count(); ++m)
                prefix_.value.set(m, prefix_.value[m] / base(i).survival);
        if (i + 1 == base_->size())
            return escape(i); // what else could carry light there
        lights_are_connected = false;
        if (light_->step_is_connectable(i)) {
            lights_are_connected = joins_lights(i);
            connect_vertex(i);
            if (light_->join() == i + 1)
                return;
        }
        if (settings_.shift == ShiftKind::reconnection)
            return; // x_1 and x_2 are joined or nothing is
        // What is left for a bounce: emitter sampling at x_{i+1}, unless it is done, and all that ends further on.
        const int next_slot = lights_are_connected ? light_->hit_slot(i + 1) : light_->emitter_slot(i + 1, 0);
        const bool hit_is_left = !light_->step_is_connectable(i) && light_->is_alive(light_->hit_slot(i));
        if ((!hit_is_left && !alive_from(next_slot)) || !bounce(i))
            return;
    }
}

/// Asks those that go on from a vertex as connectable as the base's.
void Shift::ask_for_kind(bool connectable) {
    const float threshold = settings_.shift_threshold;
    for (int m = 0; m < padded(y_->count()); ++m) {
        const float roughness = y_->roughness[m];
        const bool same = (roughness > 0) & ((roughness > threshold) == connectable);
        asked_[m] = same ? active_[m] : 0;
    }
    note_others(active_, asked_, ShiftOutcome::kind_mismatch);
}

/// Notes why those asked who are not among the arrived are not.
void Shift::note_others(const LaneMask& asked, const LaneMask& arrived, ShiftOutcome outcome) {
    for (int m = 0; m < y_->count(); ++m) {
        ShiftOutcome& o = (*outcomes_)[m];
        o = (asked[m] != 0) & (arrived[m] == 0) & (o == ShiftOutcome::ok) ? outcome : o;
    }
}

void Shift::note(int m, ShiftOutcome outcome) {
    if ((*outcomes_)[m] == ShiftOutcome::ok)
        (*outcomes_)[m] = outcome;
}

/// Emitter sampling at x_i.
void Shift::shift_lights(int i) {
    const int first = light_->emitter_slot(i, 0), end = light_->hit_slot(i);
    if (first < light_->first_shared() || !light_->is_alive(first, end))
        return;
    const bool connectable = is_connectable(base(i).vertex);
    ask_for_kind(connectable);
    for (int sample = 0; sample < end - first; ++sample) {
        if (!light_->is_alive(first + sample))
            continue;
        // A copied half vector cannot meet a light without extent: that is always joined to.
        const bool can_be_hit = base_->lights(i)[static_cast<std::size_t>(sample)].light.can_be_hit();
        if (connectable || (!replays() && !can_be_hit)) {
            connect_light(i, sample);
            continue;
        }
        EdgeGroup* edges = replays() ? &edges_->add(first + sample, first + sample + 1) : nullptr;
        for (int m = 0; m < y_->count(); ++m)
            if (asked_[m])
                edges ? replay_light(i, sample, m, *edges) : bounce_to_light(i, sample, m);
    }
}

/// The offsets are joined to the same point of the light, at infinity to the same direction.
void Shift::connect_light(int i, int sample) {
    const LightSample& x = base_->lights(i)[static_cast<std::size_t>(sample)];
    const int slot = light_->emitter_slot(i, sample);
    connect_to_light(*y_, asked_, x.light, seen_, arriving_);
    y_->evaluate(seen_.direction, seen_.valid, bsdf_);
    OffsetRow& row = paths_->row(slot);
    EdgeGroup& edges = edges_->add(slot, slot + 1);
    const float bsdf_counts = x.light.can_be_hit() ? 1 : 0, share = x.pdf_w / x.pdf_sum;
    for (int m = 0; m < padded(y_->count()); ++m) {
        const float pdf_sum = bsdf_.pdf_w[m] * bsdf_counts + arriving_.pdf_w[m];
        // The pdf of the light's point is the same for all, so the ratio of the solid angles, the Jacobian, is the
        // inverse of that of the pdfs per solid angle.
        const float scale = share / arriving_.pdf_w[m];
        const float density = seen_.valid[m] ? prefix_.density[m] * pdf_sum * scale : 0.0f;
        row.set(m, density,
                {prefix_.value.x[m] * bsdf_.f_cos.x[m] * arriving_.radiance.x[m] * scale,
                 prefix_.value.y[m] * bsdf_.f_cos.y[m] * arriving_.radiance.y[m] * scale,
                 prefix_.value.z[m] * bsdf_.f_cos.z[m] * arriving_.radiance.z[m] * scale});
        edges.exists[m] = row.density[m] > 0 ? -1 : 0;
    }
    for (int m = 0; trace_ && m < y_->count(); ++m)
        if (edges.exists[m])
            trace_end(slot, m, bsdf_.pdf_w[m] * bsdf_counts + arriving_.pdf_w[m], x.pdf_w / arriving_.pdf_w[m]);
    edges_to_light(tracer_, *y_, seen_.direction, x.light, edges.segments);
    note_others(asked_, edges.exists, ShiftOutcome::no_light);
}

/// At a vertex too glossy to connect, the numbers of the light sample are replayed: as in
/// PathReuse::replay_to_all, the density ratio is 1, and the value the offset's own.
void Shift::replay_light(int i, int sample, int m, EdgeGroup& edges) {
    LightSample drawn;
    Segment way;
    if (!draw_light(tracer_, (*y_)[m], base_->random, i + 1, sample, drawn, way))
        return note(m, ShiftOutcome::no_light);
    const int slot = light_->emitter_slot(i, sample);
    paths_->row(slot).set(m, prefix_.density[m], prefix_.value[m] * drawn.brings);
    if (trace_) {
        const float base_pdf_sum = base_->lights(i)[static_cast<std::size_t>(sample)].pdf_sum;
        trace_end(slot, m, drawn.pdf_sum, base_pdf_sum / drawn.pdf_sum);
    }
    edges.exists[m] = -1;
    edges.segments.from.set(m, way.from);
    edges.segments.to.set(m, way.to);
}

/// Emitter sampling at a vertex too glossy to connect: the half vector is copied, and the ray must find a light.
void Shift::bounce_to_light(int i, int sample, int m) {
    const Vertex& y = (*y_)[m];
    const LightSample& x = base_->lights(i)[static_cast<std::size_t>(sample)];
    const std::optional<CopiedScatter> s = copy_half_vector(base(i).vertex, x.to_light, y);
    if (!s)
        return note(m, ShiftOutcome::no_light);
    Vertex scratch;
    const LightPoint light =
        tracer_.light_along(tracer_.leave(y, y.to_world(s->to_next)), scratch, RayKind::shift_bounce);
    end_at_light(light_->emitter_slot(i, sample), m, *s, y.position, light, x.pdf_sum, false);
}

/// A scatter done again, from `origin`, that ends the light path at `light`; it fails where that is black.
void Shift::end_at_light(int slot, int m, const CopiedScatter& s, glm::vec3 origin, const LightPoint& light,
                         float base_pdf_sum, bool is_delta) {
    const std::optional<LightRay> seen = light.seen_from(origin);
    if (!seen || is_black(seen->radiance))
        return note(m, ShiftOutcome::no_light);
    const float pdf_sum = s.pdf_w + (is_delta ? 0 : seen->pdf_w);
    // What is replayed keeps its strategy: its density ratio is 1, and the weight of the strategy is that at the
    // offset.
    const float scale = replays() ? 1 / pdf_sum : s.jacobian / base_pdf_sum;
    paths_->row(slot).set(m, prefix_.density[m] * pdf_sum * scale,
                          prefix_.value[m] * s.f_cos * seen->radiance * scale);
    if (trace_)
        trace_end(slot, m, pdf_sum, scale * base_pdf_sum, is_delta);
}

} // namespace tessera
