#include "render/estimator/path_reuse.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/core.h>

namespace tessera {

// The largest tile, with the column and row that G-PR adds to it.
static_assert((most_tile + 1) * (most_tile + 1) <= most_lanes);

void PathReuse::begin(std::span<const BasePath* const> set, std::span<const float> counts) {
    // Lanes are looked up without a check. Settings are checked long before; this is for who assembles sets anew.
    if (set.size() > most_lanes)
        throw std::logic_error(
            fmt::format("a sampling set of {} pixels, where there are lanes for {}", set.size(), most_lanes));
    set_ = set;
    counts_ = counts;
    primary_.reset(0);
}

void PathReuse::share(int base, float scale, std::span<Rgb> radiance, ArrivingLight* arriving) {
    const BasePath& path = *set_[base];
    base_ = base;
    tried_ = false;
    if (path.empty())
        return;
    radiance[base] += kept_light(path);
    if (scale == 0 && !arriving)
        return;
    light_.reset(path, settings_);
    for (int slot = 0; arriving && slot < std::min(light_.first_shared(), light_.slot_count()); ++slot)
        add_own(path, slot, 1, base, *arriving);
    if (scale == 0 || light_.last_alive() < light_.first_shared())
        return; // where the base carries nothing, no offset can
    tried_ = true;
    paths_.reset(light_.slot_count(), static_cast<int>(set_.size()), arriving != nullptr);
    if (onlooker_)
        onlooker_->begins(paths_.offsets(), light_.slot_count());
    settings_.shift == ShiftKind::replay ? replay_to_all(base) : shift_to_all(base);
    judge(base);
    balance(base, scale, radiance);
    if (arriving)
        balance_parts(base, scale, *arriving);
}

void PathReuse::keep(const BasePath& path, int lane, ArrivingLight& arriving) {
    light_.reset(path, settings_);
    for (int slot = 0; slot <= light_.last_alive(); ++slot)
        add_own(path, slot, 1, lane, arriving);
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

/// Random replay: every pixel takes the base's numbers all the way. In the space of these numbers the shift is the
/// identity, whatever strategy a light path ends by: its ratio is 1 and its value that of the offset's own path,
/// with the MIS weights there [Hua 2019, 3.1]. A light path that brings nothing has ratio 0, for base and offset
/// alike.
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
            keep_scatters_of_replay(m);
        if (onlooker_)
            tell_of_replay(m);
    }
}

/// How the path that was replayed for pixel m leaves y_1.
void PathReuse::keep_scatters_of_replay(int m) {
    const BaseVertex& y = replayed_[0];
    const LightSample& l = replayed_.light(0);
    FirstScatter &toward_light = *replayed_scatters_[0], &onward = *replayed_scatters_[1];
    toward_light.direction.set(m, y.vertex.to_world(l.to_light));
    toward_light.f_cos.set(m, l.f_cos);
    onward.direction.set(m, y.vertex.to_world(y.to_next));
    onward.f_cos.set(m, y.is_delta ? Rgb(FirstScatter::infinite) : y.f_cos);
}

/// Tells the onlooker of the path that was replayed for pixel m. In the space of random numbers all Jacobians
/// are 1.
void PathReuse::tell_of_replay(int m) {
    Rgb throughput(1);
    for (int i = 0; i < replayed_.size(); ++i) {
        const BaseVertex& y = replayed_[i];
        onlooker_->arrives(m, y.vertex);
        const auto end = [&](int slot, float pdf_w, bool is_delta) {
            if (slot <= std::min(light_.last_alive(), replayed_light_.last_alive()) && light_.is_alive(slot))
                onlooker_->ends(m, slot, {i, pdf_w, is_delta, 1, paths_.ratio(slot, m), paths_.value(slot, m)});
        };
        end(light_.emitter_slot(i), replayed_.light(i).pdf_sum, false);
        if (i + 1 == replayed_.size() && !y.escapes)
            return;
        end(light_.hit_slot(i), y.pdf_w + y.hit_pdf_w, y.is_delta);
        throughput *= y.throughput();
        if (i + 1 < replayed_.size())
            onlooker_->bounces(m, {i, y.pdf_w, y.is_delta, 1, 1, throughput});
    }
}

/// Settles the outcomes of all shifts and counts them.
void PathReuse::judge(int base) {
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
    float sum = counts_[base_]; // the base itself: its ratio is one by definition
    for (int m = 0; m < paths_.offsets(); ++m)
        sum += counts_[m] * row.ratio[m];
    return sum;
}

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

/// What a slot of a base path brings to its own pixel, in parts.
void PathReuse::add_own(const BasePath& path, int slot, float factor, int lane, ArrivingLight& arriving) const {
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

/// Light paths through the same first scatter are summed before they are looked at by direction.
void PathReuse::balance_parts(int base, float scale, ArrivingLight& arriving) {
    const int count = padded(paths_.offsets());
    int index = -1; // of the scatter whose light is summed
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
        add_own(*set_[base], slot, factor, base, arriving);
        if (paths_.scatter_index(slot) != index)
            flush(paths_.scatter_index(slot));
        if (index < 0)
            continue; // no offset has such a path
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
