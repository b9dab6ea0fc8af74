#include "render/estimator/path_reuse.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/core.h>

namespace tessera {

// The largest tile with the column and row that G-PR adds to it must fit into the lanes.
static_assert((most_tile + 1) * (most_tile + 1) <= most_lanes);

void PathReuse::begin(std::span<const BasePath* const> set, std::span<const float> counts) {
    // Access to lanes is unchecked. Settings limit the size of tiles; this guards sets of other callers.
    if (set.size() > most_lanes)
        throw std::logic_error(
            fmt::format("a sampling set has {} pixels; the limit is {}", set.size(), most_lanes));
    set_ = set;
    counts_ = counts;
    primary_.reset(0);
}

void PathReuse::share(int base, float scale, std::span<Rgb> radiance, ArrivingLight* arriving) {
    const BasePath& path = *set_[base];
    base_ = base;
    is_tried_ = false;
    if (path.empty())
        return;
    radiance[base] += kept_light(path);
    if (scale == 0 && !arriving)
        return;
    light_.reset(path, settings_);
    for (int slot = 0; arriving && slot < std::min(light_.first_shared(), light_.slot_count()); ++slot)
        add_own_arriving(path, slot, 1, base, *arriving);
    if (scale == 0 || light_.last_alive() < light_.first_shared())
        return; // a base path without light is not shifted
    is_tried_ = true;
    paths_.reset(light_.slot_count(), static_cast<int>(set_.size()), arriving != nullptr);
    if (observer_)
        observer_->begins(paths_.offsets(), light_.slot_count());
    settings_.shift == ShiftKind::replay ? replay_to_all(base) : shift_to_all(base);
    settle_outcomes(base);
    balance(base, scale, radiance);
    if (arriving)
        balance_components(base, scale, *arriving);
}

void PathReuse::keep(const BasePath& path, int lane, ArrivingLight& arriving) {
    light_.reset(path, settings_);
    for (int slot = 0; slot <= light_.last_alive(); ++slot)
        add_own_arriving(path, slot, 1, lane, arriving);
}

void PathReuse::shift_to_all(int base) {
    const BasePath& path = *set_[base];
    const int count = static_cast<int>(set_.size());
    if (primary_.count() == 0) {
        primary_.reset(count);
        for (int m = 0; m < count; ++m)
            if (const BasePath& offset = *set_[m]; !offset.empty())
                primary_.set_pixel(m, offset);
    }
    edges_.reset(count);
    shift_.run(path, light_, primary_, base, paths_, edges_, outcomes_);
    edges_.resolve(tracer_, paths_, lost_);
}

/// Random replay: every pixel traces a path with the base's random numbers [Hua 2019, 3.1]. In the space of these
/// numbers the shift is the identity, for each strategy alone: r_m is 1, and c_m is the slot of the offset's own
/// path, with its MIS weights. A slot without light, of base or offset, has r_m = 0.
void PathReuse::replay_to_all(int base) {
    const BasePath& path = *set_[base];
    replayed_scatters_.clear();
    if (paths_.keeps_scatters()) {
        replayed_scatters_.push_back(&paths_.add_first_scatter(light_.emitter_slot(0), light_.hit_slot(0)));
        replayed_scatters_.push_back(&paths_.add_first_scatter(light_.hit_slot(0), light_.slot_count()));
    }
    for (int m = 0; m < paths_.offsets(); ++m) {
        const BasePath& offset = *set_[m];
        outcomes_[m] = offset.empty() ? ShiftOutcome::outside : ShiftOutcome::ok;
        lost_[m] = 0;
        if (m == base || offset.empty())
            continue;
        replay_base_path(tracer_, offset, path.random, light_.vertex_of(light_.last_alive()) + 1, replayed_);
        replayed_light_.reset(replayed_, settings_);
        for (int slot = 0; slot <= std::min(light_.last_alive(), replayed_light_.last_alive()); ++slot)
            if (light_.is_alive(slot))
                paths_.row(slot).set(m, 1, replayed_light_.carried(slot));
        if (paths_.keeps_scatters())
            record_replayed_scatters(m);
        if (observer_)
            notify_of_replay(m);
    }
}

/// Stores the scatters by which the path replayed for pixel m leaves y_1.
void PathReuse::record_replayed_scatters(int m) {
    const BaseVertex& y = replayed_[0];
    const LightSample& l = replayed_.light(0);
    FirstScatter &toward_light = *replayed_scatters_[0], &onward = *replayed_scatters_[1];
    toward_light.direction.set(m, y.vertex.to_world(l.to_light));
    toward_light.f_cos.set(m, l.f_cos);
    onward.direction.set(m, y.vertex.to_world(y.to_next));
    onward.f_cos.set(m, y.is_delta ? Rgb(FirstScatter::infinite) : y.f_cos);
}

/// Reports the path replayed for pixel m to the observer. All Jacobians are 1 in the space of random numbers.
void PathReuse::notify_of_replay(int m) {
    Rgb throughput(1);
    for (int i = 0; i < replayed_.size(); ++i) {
        const BaseVertex& y = replayed_[i];
        observer_->arrives(m, y.vertex);
        const auto end = [&](int slot, float pdf_w, bool is_delta) {
            if (slot <= std::min(light_.last_alive(), replayed_light_.last_alive()) && light_.is_alive(slot))
                observer_->ends(m, slot, {i, pdf_w, is_delta, 1, paths_.ratio(slot, m), paths_.value(slot, m)});
        };
        end(light_.emitter_slot(i), replayed_.light(i).pdf_sum, false);
        if (i + 1 == replayed_.size() && !y.escapes)
            return;
        end(light_.hit_slot(i), y.pdf_w + y.hit_pdf_w, y.is_delta);
        throughput *= y.throughput();
        if (i + 1 < replayed_.size())
            observer_->bounces(m, {i, y.pdf_w, y.is_delta, 1, 1, throughput});
    }
}

/// Determines the outcomes of all shifts and counts them.
void PathReuse::settle_outcomes(int base) {
    for (int m = 0; m < padded(paths_.offsets()); ++m)
        arrived_[m] = 0;
    for (int slot = light_.first_shared(); slot <= light_.last_alive(); ++slot) {
        if (!light_.is_alive(slot))
            continue;
        const OffsetRow& row = paths_.row(slot);
        for (int m = 0; m < padded(paths_.offsets()); ++m)
            arrived_[m] |= row.ratio[m] > 0 ? -1 : 0;
    }
    for (int m = 0; m < paths_.offsets(); ++m) {
        if (m == base)
            continue;
        ShiftOutcome& outcome = outcomes_[m];
        if (arrived_[m])
            outcome = ShiftOutcome::ok;
        else if (lost_[m])
            outcome = ShiftOutcome::occluded;
        else if (outcome == ShiftOutcome::ok)
            outcome = ShiftOutcome::no_light;
        ++tracer_.counters.shifts[static_cast<std::size_t>(outcome)];
    }
}

float PathReuse::ratio_sum(int slot) const {
    const OffsetRow& row = paths_.row(slot);
    float sum = counts_[base_]; // r_k = 1; the lane of the base is 0
    for (int m = 0; m < paths_.offsets(); ++m)
        sum += counts_[m] * row.ratio[m];
    return sum;
}

/// Adds c_m / R of all light paths to the pixels, theory (9) and (20).
void PathReuse::balance(int base, float scale, std::span<Rgb> radiance) const {
    for (int slot = light_.first_shared(); slot <= light_.last_alive(); ++slot) {
        if (!light_.is_alive(slot))
            continue;
        const float factor = weight(slot, scale);
        radiance[base] += light_.carried(slot) * factor;
        const OffsetRow& row = paths_.row(slot);
        for (int m = 0; m < paths_.offsets(); ++m)
            radiance[m] += row.value[m] * factor;
    }
}

/// Adds the arriving light of a slot to the base's own pixel.
void PathReuse::add_own_arriving(const BasePath& path, int slot, float factor, int lane,
                                 ArrivingLight& arriving) const {
    const Rgb carried = light_.carried(slot) * factor;
    if (is_black(carried))
        return;
    const BaseVertex& x = path[0];
    if (slot < light_.hit_slot(0)) {
        const LightSample& l = path.light(0);
        arriving.add(lane, x.vertex.to_world(l.to_light), l.f_cos, carried);
    } else if (!x.is_delta) {
        arriving.add(lane, x.vertex.to_world(x.to_next), x.f_cos, carried);
    }
}

/// Adds the arriving light of all light paths to the pixels. It sums light paths with the same first scatter
/// before it evaluates the basis in their direction.
void PathReuse::balance_components(int base, float scale, ArrivingLight& arriving) {
    const int count = padded(paths_.offsets());
    int index = -1; // of the first scatter whose light is being summed
    const auto flush = [&](int next) {
        if (index >= 0)
            arriving.add(paths_.first_scatter(index), carried_);
        index = next;
        for (int m = 0; m < count; ++m)
            carried_.x[m] = carried_.y[m] = carried_.z[m] = 0;
    };
    flush(-1);
    for (int slot = light_.first_shared(); slot <= light_.last_alive(); ++slot) {
        if (!light_.is_alive(slot))
            continue;
        const float factor = weight(slot, scale);
        add_own_arriving(*set_[base], slot, factor, base, arriving);
        if (paths_.scatter_index(slot) != index)
            flush(paths_.scatter_index(slot));
        if (index < 0)
            continue; // no offset path has this slot
        const OffsetRow& row = paths_.row(slot);
        for (int m = 0; m < count; ++m) {
            carried_.x[m] += row.value.x[m] * factor;
            carried_.y[m] += row.value.y[m] * factor;
            carried_.z[m] += row.value.z[m] * factor;
        }
    }
    flush(-1);
}

} // namespace tessera
