#include "render/film/counters.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include <fmt/core.h>

namespace tessera {

std::string_view to_string(ShiftOutcome outcome) {
    constexpr std::string_view names[] = {"ok",      "occluded", "kind_mismatch", "total_reflection",
                                          "outside", "no_light"};
    static_assert(std::size(names) == shift_outcome_count);
    return names[static_cast<int>(outcome)];
}

std::string_view to_string(RayKind kind) {
    constexpr std::string_view names[] = {"camera", "feature", "bounce", "light", "shift_bounce", "shift_edge"};
    static_assert(std::size(names) == ray_kind_count);
    return names[static_cast<int>(kind)];
}

void FirstInvalid::add(const InvalidSample& sample) {
    const auto end = samples_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto at = std::lower_bound(samples_.begin(), end, sample);
    if (at == samples_.end() || (at != end && *at == sample))
        return;
    std::move_backward(at, count_ < most ? end : end - 1, count_ < most ? end + 1 : end);
    *at = sample;
    count_ = std::min(count_ + 1, most);
}

void Counters::refuse(const InvalidSample& sample) {
    ++invalid_samples;
    first_invalid.add(sample);
}

std::string invalid_text(const Counters& counters, std::uint64_t seed) {
    if (counters.first_invalid.list().empty())
        return {};
    const InvalidSample& first = counters.first_invalid.list().front();
    return fmt::format(
        "{} samples were not finite and were left out; the first is pass {}, pixel ({}, {}), seed {}",
        counters.invalid_samples, first.pass, first.x, first.y, seed);
}

Counters& Counters::operator+=(const Counters& other) {
    camera_paths += other.camera_paths;
    path_vertices += other.path_vertices;
    for (std::size_t i = 0; i < rays.size(); ++i)
        rays[i] += other.rays[i];
    remembered += other.remembered;
    dark_paths += other.dark_paths;
    skipped_paths += other.skipped_paths;
    reused_paths += other.reused_paths;
    for (std::size_t i = 0; i < shifts.size(); ++i)
        shifts[i] += other.shifts[i];
    invalid_samples += other.invalid_samples;
    for (const InvalidSample& sample : other.first_invalid.list())
        first_invalid.add(sample);
    return *this;
}

namespace {

/// Returns `part` over `whole`, in [0, 1]; 0 if both are 0.
float fraction_of(std::uint32_t part, std::uint32_t whole) {
    return static_cast<float>(part) / static_cast<float>(std::max(whole, 1u));
}

template <class NumberOf>
Image<float> map_of(const Image<ReuseCounts>& counts, NumberOf number_of) {
    Image<float> map(counts.width(), counts.height());
    std::transform(counts.begin(), counts.end(), map.begin(), number_of);
    return map;
}

} // namespace

std::uint32_t ReuseCounts::tried() const {
    return std::accumulate(shifts.begin(), shifts.end(), std::uint32_t{0});
}

void ReuseCounts::operator+=(const ReuseCounts& other) {
    for (std::size_t i = 0; i < shifts.size(); ++i)
        shifts[i] += other.shifts[i];
    reused += other.reused;
    skipped += other.skipped;
}

Image<float> ReuseMaps::reused() const {
    const auto n = static_cast<float>(std::max(passes, 1));
    return map_of(counts, [n](const ReuseCounts& c) { return static_cast<float>(c.arrived()) / n; });
}

Image<float> ReuseMaps::share(ShiftOutcome outcome) const {
    const auto i = static_cast<std::size_t>(outcome);
    return map_of(counts, [i](const ReuseCounts& c) { return fraction_of(c.shifts[i], c.tried()); });
}

Image<float> ReuseMaps::failed() const {
    return map_of(counts, [](const ReuseCounts& c) { return fraction_of(c.failed(), c.tried()); });
}

Image<float> ReuseMaps::survival() const {
    return map_of(counts, [](const ReuseCounts& c) { return fraction_of(c.reused, c.reused + c.skipped); });
}

} // namespace tessera
