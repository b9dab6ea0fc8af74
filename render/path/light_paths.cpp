#include "render/path/light_paths.h"

namespace tessera {

void LightPaths::reset(const BasePath& path, const ShiftSettings& settings) {
    carried_.clear();
    steps_.clear();
    light_samples_ = path.light_samples();
    join_ = 0;
    last_alive_ = -1;
    first_shared_ = settings.shift == ShiftKind::reconnection ? emitter_slot(1, 0) : 0;
    const bool joins = settings.shift != ShiftKind::replay;
    const float least = least_length(settings, path.pixel_width);
    const int count = path.size();
    Rgb throughput(1);
    for (int i = 0; i < count; ++i) {
        const BaseVertex& v = path[i];
        for (const LightSample& s : path.lights(i))
            carried_.push_back(throughput * s.brings);
        if (i + 1 == count && !v.escapes) {
            carried_.emplace_back(0);
            break;
        }
        throughput *= v.throughput();
        carried_.push_back(throughput * v.hit_brings);
        steps_.push_back({!v.is_delta && is_connectable(v.vertex, settings.shift_threshold),
                          i + 1 < count && is_long(v.vertex.position, path[i + 1].vertex.position, least)});
        if (joins && i > 0 && step_is_connectable(i - 1) && step_is_long(i - 1) && step_is_connectable(i)) {
            join_ = i;
            carried_.push_back(throughput * v.arriving);
            break;
        }
    }
    for (int slot = 0; slot < slot_count(); ++slot)
        if (!is_black(carried(slot)))
            last_alive_ = slot;
}

} // namespace tessera
