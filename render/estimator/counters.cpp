#include "render/estimator/counters.h"

#include <algorithm>
#include <cstddef>

#include <fmt/core.h>

namespace tessera {

std::string_view to_string(ShiftOutcome outcome) {
    constexpr std::string_view names[] = {"ok",      "occluded", "kind_mismatch", "total_reflection",
                                          "outside", "no_light"};
    static_assert(std::size(names) == shift_outcome_count);
    return names[static_cast<int>(outcome)];
}

std::string_view to_string(RayKind kind) {
    constexpr std::string_view names[] = {"camera", "bounce", "light", "shift_bounce", "shift_edge"};
    static_assert(std::size(names) == ray_kind_count);
    return names[static_cast<int>(kind)];
}

void FirstRefused::add(const RefusedSample& sample) {
    const auto end = samples_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto at = std::lower_bound(samples_.begin(), end, sample);
    if (at == samples_.end() || (at != end && *at == sample))
        return;
    std::move_backward(at, count_ < most ? end : end - 1, count_ < most ? end + 1 : end);
    *at = sample;
    count_ = std::min(count_ + 1, most);
}

void Counters::refuse(const RefusedSample& sample) {
    ++refused_samples;
    first_refused.add(sample);
}

std::string refused_text(const Counters& counters, std::uint64_t seed) {
    if (counters.first_refused.list().empty())
        return {};
    const RefusedSample& first = counters.first_refused.list().front();
    return fmt::format(
        "{} samples were not finite and were left out; the first is pass {}, pixel ({}, {}), seed {}",
        counters.refused_samples, first.pass, first.x, first.y, seed);
}

Counters& Counters::operator+=(const Counters& other) {
    camera_paths += other.camera_paths;
    path_vertices += other.path_vertices;
    for (std::size_t i = 0; i < rays.size(); ++i)
        rays[i] += other.rays[i];
    dark_paths += other.dark_paths;
    skipped_paths += other.skipped_paths;
    reused_paths += other.reused_paths;
    skipped_light_paths += other.skipped_light_paths;
    for (std::size_t i = 0; i < shifts.size(); ++i)
        shifts[i] += other.shifts[i];
    refused_samples += other.refused_samples;
    for (const RefusedSample& sample : other.first_refused.list())
        first_refused.add(sample);
    return *this;
}

} // namespace tessera
