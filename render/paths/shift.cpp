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

/// False: there is nothing to shift to.
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
    tell_of(active_, [&](int m) { onlooker_->arrives(m, (*y_)[m]); });
    std::int32_t any = 0;
    for (int m = 0; m < padded(y_->count()); ++m)
        any |= active_[m];
    return any != 0;
}

/// Goes along the base path, x_1, x_2, ... (vertices 0, 1, ...), and takes the offsets along.
void Shift::walk() {
    const auto alive_from = [&](int slot) { return slot <= light_->last_alive(); };
    bool lights_are_connected = false; // emitter sampling at x_i went the way y_{i-1} -> x_i
    for (int i = 0; i < base_->size(); ++i) {
        if (!lights_are_connected)
            shift_light(i);
        if (!alive_from(light_->hit_slot(i)))
            return;
        if (base(i).survival < 1) // all that ends further on has survived the roulette on path length here
            for (int m = 0; m < y_->count(); ++m)
                prefix_.value.set(m, prefix_.value[m] / base(i).survival);
        if (i + 1 == base_->size())
            return escape(i); // what else could carry light there
        lights_are_connected = false;
        if (light_->step_is_connectable(i)) {
            lights_are_connected = light_->step_joins(i);
            connect_next(i);
            if (light_->join() == i + 1)
                return;
        }
        if (settings_.shift == ShiftKind::reconnection)
            return; // x_1 and x_2 are joined or nothing is
        // What is left for a bounce: emitter sampling at x_{i+1}, unless it is done, and all that ends further on.
        const int next_slot = lights_are_connected ? light_->hit_slot(i + 1) : light_->emitter_slot(i + 1);
        const bool hit_is_left = !light_->step_is_connectable(i) && light_->is_alive(light_->hit_slot(i));
        if ((!hit_is_left && !alive_from(next_slot)) || !bounce(i))
            return;
    }
}

/// Emitter sampling at x_i.
void Shift::shift_light(int i) {
    const int slot = light_->emitter_slot(i);
    if (slot < light_->first_shared() || !light_->is_alive(slot))
        return;
    LaneMask& asked = light_connection_.asked;
    ask_for_lobes(asked);
    const bool is_joined = joins_light(i);
    if (is_joined || (!replays() && !base_->light(i).light.can_be_hit()))
        return connect_light(i, is_joined);
    ask_for_scatter(i, slot, slot + 1);
    EdgeGroup* edges = replays() ? &edges_->add(slot, slot + 1) : nullptr;
    for (int m = 0; m < y_->count(); ++m)
        if (asked[m])
            edges ? replay_light(i, m, *edges) : bounce_to_light(i, m);
}

/// The base leaves the scene at its last vertex, x_i, and meets the environment.
void Shift::escape(int i) {
    if (light_->hit_slot(i) < light_->first_shared())
        return;
    if (light_->step_is_connectable(i))
        return connect_infinity(i);
    ask_for_scatter(i, light_->hit_slot(i), light_->hit_slot(i) + 1);
    for (int m = 0; m < y_->count(); ++m)
        if (active_[m])
            bounce_out(i, m);
}

bool Shift::joins_light(int i) const {
    const Vertex& x = base(i).vertex;
    const float distance = base_->light(i).light.distance_from(x.position);
    return rule_.covers(x.bsdf.roughness(), rule_.turn(light_->apart(i), distance));
}

/// Of the offsets that go on, asks those that have more than delta scatters.
void Shift::ask_for_lobes(LaneMask& asked) {
    for (int m = 0; m < padded(y_->count()); ++m)
        asked[m] = y_->roughness[m] > 0 ? active_[m] : 0;
    fail_others(active_, asked, ShiftOutcome::kind_mismatch);
}

/// Of those asked, keeps the ones that are joined if and only if the base is.
void Shift::keep_alike(bool joined, LaneMask& asked, SightLanes& sight) {
    for (int m = 0; m < padded(y_->count()); ++m) {
        const bool same = joins(m, std::sqrt(sight.distance2[m])) == joined;
        asked[m] = same ? asked[m] : 0;
        sight.valid[m] &= asked[m];
    }
    fail_others(active_, asked, ShiftOutcome::kind_mismatch);
}

/// Says why those asked who are not among the arrived are not; only the first cause counts.
void Shift::fail_others(const LaneMask& asked, const LaneMask& arrived, ShiftOutcome outcome) {
    for (int m = 0; m < y_->count(); ++m) {
        ShiftOutcome& o = (*outcomes_)[m];
        o = (asked[m] != 0) & (arrived[m] == 0) & (o == ShiftOutcome::ok) ? outcome : o;
    }
}

void Shift::fail(int m, ShiftOutcome outcome) {
    if ((*outcomes_)[m] == ShiftOutcome::ok)
        (*outcomes_)[m] = outcome;
}

} // namespace tessera
