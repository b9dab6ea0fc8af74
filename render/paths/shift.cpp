#include "render/paths/shift.h"

#include <cmath>
#include <cstdint>

#include <glm/vec3.hpp>

namespace tessera {

void Shift::run(const BasePath& base, const LightPaths& light, PrimaryVertices& primary, int self,
                OffsetPaths& paths, PendingEdges& edges, OutcomeLanes& outcomes) {
    base_ = &base;
    light_ = &light;
    paths_ = &paths;
    edges_ = &edges;
    outcomes_ = &outcomes;
    y_ = primary_ = &primary;
    rule_ = JoinRule(settings_, base.pixel_angle);
    if (start(self))
        walk();
}

/// Sets all lanes to y_1. Returns false if there is no pixel to shift to.
bool Shift::start(int self) {
    for (int m = 0; m < padded(y_->count()); ++m) {
        active_[m] = y_->exists[m];
        apart_[m] = rule_.apart(primary_->pixel_width[m]);
        own_width_[m] = primary_->pixel_width[m];
        prefix_.ratio[m] = prefix_.value.x[m] = prefix_.value.y[m] = prefix_.value.z[m] = 1;
    }
    for (int m = 0; m < y_->count(); ++m)
        (*outcomes_)[m] = y_->exists[m] ? ShiftOutcome::ok : ShiftOutcome::outside;
    if (self >= 0)
        active_[self] = 0;
    notify(active_, [&](int m) { observer_->arrives(m, (*y_)[m]); });
    std::int32_t any = 0;
    for (int m = 0; m < padded(y_->count()); ++m)
        any |= active_[m];
    return any != 0;
}

/// Walks along the base path and shifts the light paths that end at each vertex.
void Shift::walk() {
    const auto alive_from = [&](int slot) { return slot <= light_->last_alive(); };
    bool lights_are_connected = false; // the light sample at x_i is shifted through the edge y_{i-1} -> x_i
    for (int i = 0; i < base_->size(); ++i) {
        if (!lights_are_connected)
            shift_light(i);
        if (!alive_from(light_->hit_slot(i)))
            return;
        if (base(i).survival < 1) // of roulette on path length, for all light paths that continue
            for (int m = 0; m < y_->count(); ++m)
                prefix_.value.set(m, prefix_.value[m] / base(i).survival);
        if (i + 1 == base_->size())
            return escape(i); // its hit slot carries light only if the path escapes
        lights_are_connected = false;
        if (light_->step_is_connectable(i)) {
            lights_are_connected = light_->step_joins(i);
            connect_next(i);
            if (light_->join() == i + 1)
                return;
        }
        if (settings_.shift == ShiftKind::reconnection)
            return; // this shift joins at the second vertex only
        // A bounce shifts what is left: the light sample at x_{i+1}, unless it is done, and all that ends beyond.
        const int next_slot = lights_are_connected ? light_->hit_slot(i + 1) : light_->emitter_slot(i + 1);
        const bool hit_is_left = !light_->step_is_connectable(i) && light_->is_alive(light_->hit_slot(i));
        if ((!hit_is_left && !alive_from(next_slot)) || !bounce(i))
            return;
    }
}

/// Shifts the light sample at x_i.
void Shift::shift_light(int i) {
    const int slot = light_->emitter_slot(i);
    if (slot < light_->first_shared() || !light_->is_alive(slot))
        return;
    LaneMask& eligible = light_connection_.eligible;
    select_lobes(eligible);
    const bool connectable = light_is_connectable(i);
    if (connectable || (!replays() && !base_->light(i).light.can_be_hit()))
        return connect_light(i, connectable);
    begin_first_scatter(i, slot, slot + 1);
    EdgeGroup* edges = replays() ? &edges_->add(slot, slot + 1) : nullptr;
    for (int m = 0; m < y_->count(); ++m)
        if (eligible[m])
            edges ? replay_light(i, m, *edges) : bounce_to_light(i, m);
}

/// Shifts the light path that leaves the scene at the last vertex, x_i, and hits the environment.
void Shift::escape(int i) {
    if (light_->hit_slot(i) < light_->first_shared())
        return;
    if (light_->step_is_connectable(i))
        return connect_infinity(i);
    begin_first_scatter(i, light_->hit_slot(i), light_->hit_slot(i) + 1);
    for (int m = 0; m < y_->count(); ++m)
        if (active_[m])
            bounce_out(i, m);
}

bool Shift::light_is_connectable(int i) const {
    const Vertex& x = base(i).vertex;
    const float distance = base_->light(i).light.distance_from(x.position);
    return rule_.covers(x.bsdf.roughness(), rule_.turn(light_->apart(i), distance));
}

/// Selects the active offsets that have a non-delta lobe. The others fail.
void Shift::select_lobes(LaneMask& eligible) {
    for (int m = 0; m < padded(y_->count()); ++m)
        eligible[m] = y_->roughness[m] > 0 ? active_[m] : 0;
    record_failures(active_, eligible, ShiftOutcome::kind_mismatch);
}

/// Keeps the eligible offsets whose edge is connectable exactly if the base's is. The others fail.
void Shift::keep_alike(bool connectable, LaneMask& eligible, ConnectionLanes& sight) {
    for (int m = 0; m < padded(y_->count()); ++m) {
        const bool same = is_connectable(m, std::sqrt(sight.distance2[m])) == connectable;
        eligible[m] = same ? eligible[m] : 0;
        sight.valid[m] &= eligible[m];
    }
    record_failures(active_, eligible, ShiftOutcome::kind_mismatch);
}

/// Records the outcome for the eligible lanes that have not arrived. Only the first failure is kept.
void Shift::record_failures(const LaneMask& eligible, const LaneMask& arrived, ShiftOutcome outcome) {
    for (int m = 0; m < y_->count(); ++m) {
        ShiftOutcome& o = (*outcomes_)[m];
        o = (eligible[m] != 0) & (arrived[m] == 0) & (o == ShiftOutcome::ok) ? outcome : o;
    }
}

void Shift::fail(int m, ShiftOutcome outcome) {
    if ((*outcomes_)[m] == ShiftOutcome::ok)
        (*outcomes_)[m] = outcome;
}

} // namespace tessera
