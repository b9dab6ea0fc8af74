#pragma once

#include "render/settings/settings.h"

#include <optional>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// A reconstruction filter, Mitsuba's <rfilter>: the product of one function of x and the same function of y. It
/// need not be normalised. Lengths are pixels.
struct PixelFilter {
    FilterKind kind = FilterKind::box; ///< never FilterKind::scene
    float radius = 0.5f;               ///< the filter is 0 beyond this distance from the pixel's centre, > 0
    /// Gaussian: the standard deviation, > 0. Mitchell-Netravali and Catmull-Rom: B and C [Mitchell 1988].
    float first = 0, second = 0;

    /// Returns the function of one coordinate at a distance from the centre.
    float value(float x) const;
    /// Returns whether the parameters are in their ranges, radii at most 16 pixels, and the integral is positive.
    bool is_valid() const;
    bool operator==(const PixelFilter&) const = default;
};

/// Returns the name of a kind, as in the settings and in Mitsuba: "gaussian".
std::string_view to_string(FilterKind kind);
/// Returns the kind with this name, without FilterKind::scene; empty if there is none.
std::optional<FilterKind> filter_kind_from_name(std::string_view name);

/// Returns the filter of a kind with Mitsuba's default parameters. `kind` must not be FilterKind::scene.
PixelFilter default_filter(FilterKind kind);
/// Returns Mitsuba's Gaussian, which ends at four standard deviations (> 0, pixels).
PixelFilter gaussian_filter(float deviation);

/// Filter importance sampling [Ernst 2006]: points are drawn with a pdf proportional to |f|, and a sample weighs
/// f / pdf. This weight is one constant, with the sign of f.
class FilterSampler {
public:
    /// Tabulates the filter: its relative error is below 1e-4.
    explicit FilterSampler(const PixelFilter& filter);

    struct Point {
        glm::vec2 subpixel; ///< from the pixel's top left corner, pixels; outside [0, 1) with wide filters
        float weight = 1;   ///< f / pdf, of a normalised filter; negative in negative lobes
    };
    /// Maps a point of [0, 1)^2 to a point under the filter. The map is monotone in each coordinate, so a
    /// stratified point set stays stratified.
    Point sample(glm::vec2 u) const;

private:
    float invert(float u) const;

    PixelFilter filter_;
    bool is_pixel_;                ///< whether the filter is the box of one pixel
    std::vector<float> integrals_; ///< of |f| from -radius to each node, 1 at the end
    float norm_ = 1;               ///< integral of |f| over that of f
};

} // namespace tessera
