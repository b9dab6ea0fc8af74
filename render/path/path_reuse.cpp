#include "render/path/path_reuse.h"

namespace tessera {

void PathReuse::share(std::span<const BasePath* const> set, int base, float scale, std::span<Rgb> radiance) {
    const BasePath& path = *set[static_cast<std::size_t>(base)];
    if (path.empty())
        return;
    light_.reset(path, threshold_);
    if (light_.last_alive() < 0)
        return; // where the base carries nothing, no offset can
    paths_.reset(light_.slot_count(), static_cast<int>(set.size()));
    shift_to_all(set, base);
    balance(base, scale, radiance);
}

void PathReuse::shift_to_all(std::span<const BasePath* const> set, int base) {
    const BasePath& path = *set[static_cast<std::size_t>(base)];
    edges_.reset(light_.slot_count());
    outcomes_.assign(set.size(), ShiftOutcome::ok);
    blocked_.assign(set.size(), 0);
    for (int m = 0; m < static_cast<int>(set.size()); ++m) {
        const BasePath& offset = *set[static_cast<std::size_t>(m)];
        if (m == base)
            continue;
        outcomes_[static_cast<std::size_t>(m)] =
            offset.empty() ? ShiftOutcome::outside
                           : shift(tracer_, threshold_, path, light_, offset[0].vertex, m, paths_, edges_);
    }
    edges_.resolve(tracer_, paths_, blocked_);

    for (int m = 0; m < static_cast<int>(set.size()); ++m) {
        if (m == base)
            continue;
        ShiftOutcome outcome = outcomes_[static_cast<std::size_t>(m)];
        bool arrived = false;
        for (int slot = 0; slot <= light_.last_alive(); ++slot)
            arrived = arrived || paths_.density(slot, m) > 0;
        if (arrived)
            outcome = ShiftOutcome::ok;
        else if (blocked_[static_cast<std::size_t>(m)])
            outcome = ShiftOutcome::occluded;
        else if (outcome == ShiftOutcome::ok)
            outcome = ShiftOutcome::no_light;
        ++tracer_.counters.shifts[static_cast<std::size_t>(outcome)];
    }
}

void PathReuse::balance(int base, float scale, std::span<Rgb> radiance) const {
    const int offsets = paths_.offsets();
    for (int slot = 0; slot <= light_.last_alive(); ++slot) {
        if (!light_.is_alive(slot))
            continue;
        float sum = 1; // the base itself: its ratio is one by definition
        for (int m = 0; m < offsets; ++m)
            sum += paths_.density(slot, m);
        const float weight = scale / sum;
        radiance[static_cast<std::size_t>(base)] += light_.carried(slot) * weight;
        for (int m = 0; m < offsets; ++m)
            radiance[static_cast<std::size_t>(m)] += paths_.value(slot, m) * weight;
    }
}

} // namespace tessera
