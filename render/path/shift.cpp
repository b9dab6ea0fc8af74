#include "render/path/shift.h"

#include "render/path/half_vector.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

namespace tessera {

namespace {

/// What the way from the camera to the current offset vertex has cost: products of ratios, each of them a single
/// number (never products of densities, which underflow).
struct Prefix {
    float density = 1; ///< pdf of the offset with its Jacobians over the base's
    Rgb value{1};      ///< f of the offset with its Jacobians over the base's pdf
};

/// One shift at work: walks the base path and the offset path side by side.
class ShiftWalk {
public:
    ShiftWalk(const Tracer& tracer, const ShiftSettings& settings, const BasePath& base, const LightPaths& light,
              int offset, OffsetPaths& paths, PendingEdges& edges)
        : tracer_(tracer), settings_(settings), base_(base), light_(light), offset_(offset), paths_(paths),
          edges_(edges) {}

    ShiftOutcome run(const Vertex& primary);

private:
    const BaseVertex& base(int i) const { return base_[i]; }
    bool alive_from(int slot) const { return slot <= light_.last_alive(); }
    bool replays() const { return settings_.shift == ShiftKind::replay_reconnection; }
    bool is_connectable(const Vertex& x) const { return tessera::is_connectable(x, settings_.shift_threshold); }
    /// Light samples of a vertex, as slots [first, second).
    std::pair<int, int> emitter_slots(int i) const { return {light_.emitter_slot(i, 0), light_.hit_slot(i)}; }

    void shift_lights(int i, const Vertex& y);
    void connect_light(int i, int sample, const Vertex& y);
    void bounce_to_light(int i, int sample, const Vertex& y);
    void replay_light(int i, int sample, const Vertex& y);
    void end_at_light(int slot, const CopiedScatter& s, glm::vec3 origin, const LightPoint& light,
                      float base_pdf_sum, bool is_delta);
    void set_light_end(int slot, float pdf_w, float jacobian, Rgb f_cos, float base_pdf_sum, Rgb radiance,
                       float light_pdf_w);
    void escape(int i, const Vertex& y);
    void connect_infinity(int i, const Vertex& y);
    bool connect_vertex(int i, const Vertex& y);
    void connect_beyond(int next, glm::vec3 to_previous, const Prefix& joined);
    bool bounce(int i, const Vertex& y, Vertex& next);
    std::optional<CopiedScatter> copy_scatter(int i, const Vertex& y);
    std::optional<CopiedScatter> replay_scatter(int i, const Vertex& y);
    void note(ShiftOutcome outcome) {
        if (outcome_ == ShiftOutcome::ok)
            outcome_ = outcome;
    }

    const Tracer& tracer_;
    const ShiftSettings& settings_;
    const BasePath& base_;
    const LightPaths& light_;
    const int offset_;
    OffsetPaths& paths_;
    PendingEdges& edges_;
    Prefix prefix_;
    ShiftOutcome outcome_ = ShiftOutcome::ok;
};

ShiftOutcome ShiftWalk::run(const Vertex& primary) {
    const Vertex* y = &primary;
    Vertex moved; // y once it is beyond the first bounce
    const int count = base_.size();
    bool lights_are_connected = false; // emitter sampling at x_i went the way y_{i-1} -> x_i
    for (int i = 0; i < count; ++i) {
        if (!lights_are_connected)
            shift_lights(i, *y);
        if (!alive_from(light_.hit_slot(i)))
            break;
        prefix_.value /=
            base(i).survival; // all that ends further on has survived the roulette on path length here
        if (i + 1 == count) {
            escape(i, *y); // what else could carry light there
            break;
        }
        lights_are_connected = false;
        if (light_.step_is_connectable(i)) {
            lights_are_connected = is_connectable(base(i + 1).vertex);
            if (!connect_vertex(i, *y) || light_.join() == i + 1)
                break;
        }
        if (settings_.shift == ShiftKind::reconnection)
            break; // x_1 and x_2 are joined or nothing is
        // What is left for a bounce: emitter sampling at x_{i+1}, unless it is done, and all that ends further on.
        const int next_slot = lights_are_connected ? light_.hit_slot(i + 1) : light_.emitter_slot(i + 1, 0);
        const bool hit_is_left = !light_.step_is_connectable(i) && light_.is_alive(light_.hit_slot(i));
        if (!hit_is_left && !alive_from(next_slot))
            break;
        if (!bounce(i, *y, moved))
            break;
        y = &moved;
    }
    return outcome_;
}

/// The end of a light path at the light, by either strategy: both could have made it, so both count.
void ShiftWalk::set_light_end(int slot, float pdf_w, float jacobian, Rgb f_cos, float base_pdf_sum, Rgb radiance,
                              float light_pdf_w) {
    const float scale = jacobian / base_pdf_sum;
    paths_.set(slot, offset_, prefix_.density * (pdf_w + light_pdf_w) * scale,
               prefix_.value * f_cos * radiance * scale);
}

/// Emitter sampling at x_i.
void ShiftWalk::shift_lights(int i, const Vertex& y) {
    const auto [first, end] = emitter_slots(i);
    if (first < light_.first_shared() || !light_.is_alive(first, end))
        return;
    const bool connectable = is_connectable(base(i).vertex);
    if (y.bsdf.roughness() <= 0 || connectable != is_connectable(y))
        return note(ShiftOutcome::kind_mismatch);
    for (int sample = 0; sample < end - first; ++sample) {
        if (!light_.is_alive(first + sample))
            continue;
        if (connectable)
            connect_light(i, sample, y);
        else if (replays())
            replay_light(i, sample, y);
        else if (base_.lights(i)[static_cast<std::size_t>(sample)].light.can_be_hit())
            bounce_to_light(i, sample, y);
        else // a copied half vector cannot meet a light without extent: that is always joined to
            connect_light(i, sample, y);
    }
}

/// The offset is joined to the same point of the light, at infinity to the same direction.
void ShiftWalk::connect_light(int i, int sample, const Vertex& y) {
    const LightSample& x = base_.lights(i)[static_cast<std::size_t>(sample)];
    const std::optional<LightRay> seen = x.light.seen_from(y.position);
    if (!seen)
        return note(ShiftOutcome::no_light);
    const BsdfValue b = y.bsdf.evaluate(y.to_previous, y.to_local(seen->direction));
    if (is_black(b.f_cos))
        return note(ShiftOutcome::no_light);
    // The pdf of the light's point is the same for all, so the ratio of the solid angles is the inverse of that of
    // the pdfs per solid angle.
    const int slot = light_.emitter_slot(i, sample);
    set_light_end(slot, x.light.can_be_hit() ? b.pdf_w : 0, x.pdf_w / seen->pdf_w, b.f_cos, x.pdf_sum,
                  seen->radiance, seen->pdf_w);
    edges_.add(slot, tracer_.toward_light(y, x.light, seen->direction), offset_, slot, slot + 1);
}

/// At a vertex too glossy to connect, the numbers of the light sample are replayed: as in
/// PathReuse::replay_to_all, the density ratio is 1, and the value the offset's own.
void ShiftWalk::replay_light(int i, int sample, const Vertex& y) {
    LightSample drawn;
    Segment way;
    if (!draw_light(tracer_, y, base_.random, i + 1, sample, drawn, way))
        return note(ShiftOutcome::no_light);
    const int slot = light_.emitter_slot(i, sample);
    paths_.set(slot, offset_, prefix_.density, prefix_.value * drawn.brings);
    edges_.add(slot, way, offset_, slot, slot + 1);
}

/// Emitter sampling at a vertex too glossy to connect: the half vector is copied, and the ray must find a light.
void ShiftWalk::bounce_to_light(int i, int sample, const Vertex& y) {
    const LightSample& x = base_.lights(i)[static_cast<std::size_t>(sample)];
    const std::optional<CopiedScatter> s = copy_half_vector(base(i).vertex, x.to_light, y);
    if (!s)
        return note(ShiftOutcome::no_light);
    Vertex scratch;
    const LightPoint light =
        tracer_.light_along(tracer_.leave(y, y.to_world(s->to_next)), scratch, RayKind::shift_bounce);
    end_at_light(light_.emitter_slot(i, sample), *s, y.position, light, x.pdf_sum, false);
}

/// A scatter done again, from `origin`, that ends the light path at `light`; it fails where that is black.
void ShiftWalk::end_at_light(int slot, const CopiedScatter& s, glm::vec3 origin, const LightPoint& light,
                             float base_pdf_sum, bool is_delta) {
    const std::optional<LightRay> seen = light.seen_from(origin);
    if (!seen || is_black(seen->radiance))
        return note(ShiftOutcome::no_light);
    const float light_pdf_w = is_delta ? 0 : seen->pdf_w;
    // What has been replayed could not have come from emitter sampling: its density ratio is 1, and its value the
    // offset's own.
    const float pdf_sum = replays() ? s.jacobian * (s.pdf_w + light_pdf_w) : base_pdf_sum;
    set_light_end(slot, s.pdf_w, s.jacobian, s.f_cos, pdf_sum, seen->radiance, light_pdf_w);
}

/// The base leaves the scene at its last vertex, x_i, and meets the environment.
void ShiftWalk::escape(int i, const Vertex& y) {
    const BaseVertex& x = base(i);
    if (light_.hit_slot(i) < light_.first_shared())
        return;
    if (light_.step_is_connectable(i))
        return connect_infinity(i, y);
    const std::optional<CopiedScatter> s = copy_scatter(i, y);
    if (!s)
        return;
    Vertex scratch;
    const LightPoint light =
        tracer_.light_along(tracer_.leave(y, y.to_world(s->to_next)), scratch, RayKind::shift_bounce);
    end_at_light(light_.hit_slot(i), *s, y.position, light, x.pdf_w + x.hit_pdf_w, x.is_delta);
}

/// Joins y to the environment: the same direction, so with a Jacobian of 1.
void ShiftWalk::connect_infinity(int i, const Vertex& y) {
    if (!is_connectable(y))
        return note(ShiftOutcome::kind_mismatch);
    const BaseVertex& x = base(i);
    const glm::vec3 direction = x.vertex.to_world(x.to_next);
    const BsdfValue b = y.bsdf.evaluate(y.to_previous, y.to_local(direction));
    if (is_black(b.f_cos))
        return note(ShiftOutcome::no_light);
    const int slot = light_.hit_slot(i);
    const float pdf_sum = x.pdf_w + x.hit_pdf_w;
    set_light_end(slot, b.pdf_w, 1, b.f_cos, pdf_sum, x.hit_brings * (pdf_sum / x.pdf_w), x.hit_pdf_w);
    const LightPoint infinity{LightPoint::Kind::environment, direction, glm::vec3(0), Rgb(0), 0};
    edges_.add(slot, tracer_.toward_light(y, infinity, direction), offset_, slot, slot + 1);
}

/// Joins y to x_{i+1}: for its emission, for emitter sampling there, and beyond it if that is where offsets join.
/// False: nothing can be shifted any more.
bool ShiftWalk::connect_vertex(int i, const Vertex& y) {
    if (!is_connectable(y)) {
        note(ShiftOutcome::kind_mismatch);
        return false;
    }
    const BaseVertex& x = base(i);
    const Vertex& next = base(i + 1).vertex;
    // The slots that go through this edge: a light path that leaves x_{i+1} by a half vector takes another way.
    int end = light_.hit_slot(i) + 1;
    if (light_.join() == i + 1)
        end = light_.tail_slot() + 1;
    else if (is_connectable(next))
        end = light_.hit_slot(i + 1);
    const int first = std::max(light_.hit_slot(i), light_.first_shared());
    if (!light_.is_alive(first, end))
        return true;
    const glm::vec3 d = next.position - y.position;
    const float distance2 = glm::dot(d, d);
    const glm::vec3 direction = d / std::sqrt(distance2);
    const float geometry = std::abs(glm::dot(next.geometric_normal, direction)) / distance2;
    if (!(geometry > 0) || !(distance2 > 0)) {
        note(ShiftOutcome::no_light);
        return true;
    }
    const BsdfValue b = y.bsdf.evaluate(y.to_previous, y.to_local(direction));
    if (is_black(b.f_cos)) {
        note(ShiftOutcome::no_light);
        return true;
    }
    const float jacobian = geometry / x.next_geometry;
    if (first == light_.hit_slot(i) && light_.is_alive(first)) {
        const LightPoint light = tracer_.light_of(next, -direction);
        set_light_end(light_.hit_slot(i), b.pdf_w, jacobian, b.f_cos, x.pdf_w + x.hit_pdf_w, light.radiance,
                      light.pdf / geometry);
    }
    const float scale = jacobian / x.pdf_w;
    const Prefix joined{prefix_.density * b.pdf_w * scale, prefix_.value * b.f_cos * scale};
    connect_beyond(i + 1, next.to_local(-direction), joined);

    edges_.add(first,
               tracer_.between(y.position, y.geometric_normal, next.position, next.geometric_normal, direction),
               offset_, first, end);
    return true;
}

/// The light that comes to x_next, seen from another direction than the base's. Nothing else changes.
void ShiftWalk::connect_beyond(int next, glm::vec3 to_previous, const Prefix& joined) {
    const BaseVertex& x = base(next);
    const Prefix before = std::exchange(prefix_, joined);
    for (int sample = 0; is_connectable(x.vertex) && sample < base_.light_samples(); ++sample) {
        const LightSample& l = base_.lights(next)[static_cast<std::size_t>(sample)];
        const int slot = light_.emitter_slot(next, sample);
        if (!light_.is_alive(slot))
            continue;
        const BsdfValue b = x.vertex.bsdf.evaluate(to_previous, l.to_light);
        if (const std::optional<LightRay> seen = l.light.seen_from(x.vertex.position))
            set_light_end(slot, l.light.can_be_hit() ? b.pdf_w : 0, 1, b.f_cos, l.pdf_sum, seen->radiance,
                          l.pdf_w);
    }
    if (light_.join() == next && alive_from(light_.hit_slot(next))) {
        const BsdfValue b = x.vertex.bsdf.evaluate(to_previous, x.to_next);
        const Rgb value = joined.value * b.f_cos / (x.pdf_w * x.survival);
        // hit_brings is the radiance times pdf_w over the summed pdfs.
        paths_.set(light_.hit_slot(next), offset_,
                   joined.density * (b.pdf_w + x.hit_pdf_w) / (x.pdf_w + x.hit_pdf_w), value * x.hit_brings);
        paths_.set(light_.tail_slot(), offset_, joined.density * b.pdf_w / x.pdf_w, value * x.arriving);
    }
    prefix_ = before;
}

/// The scatter at x_i done again at y with the same random numbers. Both must be of one kind, or one side would
/// connect where the other does not.
std::optional<CopiedScatter> ShiftWalk::replay_scatter(int i, const Vertex& y) {
    const BaseVertex& x = base(i);
    const auto s = y.bsdf.sample(y.to_previous, base_.random.draw(i + 1, Draw::lobe),
                                 base_.random.draw_2d(i + 1, Draw::direction));
    if (!s) {
        note(ShiftOutcome::no_light);
        return {};
    }
    if (s->is_delta != x.is_delta || is_connectable(x.vertex) != is_connectable(y)) {
        note(ShiftOutcome::kind_mismatch);
        return {};
    }
    // In the space of random numbers the shift is the identity, so its Jacobian undoes the ratio of the pdfs.
    return CopiedScatter{s->to_next, s->f_cos, s->pdf_w, x.pdf_w / s->pdf_w};
}

/// The scatter at x_i done again at y: both must be of one kind.
std::optional<CopiedScatter> ShiftWalk::copy_scatter(int i, const Vertex& y) {
    const BaseVertex& x = base(i);
    if (replays())
        return replay_scatter(i, y);
    if (x.is_delta) {
        const std::optional<CopiedScatter> s = copy_delta(x.scatter, y);
        if (!s)
            note(x.scatter == Scatter::transmit && y.bsdf.roughness() <= 0 ? ShiftOutcome::total_reflection
                                                                           : ShiftOutcome::kind_mismatch);
        return s;
    }
    if (y.bsdf.roughness() <= 0 || is_connectable(x.vertex) != is_connectable(y)) {
        note(ShiftOutcome::kind_mismatch);
        return {};
    }
    const std::optional<CopiedScatter> s = copy_half_vector(x.vertex, x.to_next, y);
    if (!s)
        note(ShiftOutcome::no_light);
    return s;
}

/// Copies the scatter at x_i and makes `next` y_{i+1}, what lies there; `next` may be y itself. False: the shift
/// ends.
bool ShiftWalk::bounce(int i, const Vertex& y, Vertex& next) {
    const BaseVertex& x = base(i);
    const std::optional<CopiedScatter> s = copy_scatter(i, y);
    if (!s)
        return false;
    const glm::vec3 direction = y.to_world(s->to_next);
    const glm::vec3 origin = y.position;
    const bool is_inside = tracer_.closest(tracer_.leave(y, direction), next, RayKind::shift_bounce);
    // From a connectable vertex, an emitter is reached by connecting (done before); else by this very ray.
    if (!light_.step_is_connectable(i) && light_.is_alive(light_.hit_slot(i))) {
        const LightPoint met =
            is_inside ? tracer_.light_of(next, -direction) : tracer_.environment_toward(direction);
        end_at_light(light_.hit_slot(i), *s, origin, met, x.pdf_w + x.hit_pdf_w, x.is_delta);
    }
    if (!is_inside) {
        note(ShiftOutcome::outside);
        return false;
    }
    const float scale = s->jacobian / x.pdf_w;
    prefix_ = {prefix_.density * s->pdf_w * scale, prefix_.value * s->f_cos * scale};
    return true;
}

} // namespace

ShiftOutcome shift(const Tracer& tracer, const ShiftSettings& settings, const BasePath& base,
                   const LightPaths& light, const Vertex& primary, int offset, OffsetPaths& paths,
                   PendingEdges& edges) {
    return ShiftWalk(tracer, settings, base, light, offset, paths, edges).run(primary);
}

} // namespace tessera
