// Shift: scatterings done again at an offset vertex, by the same half vector or the same random numbers.
#include "render/paths/shift.h"

#include <glm/geometric.hpp>

namespace tessera {

namespace {

bool are_both_mirrors_or_neither(const Vertex& x, const Vertex& y) {
    return x.bsdf.is_mirror() == y.bsdf.is_mirror();
}

} // namespace

/// What is done again now, lane by lane, is how the light paths of some slots leave y_1.
void Shift::ask_for_scatter(int i, int first_slot, int end_slot) {
    bounced_ = i == 0 && paths_->keeps_scatters() ? &paths_->add_first_scatter(first_slot, end_slot) : nullptr;
}

void Shift::keep_bounce(int m, const CopiedScatter& s, bool is_delta) {
    if (!bounced_)
        return;
    bounced_->direction.set(m, (*y_)[m].to_world(s.to_next));
    bounced_->f_cos.set(m, is_delta ? Rgb(FirstScatter::infinite) : s.f_cos);
}

/// Does the scatter at x_i again in all lanes that go on, and makes y_{i+1} what lies there. False: none is left.
bool Shift::bounce(int i) {
    const int count = y_->count();
    ask_for_scatter(i, light_->hit_slot(i), light_->slot_count());
    moved_vertices_.resize(static_cast<std::size_t>(count));
    met_.resize(static_cast<std::size_t>(count));
    bool any = false;
    for (int m = 0; m < count; ++m) {
        active_[m] = active_[m] && bounce(i, m) ? -1 : 0;
        any = any || active_[m];
    }
    moved_.reset(count);
    for (int m = 0; m < count; ++m)
        if (active_[m])
            moved_.set(m, *met_[m]);
    y_ = &moved_;
    tell_of(active_, [&](int m) { onlooker_->arrives(m, moved_[m]); });
    return any;
}

/// What y_i meets in the direction of the scatter at hand, perhaps in the place of y_i itself; null: nothing.
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

bool Shift::bounce(int i, int m) {
    const BaseVertex& x = base(i);
    const std::optional<CopiedScatter> s = copy_scatter(i, m);
    if (!s)
        return false;
    keep_bounce(m, *s, x.is_delta);
    const Vertex& y = (*y_)[m];
    const glm::vec3 direction = y.to_world(s->to_next);
    const glm::vec3 origin = y.position;
    const Vertex* next = met_[m] = meet(i, m, direction);
    // By a connectable step, an emitter is reached by connecting (done before); else by this very ray.
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
    if (onlooker_)
        onlooker_->bounces(m, {i, s->pdf_w, x.is_delta, s->jacobian, prefix_.ratio[m], prefix_.value[m]});
    return true;
}

/// The base leaves the scene from x_i, by a scatter that no connection makes: so must the offset.
void Shift::bounce_out(int i, int m) {
    const BaseVertex& x = base(i);
    const Vertex& y = (*y_)[m];
    const std::optional<CopiedScatter> s = copy_scatter(i, m);
    if (!s)
        return;
    keep_bounce(m, *s, x.is_delta);
    Vertex scratch;
    const LightPoint light =
        tracer_.light_along(tracer_.leave(y, y.to_world(s->to_next)), scratch, RayKind::shift_bounce,
                            tracer_.lookup(tracer_.width_beyond(own_width_[m], 0, x.is_delta)));
    end_at_light(light_->hit_slot(i), m, *s, y.position, light, x.pdf_w + x.hit_pdf_w, x.is_delta);
}

/// Emitter sampling at a vertex too glossy to connect: the half vector is copied, and the ray must find a light.
void Shift::bounce_to_light(int i, int m) {
    const Vertex& y = (*y_)[m];
    const LightSample& x = base_->light(i);
    const std::optional<CopiedScatter> s = copy_half_vector(base(i).vertex, x.to_light, y);
    if (!s)
        return fail(m, ShiftOutcome::no_light);
    keep_bounce(m, *s, false);
    Vertex scratch;
    const LightPoint light = tracer_.light_along(tracer_.leave(y, y.to_world(s->to_next)), scratch,
                                                 RayKind::shift_bounce, tracer_.lookup());
    end_at_light(light_->emitter_slot(i), m, *s, y.position, light, x.pdf_sum, false);
}

/// At a vertex too glossy to connect, the numbers of the light sample are replayed: as in
/// PathReuse::replay_to_all, the ratio of densities is 1, and the value the offset's own.
void Shift::replay_light(int i, int m, EdgeGroup& edges) {
    LightSample drawn;
    Segment way;
    if (!draw_light(tracer_, (*y_)[m], base_->random, i + 1, drawn, way))
        return fail(m, ShiftOutcome::no_light);
    if (joins(m, drawn.light.distance_from((*y_)[m].position)))
        return fail(m, ShiftOutcome::kind_mismatch);
    complete_light(tracer_, drawn);
    const int slot = light_->emitter_slot(i);
    paths_->row(slot).set(m, prefix_.ratio[m], prefix_.value[m] * drawn.brings);
    keep_bounce(m, {drawn.to_light, drawn.f_cos, drawn.pdf_w, 1}, false);
    if (onlooker_)
        onlooker_->ends(m, slot, last_step(slot, m, drawn.pdf_sum, base_->light(i).pdf_sum / drawn.pdf_sum));
    edges.exists[m] = -1;
    edges.segments.from.set(m, way.from);
    edges.segments.to.set(m, way.to);
}

/// A scatter done again, from `origin`, that ends the light path at `light`; it fails where that is black.
void Shift::end_at_light(int slot, int m, const CopiedScatter& s, glm::vec3 origin, const LightPoint& light,
                         float base_pdf_sum, bool is_delta) {
    const std::optional<LightRay> seen = light.seen_from(origin);
    if (!seen || is_black(seen->radiance))
        return fail(m, ShiftOutcome::no_light);
    if (!is_delta && joins(m, light.distance_from(origin)))
        return fail(m, ShiftOutcome::kind_mismatch); // and so the way back would be another one
    const float pdf_sum = s.pdf_w + (is_delta ? 0 : seen->pdf_w);
    // What is replayed keeps its strategy: its ratio of densities is 1, and the weight of the strategy is that at
    // the offset.
    const float scale = replays() ? 1 / pdf_sum : s.jacobian / base_pdf_sum;
    paths_->row(slot).set(m, prefix_.ratio[m] * pdf_sum * scale,
                          prefix_.value[m] * s.f_cos * seen->radiance * scale);
    if (onlooker_)
        onlooker_->ends(m, slot, last_step(slot, m, pdf_sum, scale * base_pdf_sum, is_delta));
}

/// Whether the way back would be this one, after a scatter by a lobe: both edges are joined for the light that
/// lies at their ends, or neither is; and both are not for light from beyond though there might be some, or
/// neither. (That both are not would not do: from glass beside smooth plastic one comes to edges that are
/// joined and to edges that are not, between which there is no way, and the weights of the three would not add up
/// to 1.)
bool Shift::is_joined_alike(int i, int m, float distance, const Vertex& next) const {
    const bool is_connectable = joins(m, distance);
    if (is_connectable != light_->step_is_connectable(i))
        return false;
    const float roughness = next.bsdf.roughness();
    const bool misses = roughness > 0 && !rule_.reaches_beyond(roughness, apart_[m], distance);
    return !is_connectable || misses == (base(i + 1).vertex.bsdf.roughness() > 0 && !light_->step_joins(i));
}

/// Whether a scatter at y by a lobe can turn out to be joined if and only if the base's is.
bool Shift::may_be_alike(int i, int m) const {
    const float roughness = y_->roughness[m];
    return light_->step_is_connectable(i) ? !rule_.covers_none(roughness) : !rule_.covers_all(roughness);
}

/// The scatter at x_i done again at y: both must be of one kind, or y at least must have such a delta part (from
/// glass to smooth plastic, and back; a mirror stays a mirror, or what is very direct light to one pixel would
/// come to another by a light path).
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
    if (y.bsdf.roughness() <= 0 || !may_be_alike(i, m)) {
        fail(m, ShiftOutcome::kind_mismatch);
        return {};
    }
    const std::optional<CopiedScatter> s = copy_half_vector(x.vertex, x.to_next, y);
    if (!s)
        fail(m, ShiftOutcome::no_light);
    return s;
}

/// The scatter at x_i done again at y with the same random numbers. Both must be of one kind, or one side would
/// connect where the other does not.
std::optional<CopiedScatter> Shift::replay_scatter(int i, int m) {
    const BaseVertex& x = base(i);
    const Vertex& y = (*y_)[m];
    const auto s = y.sample(base_->random.draw(i + 1, Draw::lobe), base_->random.draw_2d(i + 1, Draw::direction));
    if (!s) {
        fail(m, ShiftOutcome::no_light);
        return {};
    }
    if (s->is_delta != x.is_delta ||
        !(x.is_delta ? are_both_mirrors_or_neither(x.vertex, y) : may_be_alike(i, m))) {
        fail(m, ShiftOutcome::kind_mismatch);
        return {};
    }
    // In the space of random numbers the shift is the identity, so its Jacobian undoes the ratio of the pdfs.
    return CopiedScatter{s->to_next, s->f_cos, s->pdf_w, x.pdf_w / s->pdf_w};
}

} // namespace tessera
