#include "render/sampling/pixel_filter.h"

#include "recon/enumeration.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace tessera {

namespace {

constexpr int cells = 1024; // of the table, from -radius to radius

float gaussian(float x, float deviation, float radius) {
    const auto bell = [=](float d) { return std::exp(-d * d / (2 * deviation * deviation)); };
    return std::max(0.0f, bell(x) - bell(radius));
}

/// Returns the piecewise cubic of Mitchell and Netravali [Mitchell 1988, eq. 8].
float cubic(float x, float b, float c) {
    const float x2 = x * x, x3 = x2 * x;
    if (x < 1)
        return ((12 - 9 * b - 6 * c) * x3 + (-18 + 12 * b + 6 * c) * x2 + (6 - 2 * b)) / 6;
    return ((-b - 6 * c) * x3 + (6 * b + 30 * c) * x2 + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6;
}

/// Returns the Lanczos filter whose window has the radius.
float windowed_sinc(float x, float radius) {
    if (x < 1e-4f)
        return 1;
    const float a = std::numbers::pi_v<float> * x, w = a / radius;
    return std::sin(a) * std::sin(w) / (a * w);
}

constexpr std::string_view names[] = {"box", "tent", "gaussian", "mitchell", "catmullrom", "lanczos", "scene"};

/// Integrals of |f| and f over its support, by the midpoint rule: filters can jump at the ends of their support.
struct Integrals {
    std::vector<double> absolute{0}; ///< up to each node
    double whole = 0;                ///< of f

    explicit Integrals(const PixelFilter& filter) {
        const float width = 2 * filter.radius / cells;
        for (int i = 0; i < cells; ++i) {
            const double middle = filter.value((static_cast<float>(i) + 0.5f) * width - filter.radius);
            absolute.push_back(absolute.back() + std::abs(middle));
            whole += middle;
        }
    }
};

} // namespace

std::string_view to_string(FilterKind kind) {
    return entry_of(names, kind);
}

std::optional<FilterKind> filter_kind_from_name(std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == std::end(names) || *found == to_string(FilterKind::scene))
        return {};
    return static_cast<FilterKind>(found - std::begin(names));
}

bool PixelFilter::is_valid() const {
    constexpr float widest = 16;
    if (!(radius > 0 && radius <= widest) || (kind == FilterKind::gaussian && !(first > 0)))
        return false;
    const Integrals sums(*this);
    return sums.whole > 0.01 * sums.absolute.back(); // also false for NaN
}

float PixelFilter::value(float x) const {
    x = std::abs(x);
    if (x > radius)
        return 0;
    switch (kind) {
    case FilterKind::box:
    case FilterKind::scene:
        return 1;
    case FilterKind::tent:
        return 1 - x / radius;
    case FilterKind::gaussian:
        return gaussian(x, first, radius);
    case FilterKind::mitchell:
    case FilterKind::catmullrom:
        return cubic(x, first, second);
    case FilterKind::lanczos:
        return windowed_sinc(x, radius);
    }
    return 1;
}

PixelFilter gaussian_filter(float deviation) {
    return {FilterKind::gaussian, 4 * deviation, deviation};
}

PixelFilter default_filter(FilterKind kind) {
    constexpr float third = 1.0f / 3;
    switch (kind) {
    case FilterKind::box:
    case FilterKind::scene:
        break;
    case FilterKind::tent:
        return {kind, 1};
    case FilterKind::gaussian:
        return gaussian_filter(0.5f);
    case FilterKind::mitchell:
        return {kind, 2, third, third};
    case FilterKind::catmullrom:
        return {kind, 2, 0, 0.5f};
    case FilterKind::lanczos:
        return {kind, 3};
    }
    return {};
}

FilterSampler::FilterSampler(const PixelFilter& filter) : filter_(filter), is_pixel_(filter == PixelFilter()) {
    if (is_pixel_)
        return;
    const Integrals sums(filter);
    for (double sum : sums.absolute)
        integrals_.push_back(static_cast<float>(sum / sums.absolute.back()));
    norm_ = static_cast<float>(sums.absolute.back() / sums.whole);
}

/// Inverts the integral of |f|, which is linear between the nodes. Returns the distance from the centre.
float FilterSampler::invert(float u) const {
    const auto above = std::upper_bound(integrals_.begin() + 1, integrals_.end() - 1, u);
    const float low = *(above - 1), high = *above,
                in_cell = high > low ? std::min((u - low) / (high - low), 1.0f) : 0;
    const auto cell = static_cast<float>(above - integrals_.begin() - 1);
    return (cell + in_cell) * (2 * filter_.radius / cells) - filter_.radius;
}

FilterSampler::Point FilterSampler::sample(glm::vec2 u) const {
    if (is_pixel_)
        return {u};
    const glm::vec2 offset(invert(u.x), invert(u.y));
    const bool is_negative = (filter_.value(offset.x) < 0) != (filter_.value(offset.y) < 0);
    return {offset + 0.5f, (is_negative ? -norm_ : norm_) * norm_};
}

} // namespace tessera
