#pragma once

#include "render/scene/camera.h"
#include "render/settings/settings.h"

#include <optional>

#include <glm/geometric.hpp>

namespace tessera {

/// Width of a pixel at a surface point, for texture filtering. See docs/theory.md, "Texture filtering".
///
/// Other pixels reuse the vertices of a base path beyond x_1. Their reflectance must not depend on the path that
/// reaches them, or the weights of a sampling set would not sum to one. They therefore have the width of a pixel
/// whose camera sees the point unobstructed, a function of the point alone, as in pbrt-4. x_1 has the width of
/// the pixel's own ray. With TextureFilter::path, so has what the pixel sees through delta scatters, whose edges
/// are never reconnected.
class TextureView {
public:
    /// Disables filtering.
    TextureView() = default;
    /// @param first_unfiltered  leaves x_1, and what mirrors at x_1 show, unfiltered. Set with albedo
    /// demodulation:
    ///                      the mean albedo of many points per pixel is better than a footprint (PixelFeatures).
    TextureView(TextureFilter filter, bool first_unfiltered, const Camera& camera, glm::ivec2 size)
        : filter_(filter), is_parallel_(camera.is_orthographic), spares_first_(first_unfiltered) {
        const Projection projection(camera, size);
        const Ray middle = projection.ray(glm::vec2(size) * 0.5f);
        eye_ = middle.origin;
        forward_ = middle.direction;
        width_ = projection.pixel_width();
    }

    /// Sides of a parallelogram in world space, a given footprint that replaces the pixel's (path differentials).
    struct Sides {
        glm::vec3 a, b;
    };
    explicit TextureView(const Sides& sides) : filter_(TextureFilter::path), sides_(sides) {}
    const std::optional<Sides>& sides() const { return sides_; }

    /// Width of a footprint in pixels: that of one of sixteen paths [Suykens 2001, 3.4]. A footprint of one pixel
    /// would blur twice, because samples are distributed over the pixel, too.
    static constexpr float footprint_pixels = 0.25f;

    TextureFilter filter() const { return filter_; }
    bool first_unfiltered() const { return spares_first_; }
    /// Angle of a pixel, radians (PixelWidth::angle).
    float angle() const { return width_.angle; }
    /// Width of a pixel where its camera ray begins, scene units.
    float initial_width() const { return width_.least; }

    /// The unit direction in which a point is seen, and the width of a pixel there, perpendicular to it.
    struct Beam {
        glm::vec3 direction;
        float width;
    };
    Beam from_camera(glm::vec3 point) const {
        if (is_parallel_)
            return {forward_, width_.least};
        const glm::vec3 d = point - eye_;
        const float distance = glm::length(d);
        return {distance > 0 ? d / distance : forward_, width_.at(distance)};
    }

private:
    TextureFilter filter_ = TextureFilter::off;
    glm::vec3 eye_{0}, forward_{0, 0, 1};
    PixelWidth width_;
    std::optional<Sides> sides_;
    bool is_parallel_ = false, spares_first_ = false;
};

} // namespace tessera
