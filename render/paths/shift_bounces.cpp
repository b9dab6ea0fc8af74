// Shift: scatters that are repeated at an offset vertex, with the same half vector or the same random numbers.
#include "render/paths/shift.h"

#include <glm/geometric.hpp>

namespace tessera {

namespace {

bool are_both_mirrors_or_neither(const Vertex& x, const Vertex& y) {
    return x.bsdf.is_mirror() == y.bsdf.is_mirror();
}

} // namespace

/// Prepares the first scatter of the slots [first_slot, end_slot), which record_bounce() fills in lane by lane.
void Shift::begin_first_scatter(int i, int first_slot, int end_slot) {
    first_scatter_ =
        i == 0 && paths_->keeps_scatters() ? &paths_->add_first_scatter(first_slot, end_slot) : nullptr;
}

void Shift::record_bounce(int m, const CopiedScatter& s, bool is_delta) {
    if (!first_scatter_)
        return;
    first_scatter_->direction.set(m, (*y_)[m].to_world(s.to_next));
    first_scatter_->f_cos.set(m, is_delta ? Rgb(FirstScatter::infinite) : s.f_cos);
}

/// Repeats the scatter at x_i in all active lanes, and continues with the vertices y_{i+1} that it finds. Returns
/// false if no lane stays active.
bool Shift::bounce(int i) {
    const int count = y_->count();
    begin_first_scatter(i, light_->hit_slot(i), light_->slot_count());
    moved_vertices_.resize(static_cast<std::size_t>(count));
    next_vertices_.resize(static_cast<std::size_t>(count));
    bool any = false;
    for (int m = 0; m < count; ++m) {
        active_[m] = active_[m] && bounce(i, m) ? -1 : 0;
        any = any || active_[m];
    }
    moved_.reset(count);
    for (int m = 0; m < count; ++m)
        if (active_[m])
            moved_.set(m, *next_vertices_[m]);
    y_ = &moved_;
    notify(active_, [&](int m) { observer_->arrives(m, moved_[m]); });
    return any;
}

/// Returns the vertex that y_i sees in a direction; null: none. It may overwrite y_i.
const Vertex* Shift::meet(int i, int m, glm::vec3 direction) {
    const BaseVertex& x = base(i);
    const auto trace = [&](Vertex& next) {
        return tracer_.closest(
            tracer_.leave((*y_)[m], direction), next, RayKind::shift_bounce,
            tracer_.lookup(tracer_.width_beyond(own_width_[m], 0, x.is_delta), base_->mirrors > i));
    };
    if (i == 0 && x.is_delta) {
        bool is_new = false;
        const Vertex* next = primary_->beyond(m, x.scatter, direction, [&](Vertex& v) {
            is_new = true;
            return trace(v);
        });
        tracer_.counters.remembered += !is_new;
        return next;
    }
    Vertex& next = moved_vertices_[m];
    return trace(next) ? &next : nullptr;
}

/// Repeats the scatter at x_i in one lane. Returns false if the offset path ends.
bool Shift::bounce(int i, int m) {
    const BaseVertex& x = base(i);
    const std::optional<CopiedScatter> s = copy_scatter(i, m);
    if (!s)
        return false;
    record_bounce(m, *s, x.is_delta);
    const Vertex& y = (*y_)[m];
    const glm::vec3 direction = y.to_world(s->to_next);
    const glm::vec3 origin = y.position;
    const Vertex* next = next_vertices_[m] = meet(i, m, direction);
    // If the step is connectable, connect_next() has already shifted the hit of an emitter. Else this ray does.
    if (!light_->step_is_connectable(i) && light_->is_alive(light_->hit_slot(i))) {
        const LightPoint met = next ? next->light_toward(-direction) : tracer_.environment_toward(direction);
        end_at_light(light_->hit_slot(i), m, *s, origin, met, x.pdf_w + x.hit_pdf_w, x.is_delta);
    }
    if (!next) {
        fail(m, ShiftOutcome::outside);
        return false;
    }
    const float distance = glm::distance(origin, next->position);
    if (!x.is_delta && !is_joined_alike(i, m, distance, *next)) {
        fail(m, ShiftOutcome::kind_mismatch);
        return false;
    }
    apart_[m] = rule_.apart(apart_[m], distance);
    own_width_[m] = tracer_.width_beyond(own_width_[m], distance, x.is_delta);
    const float scale = s->jacobian / x.pdf_w;
    prefix_.ratio[m] *= s->pdf_w * scale;
    prefix_.value.set(m, prefix_.value[m] * s->f_cos * scale);
    if (observer_)
        observer_->bounces(m, {i, s->pdf_w, x.is_delta, s->jacobian, prefix_.ratio[m], prefix_.value[m]});
    return true;
}

/// Shifts the hit of the environment by a step that is not connectable: the offset's ray must find it, too.
void Shift::bounce_out(int i, int m) {
    const BaseVertex& x = base(i);
    const Vertex& y = (*y_)[m];
    const std::optional<CopiedScatter> s = copy_scatter(i, m);
    if (!s)
        return;
    record_bounce(m, *s, x.is_delta);
    Vertex scratch;
    const LightPoint light =
        tracer_.light_along(tracer_.leave(y, y.to_world(s->to_next)), scratch, RayKind::shift_bounce,
                            tracer_.lookup(tracer_.width_beyond(own_width_[m], 0, x.is_delta)));
    end_at_light(light_->hit_slot(i), m, *s, y.position, light, x.pdf_w + x.hit_pdf_w, x.is_delta);
}

/// Shifts a light sample at a vertex too glossy to connect: copies the half vector, and the ray must hit a light.
void Shift::bounce_to_light(int i, int m) {
    const Vertex& y = (*y_)[m];
    const LightSample& x = base_->light(i);
    const std::optional<CopiedScatter> s = copy_half_vector(base(i).vertex, x.to_light, y);
    if (!s)
        return fail(m, ShiftOutcome::no_light);
    record_bounce(m, *s, false);
    Vertex scratch;
    const LightPoint light = tracer_.light_along(tracer_.leave(y, y.to_world(s->to_next)), scratch,
                                                 RayKind::shift_bounce, tracer_.lookup());
    end_at_light(light_->emitter_slot(i), m, *s, y.position, light, x.pdf_sum, false);
}

/// Shifts a light sample by random replay, because the vertex is too glossy to connect. As in
/// PathReuse::replay_to_all(), the quotient of densities is 1. The value is the light sample that the same random
/// numbers draw at the offset.
void Shift::replay_light(int i, int m, EdgeGroup& edges) {
    LightSample drawn;
    Segment way;
    if (!draw_light(tracer_, (*y_)[m], base_->random, i + 1, drawn, way))
        return fail(m, ShiftOutcome::no_light);
    if (is_connectable(m, drawn.light.distance_from((*y_)[m].position)))
        return fail(m, ShiftOutcome::kind_mismatch);
    complete_light(tracer_, drawn);
    const int slot = light_->emitter_slot(i);
    paths_->row(slot).set(m, prefix_.ratio[m], prefix_.value[m] * drawn.brings);
    record_bounce(m, {drawn.to_light, drawn.f_cos, drawn.pdf_w, 1}, false);
    if (observer_)
        observer_->ends(m, slot, last_step(slot, m, drawn.pdf_sum, base_->light(i).pdf_sum / drawn.pdf_sum));
    edges.exists[m] = -1;
    edges.segments.from.set(m, way.from);
    edges.segments.to.set(m, way.to);
}

/// Ends a light path at `light` after the scatter `s` at `origin`, theory (6) and (7). Fails if no light arrives,
/// or if the inverse shift would connect.
/// @param base_pdf_sum  pdf of the base's last step, summed over strategies
void Shift::end_at_light(int slot, int m, const CopiedScatter& s, glm::vec3 origin, const LightPoint& light,
                         float base_pdf_sum, bool is_delta) {
    const std::optional<LightRay> seen = light.seen_from(origin);
    if (!seen || is_black(seen->radiance))
        return fail(m, ShiftOutcome::no_light);
    if (!is_delta && is_connectable(m, light.distance_from(origin)))
        return fail(m, ShiftOutcome::kind_mismatch); // the inverse shift would connect
    const float pdf_sum = s.pdf_w + (is_delta ? 0 : seen->pdf_w);
    // Random replay keeps the strategy: its quotient of densities is 1, and the MIS weight is the offset's.
    const float scale = replays() ? 1 / pdf_sum : s.jacobian / base_pdf_sum;
    paths_->row(slot).set(m, prefix_.ratio[m] * pdf_sum * scale,
                          prefix_.value[m] * s.f_cos * seen->radiance * scale);
    if (observer_)
        observer_->ends(m, slot, last_step(slot, m, pdf_sum, scale * base_pdf_sum, is_delta));
}

/// Returns whether the inverse shift would bounce here as well, after a scatter by a lobe. Base and offset must
/// agree on two facts: whether the step is connectable; and, if so, whether light from beyond is left out
/// although the next vertex has a lobe. To compare whether both steps join is not enough. Glass next to smooth
/// plastic bounces both to edges that join and to edges that do not, and these cannot be shifted to each other,
/// so the weights of three such pixels would not add up to 1.
bool Shift::is_joined_alike(int i, int m, float distance, const Vertex& next) const {
    const bool connectable = is_connectable(m, distance);
    if (connectable != light_->step_is_connectable(i))
        return false;
    const float roughness = next.bsdf.roughness();
    const bool misses = roughness > 0 && !rule_.reaches_beyond(roughness, apart_[m], distance);
    return !connectable || misses == (base(i + 1).vertex.bsdf.roughness() > 0 && !light_->step_joins(i));
}

/// Returns false if no edge length makes a step from y_i by a lobe as connectable as the base's. It saves rays.
bool Shift::may_agree(int i, int m) const {
    const float roughness = y_->roughness[m];
    return light_->step_is_connectable(i) ? !rule_.covers_none(roughness) : !rule_.covers_all(roughness);
}

/// Repeats the scatter at x_i at y_i. After a delta scatter y_i must have a delta part of that kind, as with
/// glass and smooth plastic. A mirror maps to mirrors only, because light behind mirrors is directly visible
/// emission, which is not part of the light paths.
std::optional<CopiedScatter> Shift::copy_scatter(int i, int m) {
    if (replays())
        return replay_scatter(i, m);
    const BaseVertex& x = base(i);
    const Vertex& y = (*y_)[m];
    if (x.is_delta) {
        const std::optional<CopiedScatter> s =
            are_both_mirrors_or_neither(x.vertex, y) ? copy_delta(x.scatter, y) : std::nullopt;
        if (!s)
            fail(m, x.scatter == Scatter::transmit && y.bsdf.roughness() <= 0 && !y.bsdf.is_mirror()
                        ? ShiftOutcome::total_reflection
                        : ShiftOutcome::kind_mismatch);
        return s;
    }
    if (y.bsdf.roughness() <= 0 || !may_agree(i, m)) {
        fail(m, ShiftOutcome::kind_mismatch);
        return {};
    }
    const std::optional<CopiedScatter> s = copy_half_vector(x.vertex, x.to_next, y);
    if (!s)
        fail(m, ShiftOutcome::no_light);
    return s;
}

/// Repeats the scatter at x_i at y_i with the same random numbers. Both must be delta scatters or neither, and
/// agree on connectability.
std::optional<CopiedScatter> Shift::replay_scatter(int i, int m) {
    const BaseVertex& x = base(i);
    const Vertex& y = (*y_)[m];
    const auto s = y.sample(base_->random.draw(i + 1, Draw::lobe), base_->random.draw_2d(i + 1, Draw::direction));
    if (!s) {
        fail(m, ShiftOutcome::no_light);
        return {};
    }
    if (s->is_delta != x.is_delta || !(x.is_delta ? are_both_mirrors_or_neither(x.vertex, y) : may_agree(i, m))) {
        fail(m, ShiftOutcome::kind_mismatch);
        return {};
    }
    // The shift is the identity in the space of random numbers, so J is the inverse quotient of the pdfs.
    return CopiedScatter{s->to_next, s->f_cos, s->pdf_w, x.pdf_w / s->pdf_w};
}

} // namespace tessera
