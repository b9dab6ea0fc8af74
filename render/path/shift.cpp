#include "render/path/shift.h"

#include "render/path/half_vector.h"

#include <utility>

#include <glm/geometric.hpp>

namespace tessera {

void OffsetPaths::reset(int slots, int offsets) {
    offsets_ = offsets;
    const std::size_t count = static_cast<std::size_t>(slots) * static_cast<std::size_t>(offsets);
    density_.assign(count, 0.0f);
    value_.assign(count, Rgb(0));
}

void PendingEdges::reset(int groups) {
    if (groups_.size() < static_cast<std::size_t>(groups))
        groups_.resize(static_cast<std::size_t>(groups));
    used_ = groups;
    for (int g = 0; g < groups; ++g) {
        groups_[static_cast<std::size_t>(g)].segments.clear();
        groups_[static_cast<std::size_t>(g)].offsets.clear();
    }
}

void PendingEdges::add(int group, const Segment& segment, int offset, int first_slot, int end_slot) {
    Group& g = groups_[static_cast<std::size_t>(group)];
    g.segments.push_back(segment);
    g.offsets.push_back(offset);
    g.first_slot = first_slot;
    g.end_slot = end_slot;
}

void PendingEdges::resolve(const Tracer& tracer, OffsetPaths& paths, std::vector<std::uint8_t>& blocked) {
    for (int i = 0; i < used_; ++i) {
        const Group& g = groups_[static_cast<std::size_t>(i)];
        hidden_.resize(g.segments.size());
        tracer.occluded(g.segments, hidden_.data());
        for (std::size_t e = 0; e < g.segments.size(); ++e) {
            if (!hidden_[e])
                continue;
            blocked[static_cast<std::size_t>(g.offsets[e])] = 1;
            for (int slot = g.first_slot; slot < g.end_slot; ++slot)
                paths.fail(slot, g.offsets[e]);
        }
    }
}

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
    ShiftWalk(const Tracer& tracer, float threshold, const BasePath& base, const LightPaths& light, int offset,
              OffsetPaths& paths, PendingEdges& edges)
        : tracer_(tracer), threshold_(threshold), base_(base), light_(light), offset_(offset), paths_(paths),
          edges_(edges) {}

    ShiftOutcome run(const Vertex& primary);

private:
    const BaseVertex& base(int i) const { return base_[i]; }
    bool alive_from(int slot) const { return slot <= light_.last_alive(); }
    bool alive_within(int first, int end) const {
        while (first < end && !light_.is_alive(first))
            ++first;
        return first < end;
    }

    void shift_light(int i, const Vertex& y);
    void connect_light(int i, const Vertex& y);
    void bounce_to_light(int i, const Vertex& y);
    void end_at_light(int slot, const CopiedScatter& s, glm::vec3 origin, const LightPoint& light,
                      float base_pdf_sum, bool is_delta);
    void set_light_end(int slot, float pdf_w, float jacobian, Rgb f_cos, float base_pdf_sum, Rgb radiance,
                       float light_pdf_w);
    void escape(int i, const Vertex& y);
    void connect_infinity(int i, const Vertex& y);
    bool connect_vertex(int i, const Vertex& y);
    void connect_beyond(int next, glm::vec3 to_previous, const Prefix& prefix);
    bool bounce(int i, const Vertex& y, Vertex& next);
    std::optional<CopiedScatter> copy_scatter(int i, const Vertex& y);
    void note(ShiftOutcome outcome) {
        if (outcome_ == ShiftOutcome::ok)
            outcome_ = outcome;
    }

    const Tracer& tracer_;
    const float threshold_;
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
    bool light_is_connected = false; // emitter sampling at x_i went the way y_{i-1} -> x_i
    for (int i = 0; i < count; ++i) {
        if (light_.is_alive(LightPaths::emitter_slot(i)) && !light_is_connected)
            shift_light(i, *y);
        if (!alive_from(LightPaths::hit_slot(i)))
            break;
        if (i + 1 == count) {
            escape(i, *y); // what else could carry light there
            break;
        }
        light_is_connected = false;
        if (light_.step_is_connectable(i)) {
            light_is_connected = is_connectable(base(i + 1).vertex, threshold_);
            if (!connect_vertex(i, *y) || light_.join() == i + 1)
                break;
        }
        // What is left for a bounce: emitter sampling at x_{i+1}, unless it is done, and all that ends further on.
        const int next_slot = light_is_connected ? LightPaths::hit_slot(i + 1) : LightPaths::emitter_slot(i + 1);
        const bool hit_is_left = !light_.step_is_connectable(i) && light_.is_alive(LightPaths::hit_slot(i));
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

void ShiftWalk::shift_light(int i, const Vertex& y) {
    const bool connectable = is_connectable(base(i).vertex, threshold_);
    if (y.bsdf.roughness() <= 0 || connectable != is_connectable(y, threshold_))
        return note(ShiftOutcome::kind_mismatch);
    // A copied half vector cannot meet a light without extent: that is always joined to.
    connectable || !base(i).light.can_be_hit() ? connect_light(i, y) : bounce_to_light(i, y);
}

/// Emitter sampling at x_i: the offset is joined to the same point of the light, at infinity to the same
/// direction.
void ShiftWalk::connect_light(int i, const Vertex& y) {
    const BaseVertex& x = base(i);
    const std::optional<LightRay> seen = x.light.seen_from(y.position);
    if (!seen)
        return note(ShiftOutcome::no_light);
    const BsdfValue b = y.bsdf.evaluate(y.to_previous, y.to_local(seen->direction));
    if (is_black(b.f_cos))
        return note(ShiftOutcome::no_light);
    // The pdf of the light's point is the same for all, so the ratio of the solid angles is the inverse of that of
    // the pdfs per solid angle.
    const int slot = LightPaths::emitter_slot(i);
    set_light_end(slot, x.light.can_be_hit() ? b.pdf_w : 0, x.light_pdf_w / seen->pdf_w, b.f_cos, x.light_pdf_sum,
                  seen->radiance, seen->pdf_w);
    edges_.add(slot, tracer_.toward_light(y, x.light, seen->direction), offset_, slot, slot + 1);
}

/// Emitter sampling at a vertex too glossy to connect: the half vector is copied, and the ray must find a light.
void ShiftWalk::bounce_to_light(int i, const Vertex& y) {
    const BaseVertex& x = base(i);
    const std::optional<CopiedScatter> s = copy_half_vector(x.vertex, x.to_light, y);
    if (!s)
        return note(ShiftOutcome::no_light);
    Vertex scratch;
    const LightPoint light = tracer_.light_along(tracer_.leave(y, y.to_world(s->to_next)), scratch);
    end_at_light(LightPaths::emitter_slot(i), *s, y.position, light, x.light_pdf_sum, false);
}

/// A copied scatter, from `origin`, that ends the light path at `light`; it fails where that is black.
void ShiftWalk::end_at_light(int slot, const CopiedScatter& s, glm::vec3 origin, const LightPoint& light,
                             float base_pdf_sum, bool is_delta) {
    const std::optional<LightRay> seen = light.seen_from(origin);
    if (!seen || is_black(seen->radiance))
        return note(ShiftOutcome::no_light);
    set_light_end(slot, s.pdf_w, s.jacobian, s.f_cos, base_pdf_sum, seen->radiance, is_delta ? 0 : seen->pdf_w);
}

/// The base leaves the scene at its last vertex, x_i, and meets the environment.
void ShiftWalk::escape(int i, const Vertex& y) {
    const BaseVertex& x = base(i);
    if (light_.step_is_connectable(i))
        return connect_infinity(i, y);
    const std::optional<CopiedScatter> s = copy_scatter(i, y);
    if (!s)
        return;
    Vertex scratch;
    const LightPoint light = tracer_.light_along(tracer_.leave(y, y.to_world(s->to_next)), scratch);
    end_at_light(LightPaths::hit_slot(i), *s, y.position, light, x.pdf_w + x.hit_pdf_w, x.is_delta);
}

/// Joins y to the environment: the same direction, so with a Jacobian of 1.
void ShiftWalk::connect_infinity(int i, const Vertex& y) {
    if (!is_connectable(y, threshold_))
        return note(ShiftOutcome::kind_mismatch);
    const BaseVertex& x = base(i);
    const glm::vec3 direction = x.vertex.to_world(x.to_next);
    const BsdfValue b = y.bsdf.evaluate(y.to_previous, y.to_local(direction));
    if (is_black(b.f_cos))
        return note(ShiftOutcome::no_light);
    const int slot = LightPaths::hit_slot(i);
    const float pdf_sum = x.pdf_w + x.hit_pdf_w;
    set_light_end(slot, b.pdf_w, 1, b.f_cos, pdf_sum, x.hit_brings * (pdf_sum / x.pdf_w), x.hit_pdf_w);
    const LightPoint infinity{LightPoint::Kind::environment, direction, glm::vec3(0), Rgb(0), 0};
    edges_.add(slot, tracer_.toward_light(y, infinity, direction), offset_, slot, slot + 1);
}

/// Joins y to x_{i+1}: for its emission, for emitter sampling there, and beyond it if that is where offsets join.
/// False: nothing can be shifted any more.
bool ShiftWalk::connect_vertex(int i, const Vertex& y) {
    if (!is_connectable(y, threshold_)) {
        note(ShiftOutcome::kind_mismatch);
        return false;
    }
    const BaseVertex& x = base(i);
    const Vertex& next = base(i + 1).vertex;
    // The slots that go through this edge: a light path that leaves x_{i+1} by a half vector takes another way.
    int end = LightPaths::hit_slot(i) + 1;
    if (light_.join() == i + 1)
        end = light_.tail_slot() + 1;
    else if (is_connectable(next, threshold_))
        end = LightPaths::emitter_slot(i + 1) + 1;
    if (!alive_within(LightPaths::hit_slot(i), end))
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
    if (light_.is_alive(LightPaths::hit_slot(i))) {
        const LightPoint light = next.light_toward(-direction);
        set_light_end(LightPaths::hit_slot(i), b.pdf_w, jacobian, b.f_cos, x.pdf_w + x.hit_pdf_w, light.radiance,
                      light.pdf / geometry);
    }
    const float scale = jacobian / x.pdf_w;
    const Prefix joined{prefix_.density * b.pdf_w * scale, prefix_.value * b.f_cos * scale};
    connect_beyond(i + 1, next.to_local(-direction), joined);

    edges_.add(LightPaths::hit_slot(i),
               tracer_.between(y.position, y.geometric_normal, next.position, next.geometric_normal, direction),
               offset_, LightPaths::hit_slot(i), end);
    return true;
}

/// The light that comes to x_next, seen from another direction than the base's. Nothing else changes.
void ShiftWalk::connect_beyond(int next, glm::vec3 to_previous, const Prefix& joined) {
    const BaseVertex& x = base(next);
    const Prefix before = std::exchange(prefix_, joined);
    if (light_.is_alive(LightPaths::emitter_slot(next)) && is_connectable(x.vertex, threshold_)) {
        const BsdfValue b = x.vertex.bsdf.evaluate(to_previous, x.to_light);
        if (const std::optional<LightRay> seen = x.light.seen_from(x.vertex.position))
            set_light_end(LightPaths::emitter_slot(next), x.light.can_be_hit() ? b.pdf_w : 0, 1, b.f_cos,
                          x.light_pdf_sum, seen->radiance, x.light_pdf_w);
    }
    if (light_.join() == next && alive_from(LightPaths::hit_slot(next))) {
        const BsdfValue b = x.vertex.bsdf.evaluate(to_previous, x.to_next);
        if (light_.is_alive(LightPaths::hit_slot(next))) {
            const float scale = 1 / x.pdf_w; // hit_brings is the radiance times pdf_w over the summed pdfs
            paths_.set(LightPaths::hit_slot(next), offset_,
                       joined.density * (b.pdf_w + x.hit_pdf_w) / (x.pdf_w + x.hit_pdf_w),
                       joined.value * b.f_cos * x.hit_brings * scale);
        }
        paths_.set(light_.tail_slot(), offset_, joined.density * b.pdf_w / x.pdf_w,
                   joined.value * b.f_cos * x.arriving / x.pdf_w);
    }
    prefix_ = before;
}

/// The scatter at x_i done again at y: both must be of one kind.
std::optional<CopiedScatter> ShiftWalk::copy_scatter(int i, const Vertex& y) {
    const BaseVertex& x = base(i);
    if (x.is_delta) {
        const std::optional<CopiedScatter> s = copy_delta(x.scatter, y);
        if (!s)
            note(x.scatter == Scatter::transmit && y.bsdf.roughness() <= 0 ? ShiftOutcome::total_reflection
                                                                           : ShiftOutcome::kind_mismatch);
        return s;
    }
    if (y.bsdf.roughness() <= 0 || is_connectable(x.vertex, threshold_) != is_connectable(y, threshold_)) {
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
    const bool is_inside = tracer_.closest(tracer_.leave(y, direction), next);
    // From a connectable vertex, an emitter is reached by connecting (done before); else by this very ray.
    if (!light_.step_is_connectable(i) && light_.is_alive(LightPaths::hit_slot(i))) {
        const LightPoint met =
            is_inside ? next.light_toward(-direction) : tracer_.scene.lights().environment_toward(direction);
        end_at_light(LightPaths::hit_slot(i), *s, origin, met, x.pdf_w + x.hit_pdf_w, x.is_delta);
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

ShiftOutcome shift(const Tracer& tracer, float threshold, const BasePath& base, const LightPaths& light,
                   const Vertex& primary, int offset, OffsetPaths& paths, PendingEdges& edges) {
    return ShiftWalk(tracer, threshold, base, light, offset, paths, edges).run(primary);
}

} // namespace tessera
