#include "render/io/text.h"
#include "render/load/plugins.h"
#include "render/settings/settings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

namespace tessera {

namespace {

constexpr int unlimited_depth = 65;
constexpr int max_film_side = 16384; // pixels a side

FovAxis fov_axis_parameter(Properties& p) {
    const std::string name = p.text("fov_axis", "x");
    const auto axis = fov_axis_from_name(name);
    if (!axis)
        p.take("fov_axis")->fail("'" + name + "' is not an axis (x, y, diagonal, smaller or larger)", "value");
    return *axis;
}

/// Returns the diagonal field of view in degrees of a focal length such as "50mm" on 35 mm film (36 by 24 mm).
float fov_of_focal_length(Properties& p) {
    std::string text = p.text("focal_length", "50mm");
    if (text.ends_with("mm"))
        text.resize(text.size() - 2);
    const auto length = parse_number(text);
    if (!length || *length <= 0)
        p.take("focal_length")->fail("'" + text + "' is not a length in mm", "value");
    return glm::degrees(2 * std::atan(std::hypot(36.0f, 24.0f) / (2 * static_cast<float>(*length))));
}

float positive_parameter(Properties& p, std::string_view name, float fallback) {
    const float value = p.number(name, fallback);
    if (!(value > 0))
        p.take(name)->fail("'" + std::string(name) + "' must be above 0", "value");
    return value;
}

void read_lens(Properties& p, Camera& camera) {
    if (!p.has("aperture_radius"))
        p.element().fail("the sensor '" + p.type() + "' needs an 'aperture_radius'");
    camera.aperture_radius = p.number("aperture_radius", 0);
    if (camera.aperture_radius < 0)
        p.take("aperture_radius")->fail("'aperture_radius' must not be negative", "value");
    camera.focus_distance = positive_parameter(p, "focus_distance", positive_parameter(p, "far_clip", 1e4f));
}

void read_placement(Properties& p, Camera& camera) {
    camera.to_world = p.transform("to_world");
    if (!(std::abs(glm::determinant(glm::mat3(camera.to_world))) > 0)) {
        p.notes().push_back(p.take("to_world")->error("the camera's transform is flat").note("it is left out"));
        camera.to_world = glm::mat4(1.0f);
    }
}

int film_side(Properties& p, std::string_view name, int fallback) {
    const int side = p.integer(name, fallback);
    if (side < 1 || side > max_film_side)
        p.take(name)->fail(
            "the film's " + std::string(name) + " must be from 1 to " + std::to_string(max_film_side), "value");
    return side;
}

PixelFilter read_filter(LoadContext& context, const XmlElement& element) {
    Properties p(element, context.notes);
    const std::optional<FilterKind> kind = filter_kind_from_name(p.type());
    if (!kind) {
        p.note("the reconstruction filter '" + p.type() + "' is not known: box is used instead");
        return {};
    }
    PixelFilter filter = default_filter(*kind);
    switch (*kind) {
    case FilterKind::box: // 0.6 has a radius
    case FilterKind::tent:
        filter.radius = p.number("radius", filter.radius);
        break;
    case FilterKind::gaussian:
        filter = gaussian_filter(p.number("stddev", filter.first));
        break;
    case FilterKind::mitchell:
        filter.first = p.number("b", filter.first);
        filter.second = p.number("c", filter.second);
        break;
    case FilterKind::lanczos:
        filter.radius = static_cast<float>(p.integer("lobes", static_cast<int>(filter.radius)));
        break;
    case FilterKind::catmullrom:
    case FilterKind::scene:
        break;
    }
    if (!filter.is_valid())
        element.fail("the parameters of the reconstruction filter '" + p.type() + "' are out of range");
    p.report_unused();
    return filter;
}

/// Reads the crop window; empty if it is the whole film.
CropWindow read_crop(Properties& p, glm::ivec2 film) {
    const CropWindow crop{film,
                          {p.integer("crop_offset_x", 0), p.integer("crop_offset_y", 0)},
                          {p.integer("crop_width", film.x), p.integer("crop_height", film.y)}};
    if (!crop.is_valid())
        p.element().fail(fmt::format("the crop window, {}x{} pixels at ({}, {}), does not lie within the film of "
                                     "{}x{} pixels",
                                     crop.size.x, crop.size.y, crop.offset.x, crop.offset.y, film.x, film.y));
    return crop.size == film ? CropWindow{} : crop;
}

PixelFormat read_pixel_format(Properties& p) {
    const std::string name = p.text("pixel_format", "rgb");
    if (const std::optional<PixelFormat> format = pixel_format_from_name(name))
        return *format;
    p.note(*p.take("pixel_format"), "the pixel format '" + name + "' is not known: rgb is used instead");
    return PixelFormat::rgb;
}

void read_film(LoadContext& context, const XmlElement& element, Sensor& sensor) {
    Properties p(element, context.notes);
    const glm::ivec2 film{film_side(p, "width", 768), film_side(p, "height", 576)};
    sensor.camera.crop = read_crop(p, film);
    sensor.size = sensor.camera.crop.size_on(film);
    sensor.format = read_pixel_format(p);
    if (const std::optional<XmlElement> filter = context.take_one_nested(p, "rfilter"))
        sensor.camera.filter = read_filter(context, *filter);
    // Parameters of Mitsuba's output file.
    p.ignore({"file_format", "component_format", "banner", "gamma", "exposure", "tonemap_method", "attach_log",
              "high_quality_edges", "compensate", "sample_border"});
    p.report_unused();
}

struct SensorKind {
    std::string_view name;
    bool is_orthographic = false, has_lens = false, has_offset = false;

    bool operator==(std::string_view other) const { return name == other; }
};

constexpr SensorKind sensors[] = {
    {.name = "perspective", .has_offset = true},
    {.name = "thinlens", .has_lens = true},
    {.name = "orthographic", .is_orthographic = true},
    {.name = "telecentric", .is_orthographic = true, .has_lens = true}, // 0.6
};

} // namespace

void read_field_of_view(Properties& p, Camera& camera) {
    if (!p.has("fov")) {
        camera.fov = fov_of_focal_length(p);
        camera.fov_axis = FovAxis::diagonal;
        p.ignore({"fov_axis"});
        return;
    }
    camera.fov = p.number("fov", camera.fov);
    camera.fov_axis = fov_axis_parameter(p);
    if (!(camera.fov > 0 && camera.fov < 180))
        p.take("fov")->fail("the field of view must be between 0 and 180 degrees", "value");
}

void read_integrator(LoadContext& context, const XmlElement& element) {
    const NestingGuard guard(context, element);
    Properties p(element, context.notes);
    const bool is_direct = p.type() == "direct"; // emission and direct light
    const int depth = p.integer("max_depth", is_direct ? 2 : -1);
    if (depth < -1 || depth == 0)
        p.take("max_depth")->fail("'max_depth' must be at least 1, or -1 for no limit", "value");
    if (depth > most_edges)
        p.note(*p.take("max_depth"),
               fmt::format("max_depth {} is reduced to {}, the largest number of edges of a path", depth,
                           most_edges));
    context.scene.max_depth = depth == -1 ? unlimited_depth : depth;
    context.scene.hides_emitters = p.boolean("hide_emitters", context.scene.hides_emitters);
    if (p.type() == "path" || is_direct) {
        p.ignore({"rr_depth", "strict_normals", "shading_samples", "emitter_samples", "bsdf_samples"});
        p.report_unused();
        return;
    }
    // Wrappers such as `aov`, `moment` and `adaptive` contain the integrator that has the depth.
    const std::optional<XmlElement> nested = context.take_one_nested(p, "integrator");
    p.note("the integrator '" + p.type() + "' is not used: the method is chosen in Tessera");
    if (nested)
        read_integrator(context, *nested);
}

void read_sensor(LoadContext& context, const XmlElement& element) {
    Properties p(element, context.notes);
    const auto* known = std::find(std::begin(sensors), std::end(sensors), p.type());
    const SensorKind kind = known == std::end(sensors) ? sensors[0] : *known;
    if (known == std::end(sensors))
        p.note("the sensor '" + p.type() + "' is replaced by 'perspective'");
    Sensor sensor;
    sensor.id = element.attribute("id");
    sensor.camera.filter = default_filter(FilterKind::gaussian); // Mitsuba's default
    Camera& camera = sensor.camera;
    read_placement(p, camera);
    camera.is_orthographic = kind.is_orthographic;
    if (!kind.is_orthographic)
        read_field_of_view(p, camera);
    if (kind.has_lens)
        read_lens(p, camera);
    else
        p.ignore({"focus_distance"});
    if (kind.has_offset)
        camera.principal_offset = {p.number("principal_point_offset_x", 0),
                                   p.number("principal_point_offset_y", 0)};
    if (const std::optional<XmlElement> film = context.take_one_nested(p, "film"))
        read_film(context, *film, sensor);
    context.take_nested(p, "sampler"); // the sample count is a setting of Tessera
    if (p.number("near_clip", 0.01f) > 0.1f || p.number("far_clip", 1e4f) < 1000)
        p.note("'near_clip' and 'far_clip' are not used: the camera sees everything in front of it");
    p.report_unused();
    if (context.scene.sensors.empty())
        context.scene.use(sensor);
    context.scene.sensors.push_back(std::move(sensor));
}

} // namespace tessera
