// Shift: connections of offset paths to a vertex of the base path, or to its lights.
#include "render/paths/shift.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace tessera {

/// Stores the scatter by which the light paths of the slots [first_slot, end_slot) leave y_1.
void Shift::record_first_scatter(int i, int first_slot, int end_slot, const Vec3Lanes& direction,
                                 const BsdfLanes& bsdf) {
    if (i > 0 || !paths_->keeps_scatters())
        return;
    FirstScatter& scatter = paths_->add_first_scatter(first_slot, end_slot);
    for (int m = 0; m < padded(y_->count()); ++m) {
        scatter.direction.set(m, direction[m]);
        scatter.f_cos.set(m, bsdf.f_cos[m]);
    }
}

/// Connects the offsets to the light sample of x_i: the same point, or the same direction at infinity.
/// @param connectable  the base's own edge is connectable, theory (17)
void Shift::connect_light(int i, bool connectable) {
    const LightSample& x = base_->light(i);
    const int slot = light_->emitter_slot(i);
    LightConnection& c = light_connection_;
    connect_to_light(*y_, c.eligible, x.light, c.sight, c.arriving);
    // A copied half vector cannot hit a light without extent, so base and offset connect to it in any case.
    if (replays() || x.light.can_be_hit())
        keep_alike(connectable, c.eligible, c.sight);
    y_->evaluate(c.sight.direction, c.sight.valid, c.bsdf);
    record_first_scatter(i, slot, slot + 1, c.sight.direction, c.bsdf);
    OffsetRow& row = paths_->row(slot);
    EdgeGroup& edges = edges_->add(slot, slot + 1);
    const float bsdf_counts = x.light.can_be_hit() ? 1 : 0, share = x.fixed_pdf_w / x.pdf_sum;
    const FloatLanes& fixed_pdf_w = c.arriving.fixed_pdf_w(x.light);
    for (int m = 0; m < padded(y_->count()); ++m) {
        const float pdf_sum = c.bsdf.pdf_w[m] * bsdf_counts + c.arriving.pdf_w[m];
        // J, the quotient of solid angles, is the inverse quotient of the densities that are fixed on the light.
        // `scale` is J / P_k, and the row is theory (6) and (7).
        const float scale = share / fixed_pdf_w[m];
        const float ratio = c.sight.valid[m] ? prefix_.ratio[m] * pdf_sum * scale : 0.0f;
        row.set(m, ratio,
                {prefix_.value.x[m] * c.bsdf.f_cos.x[m] * c.arriving.radiance.x[m] * scale,
                 prefix_.value.y[m] * c.bsdf.f_cos.y[m] * c.arriving.radiance.y[m] * scale,
                 prefix_.value.z[m] * c.bsdf.f_cos.z[m] * c.arriving.radiance.z[m] * scale});
        edges.exists[m] = row.ratio[m] > 0 ? -1 : 0;
    }
    notify(edges.exists, [&](int m) {
        observer_->ends(m, slot,
                        last_step(slot, m, c.bsdf.pdf_w[m] * bsdf_counts + c.arriving.pdf_w[m],
                                  x.fixed_pdf_w / fixed_pdf_w[m]));
    });
    edges_to_light(tracer_, *y_, c.sight.direction, x.light, edges.segments);
    record_failures(c.eligible, edges.exists, ShiftOutcome::no_light);
}

/// Connects the offsets to the environment where the base hits it: the same direction, with J = 1.
void Shift::connect_infinity(int i) {
    const BaseVertex& x = base(i);
    const int slot = light_->hit_slot(i);
    const LightPoint infinity{LightPoint::Kind::environment, x.vertex.to_world(x.to_next), glm::vec3(0), Rgb(0),
                              0};
    LightConnection& c = light_connection_;
    select_lobes(c.eligible);
    for (int m = 0; m < padded(y_->count()); ++m) {
        c.sight.direction.set(m, infinity.position);
        c.sight.distance2[m] = std::numeric_limits<float>::infinity();
        c.sight.valid[m] = c.eligible[m];
    }
    keep_alike(true, c.eligible, c.sight);
    y_->evaluate(c.sight.direction, c.eligible, c.bsdf);
    record_first_scatter(i, slot, slot + 1, c.sight.direction, c.bsdf);
    OffsetRow& row = paths_->row(slot);
    EdgeGroup& edges = edges_->add(slot, slot + 1);
    for (int m = 0; m < padded(y_->count()); ++m) {
        // hit_contribution / pdf_w is the radiance over the summed pdfs of this step.
        const float ratio = prefix_.ratio[m] * (c.bsdf.pdf_w[m] + x.hit_pdf_w) / (x.pdf_w + x.hit_pdf_w);
        row.set(m, c.eligible[m] ? ratio : 0.0f,
                prefix_.value[m] * c.bsdf.f_cos[m] * x.hit_contribution / x.pdf_w);
        edges.exists[m] = row.ratio[m] > 0 ? -1 : 0;
    }
    notify(edges.exists,
           [&](int m) { observer_->ends(m, slot, last_step(slot, m, c.bsdf.pdf_w[m] + x.hit_pdf_w, 1)); });
    edges_to_light(tracer_, *y_, c.sight.direction, infinity, edges.segments);
    record_failures(c.eligible, edges.exists, ShiftOutcome::no_light);
}

/// Connects the offsets to x_{i+1}: for its emission; if the step joins, for its light sample; and if x_{i+1} is
/// the join, for all light beyond it.
void Shift::connect_next(int i) {
    // The slots through this edge. Light paths that leave x_{i+1} by a copied half vector do not use it.
    const int hit = light_->hit_slot(i), first = std::max(hit, light_->first_shared());
    int end = hit + 1;
    if (light_->join() == i + 1)
        end = light_->tail_slot() + 1;
    else if (light_->step_joins(i))
        end = light_->hit_slot(i + 1);
    if (!light_->is_alive(first, end))
        return;
    EdgeGroup& edges = edges_->add(first, end);
    const VertexConnection& connection = connect_vertex(i, edges);
    record_first_scatter(i, first, end, connection.sight.direction, connection.bsdf);
    if (first == hit && light_->is_alive(first))
        shift_hit(connection);
    if (light_->step_joins(i))
        shift_light_beyond(connection);
    if (light_->join() == i + 1 && light_->last_alive() >= light_->hit_slot(i + 1))
        shift_tail(connection);
    record_failures(connection.eligible, connection.lit, ShiftOutcome::no_light);
    if (end > hit + 1)
        record_failures(connection.lit, connection.reached, ShiftOutcome::kind_mismatch);
}

/// Computes the edges y_i -> x_{i+1}, without visibility, and the factors of r_m and c_m through them.
const VertexConnection& Shift::connect_vertex(int i, EdgeGroup& edges) {
    const BaseVertex& x = base(i);
    const Vertex& next = base(i + 1).vertex;
    VertexConnection& c = vertex_connection_;
    c.vertex = i;
    select_lobes(c.eligible);
    connect_to_point(*y_, c.eligible, next.position, next.geometric_normal, false, c.sight);
    keep_alike(true, c.eligible, c.sight);
    y_->evaluate(c.sight.direction, c.sight.valid, c.bsdf);
    const float roughness = next.bsdf.roughness();
    for (int m = 0; m < padded(y_->count()); ++m) {
        const float jacobian = c.sight.geometry[m] / x.next_geometry; // theory (14)
        const float scale = jacobian / x.pdf_w;
        const bool is_lit = (c.bsdf.f_cos.x[m] > 0) | (c.bsdf.f_cos.y[m] > 0) | (c.bsdf.f_cos.z[m] > 0);
        c.lit[m] = is_lit ? c.sight.valid[m] : 0;
        const bool reaches = rule_.reaches_beyond(roughness, apart_[m], std::sqrt(c.sight.distance2[m]));
        c.reached[m] = reaches ? c.lit[m] : 0;
        c.prefix.ratio[m] = c.reached[m] ? prefix_.ratio[m] * c.bsdf.pdf_w[m] * scale : 0.0f;
        c.prefix.value.x[m] = prefix_.value.x[m] * c.bsdf.f_cos.x[m] * scale;
        c.prefix.value.y[m] = prefix_.value.y[m] * c.bsdf.f_cos.y[m] * scale;
        c.prefix.value.z[m] = prefix_.value.z[m] * c.bsdf.f_cos.z[m] * scale;
        c.to_previous.set(m, next.to_local(-c.sight.direction[m]));
        edges.exists[m] = c.lit[m];
    }
    edges_to_point(tracer_, *y_, c.sight.direction, next.position, next.geometric_normal, edges.segments);
    notify(c.reached, [&](int m) {
        observer_->joins(m, {i, c.bsdf.pdf_w[m], false, c.sight.geometry[m] / x.next_geometry, c.prefix.ratio[m],
                             c.prefix.value[m]});
    });
    return c;
}

/// Shifts the light path that ends at the emission of x_{i+1}. P has the pdfs of both strategies there.
void Shift::shift_hit(const VertexConnection& c) {
    const BaseVertex& x = base(c.vertex);
    const Vertex& next = base(c.vertex + 1).vertex;
    const int slot = light_->hit_slot(c.vertex);
    const LightPoint front = next.light_toward(next.geometric_normal);
    const glm::vec3 normal = next.geometric_normal;
    const Vec3Lanes& direction = c.sight.direction;
    OffsetRow& row = paths_->row(slot);
    const bool is_ball = front.kind == LightPoint::Kind::ball;
    if (is_ball)
        ball_pdfs(*y_, front, ball_pdf_w_);
    const auto emitter_pdf_w = [&](int m) { return is_ball ? ball_pdf_w_[m] : front.pdf / c.sight.geometry[m]; };
    for (int m = 0; m < padded(y_->count()); ++m) {
        const bool faces = direction.x[m] * normal.x + direction.y[m] * normal.y + direction.z[m] * normal.z < 0;
        // J / P_k; the prefix of the connection has only the pdf of BSDF sampling.
        const float scale = c.sight.geometry[m] / (x.next_geometry * (x.pdf_w + x.hit_pdf_w));
        const float ratio = prefix_.ratio[m] * (c.bsdf.pdf_w[m] + emitter_pdf_w(m)) * scale;
        row.set(m, faces && c.lit[m] ? ratio : 0.0f, prefix_.value[m] * c.bsdf.f_cos[m] * front.radiance * scale);
    }
    notify(c.lit, [&](int m) {
        observer_->ends(
            m, slot,
            last_step(slot, m, c.bsdf.pdf_w[m] + emitter_pdf_w(m), c.sight.geometry[m] / x.next_geometry));
    });
}

/// Shifts the light sample of x_{i+1} through the new edge. Only the direction to the previous vertex differs
/// there.
void Shift::shift_light_beyond(const VertexConnection& c) {
    const int next = c.vertex + 1, slot = light_->emitter_slot(next), count = y_->count();
    if (!light_->is_alive(slot))
        return;
    const Vertex& x = base(next).vertex;
    const LightSample& l = base_->light(next);
    const std::optional<LightRay> seen = l.light.seen_from(x.position);
    if (!seen)
        return;
    evaluate(x, c.to_previous, l.to_light, c.reached, count, beyond_);
    const float bsdf_counts = l.light.can_be_hit() ? 1 : 0, scale = 1 / l.pdf_sum;
    OffsetRow& row = paths_->row(slot);
    for (int m = 0; m < padded(count); ++m)
        row.set(m, c.prefix.ratio[m] * (beyond_.pdf_w[m] * bsdf_counts + l.pdf_w) * scale,
                c.prefix.value[m] * beyond_.f_cos[m] * seen->radiance * scale);
    notify(c.reached, [&](int m) {
        observer_->ends_beyond(m, slot, last_step(slot, m, beyond_.pdf_w[m] * bsdf_counts + l.pdf_w, 1));
    });
}

/// Shifts all that BSDF sampling finds beyond the join, x_{i+1}: the emitter that it hits, and the tail, whose
/// light paths have the same r_m and c_m / c_k.
void Shift::shift_tail(const VertexConnection& c) {
    const BaseVertex& x = base(c.vertex + 1);
    const int count = y_->count(), hit_slot = light_->hit_slot(c.vertex + 1), tail_slot = light_->tail_slot();
    evaluate(x.vertex, c.to_previous, x.to_next, c.reached, count, beyond_);
    OffsetRow &hit = paths_->row(hit_slot), &tail = paths_->row(tail_slot);
    const float scale = 1 / (x.pdf_w * x.survival), hit_scale = 1 / (x.pdf_w + x.hit_pdf_w);
    for (int m = 0; m < padded(count); ++m) {
        const Rgb value = c.prefix.value[m] * beyond_.f_cos[m] * scale;
        // hit_contribution / pdf_w is the radiance over the summed pdfs of this step.
        hit.set(m, c.prefix.ratio[m] * (beyond_.pdf_w[m] + x.hit_pdf_w) * hit_scale, value * x.hit_contribution);
        tail.set(m, c.prefix.ratio[m] * beyond_.pdf_w[m] / x.pdf_w, value * x.arriving);
    }
    notify(c.reached, [&](int m) {
        observer_->ends_beyond(m, hit_slot, last_step(hit_slot, m, beyond_.pdf_w[m] + x.hit_pdf_w, 1));
        OffsetStep last = last_step(hit_slot, m, beyond_.pdf_w[m], 1);
        last.ratio = tail.ratio[m];
        last.value = tail.value[m];
        observer_->ends_beyond(m, tail_slot, last);
    });
}

} // namespace tessera
