#include "render/method/counters.h"

namespace tessera {

std::string_view to_string(ShiftOutcome outcome) {
    constexpr std::string_view names[] = {"ok",      "occluded", "kind_mismatch", "total_reflection",
                                          "outside", "no_light"};
    static_assert(std::size(names) == shift_outcome_count);
    return names[static_cast<int>(outcome)];
}

Counters& Counters::operator+=(const Counters& other) {
    camera_paths += other.camera_paths;
    path_vertices += other.path_vertices;
    closest_hit_rays += other.closest_hit_rays;
    occlusion_rays += other.occlusion_rays;
    reusable_paths += other.reusable_paths;
    skipped_paths += other.skipped_paths;
    refused_samples += other.refused_samples;
    for (int i = 0; i < shift_outcome_count; ++i)
        shifts[static_cast<std::size_t>(i)] += other.shifts[static_cast<std::size_t>(i)];
    return *this;
}

} // namespace tessera
