#include "render/estimator/path_reuse.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/core.h>

namespace tessera {

// The largest tile, with the column and row that G-PR adds to it.
static_assert((most_tile + 1) * (most_tile + 1) <= most_lanes);

void PathReuse::begin(std::span<const BasePath* const> set) {
    // Lanes are looked up without a check. Settings are checked long before; this is for who assembles sets anew.
    if (set.size() > most_lanes)
        throw std::logic_error(
            fmt::format("a sampling set of {} pixels, where there are lanes for {}", set.size(), most_lanes));
    set_ = set;
    primary_.reset(0);
}

void PathReuse::share(int base, float scale, std::span<Rgb> radiance) {
    const BasePath& path = *set_[static_cast<std::size_t>(base)];
    tried_ = false;
    if (path.empty())
        return;
    radiance[static_cast<std::size_t>(base)] += kept_light(path);
    if (scale == 0)
        return;
    light_.reset(path, settings_);
    if (light_.last_alive() < light_.first_shared())
        return; // where the base carries nothing, no offset can
    tried_ = true;
    paths_.reset(light_.slot_count(), static_cast<int>(set_.size()));
    slot_scale_.assign(static_cast<std::size_t>(light_.slot_count()), 1.0f);
    if (onlooker_)
        onlooker_->begins(paths_.offsets(), light_.slot_count());
    settings_.shift == ShiftKind::replay ? replay_to_all(base) : shift_to_all(base);
    judge(base);
    balance(base, scale, radiance);
}

void PathReuse::shift_to_all(int base) {
    const BasePath& path = *set_[static_cast<std::size_t>(base)];
    const int count = static_cast<int>(set_.size());
    if (primary_.count() == 0) {
        primary_.reset(count);
        for (int m = 0; m < count; ++m)
            if (const BasePath& offset = *set_[static_cast<std::size_t>(m)]; !offset.empty())
                primary_.set_pixel(m, offset);
    }
    edges_.reset(count);
    shift_.run(path, light_, primary_, base, paths_, edges_, outcomes_);
    if (weight_threshold_ > 0)
        play_weight_roulette(path.random);
    edges_.resolve(tracer_, paths_, slot_scale_, lost_);
}

/// Random replay: every pixel takes the base's numbers all the way. In the space of these numbers the shift is the
/// identity, whatever strategy a light path ends by: its ratio is 1 and its value that of the offset's own path,
/// with the MIS weights there [Hua 2019, 3.1]. A light path that brings nothing has ratio 0, for base and offset
/// alike.
void PathReuse::replay_to_all(int base) {
    const BasePath& path = *set_[static_cast<std::size_t>(base)];
    for (int m = 0; m < paths_.offsets(); ++m) {
        const BasePath& offset = *set_[static_cast<std::size_t>(m)];
        outcomes_[m] = offset.empty() ? ShiftOutcome::outside : ShiftOutcome::ok;
        lost_[m] = 0;
        if (m == base || offset.empty())
            continue;
        replay_base_path(tracer_, offset[0].vertex, path.random, light_.vertex_of(light_.last_alive()) + 1,
                         replayed_);
        replayed_light_.reset(replayed_, settings_);
        for (int slot = 0; slot <= std::min(light_.last_alive(), replayed_light_.last_alive()); ++slot)
            if (light_.is_alive(slot))
                paths_.row(slot).set(m, 1, replayed_light_.carried(slot));
        if (onlooker_)
            tell_of_replay(m);
    }
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
        for (int sample = 0; sample < replayed_.light_samples(); ++sample)
            end(light_.emitter_slot(i, sample), replayed_.lights(i)[static_cast<std::size_t>(sample)].pdf_sum,
                false);
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
        if (!is_shared(slot))
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
    float sum = 1; // the base itself: its ratio is one by definition
    for (int m = 0; m < paths_.offsets(); ++m)
        sum += row.ratio[m];
    return sum;
}

/// Before visibility is known, 1/R is a lower bound of the weight. It only decides on a probability, so that the
/// estimator stays unbiased whatever becomes of the edges.
void PathReuse::play_weight_roulette(const Random& random) {
    const float even = static_cast<float>(paths_.offsets());
    for (int slot = light_.first_shared(); slot < light_.slot_count(); ++slot) {
        if (!light_.is_alive(slot)) {
            slot_scale_[static_cast<std::size_t>(slot)] = 0;
            continue;
        }
        // Not below 0.1: should most edges turn out to be blocked, 1/q would not be made up for by 1/R.
        const float q = std::max(even / (ratio_sum(slot) * weight_threshold_), 0.1f);
        if (q >= 1)
            continue;
        const bool survives = random.draw(slot, Draw::weight_survival) < q;
        slot_scale_[static_cast<std::size_t>(slot)] = survives ? 1 / q : 0;
        tracer_.counters.skipped_light_paths += !survives;
    }
}

void PathReuse::balance(int base, float scale, std::span<Rgb> radiance) const {
    for (int slot = light_.first_shared(); slot <= light_.last_alive(); ++slot) {
        if (!is_shared(slot))
            continue;
        const float factor = weight(slot, scale);
        radiance[static_cast<std::size_t>(base)] += light_.carried(slot) * factor;
        const OffsetRow& row = paths_.row(slot);
        for (int m = 0; m < paths_.offsets(); ++m)
            radiance[static_cast<std::size_t>(m)] += row.value[m] * factor;
    }
}

} // namespace tessera
