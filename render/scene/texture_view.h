#pragma once

#include "render/scene/camera.h"
#include "render/settings/settings.h"

#include <optional>

#include <glm/geometric.hpp>

namespace tessera {

/// How wide a pixel is where something is seen, for textures to be filtered.
///
/// The vertices of a base path beyond x_1 are shared, so what they reflect must not depend on which pixel looks,
/// or the densities of a set would not be those of its samplers, and weights would not add up to one. So they have
/// the width that a pixel would have if the camera saw them with nothing between: a function of the point alone
/// [as pbrt-4 has it]. What a pixel sees itself has that of its own ray: x_1, and with TextureFilter::path what it
/// sees in mirrors and through glass, as an edge that leaves a delta scatter is joined to by nobody.
class TextureView {
public:
    /// Nothing is filtered.
    TextureView() = default;
    /// @param spares_first  x_1 is not filtered, nor what it is a mirror of: light is divided by its albedo, and
    ///                      the mean albedo of many points of each pixel knows more than any footprint
    ///                      (PixelFeatures)
    TextureView(TextureFilter filter, bool spares_first, const Camera& camera, glm::ivec2 size)
        : filter_(filter), is_parallel_(camera.is_orthographic), spares_first_(spares_first) {
        const Projection projection(camera, size);
        const Ray middle = projection.ray(glm::vec2(size) * 0.5f);
        eye_ = middle.origin;
        forward_ = middle.direction;
        width_ = projection.pixel_width();
    }

    /// A parallelogram on the one surface that is looked at, whoever looks: a path's own (PathDifferentials).
    /// World.
    struct Sides {
        glm::vec3 a, b;
    };
    explicit TextureView(const Sides& sides) : filter_(TextureFilter::path), sides_(sides) {}
    const std::optional<Sides>& sides() const { return sides_; }

    /// How wide a footprint is, of a pixel: the path's share if it is one of sixteen [Suykens 2001, 3.4]. A whole
    /// pixel would be blurred once more by the pixel filter.
    static constexpr float share_of_pixel = 0.25f;

    TextureFilter filter() const { return filter_; }
    bool spares_first() const { return spares_first_; }
    /// What is between all that a pixel sees: radians (PixelWidth::angle).
    float angle() const { return width_.angle; }
    /// Width of a camera ray where it begins.
    float first_width() const { return width_.least; }

    /// What shines on a point: the direction in which it is seen, unit, and the width there, across that.
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
