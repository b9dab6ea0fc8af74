#include "render/load/plugins.h"
#include "render/sampling/sampling.h"
#include "render/scene/sky.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace tessera {

namespace {

constexpr int default_resolution = 512;
constexpr int max_resolution = 8192;
constexpr float min_disk_radius = 1e-4f; // radians; floats are too coarse for smaller disks; not tuned

PlaceAndTime place_and_time(Properties& p) {
    PlaceAndTime when;
    when.latitude = p.number("latitude", static_cast<float>(when.latitude));
    when.longitude = p.number("longitude", static_cast<float>(when.longitude));
    when.timezone = p.number("timezone", static_cast<float>(when.timezone));
    when.year = p.integer("year", when.year);
    when.month = p.integer("month", when.month);
    when.day = p.integer("day", when.day);
    const std::chrono::year_month_day date{std::chrono::year(when.year),
                                           std::chrono::month(static_cast<unsigned>(when.month)),
                                           std::chrono::day(static_cast<unsigned>(when.day))};
    if (std::abs(when.year) > 9999 || std::min(when.month, when.day) < 1 || std::max(when.month, when.day) > 31 ||
        !date.ok())
        p.element().fail(fmt::format("there is no day {}-{}-{}", when.year, when.month, when.day));
    when.hour = p.number("hour", static_cast<float>(when.hour));
    when.minute = p.number("minute", static_cast<float>(when.minute));
    when.second = p.number("second", static_cast<float>(when.second));
    return when;
}

/// Parameters that sky and sun share.
struct Daylight {
    glm::mat3 to_world; ///< rotation from the model's frame, in which +y is up
    glm::vec3 sun;      ///< unit direction toward the sun, in the model's frame; may be below the horizon
    float turbidity = 3;
    float stretch = 1; ///< factor on all zenith angles

    float elevation() const { return std::asin(glm::clamp(sun.y, 0.0f, 1.0f)); }
};

Daylight read_daylight(const LoadContext& context, Properties& p) {
    Daylight day;
    day.to_world = p.rotation("to_world");
    const glm::mat3 up_z(1, 0, 0, 0, 0, 1, 0, -1, 0); // to Mitsuba 3's frame: (x, y, z) becomes (x, -z, y)
    if (!context.old_syntax)
        day.to_world = day.to_world * up_z;
    day.turbidity = p.number("turbidity", day.turbidity);
    if (!(day.turbidity >= 1 && day.turbidity <= 10))
        p.take("turbidity")->fail("'turbidity' must be from 1 to 10", "value");
    const PlaceAndTime when = place_and_time(p);
    if (p.has("sun_direction")) {
        const glm::vec3 direction = p.point("sun_direction", {});
        if (!(glm::length(direction) > 0))
            p.take("sun_direction")->fail("the direction must not be 0");
        day.sun = glm::inverse(day.to_world) * glm::normalize(direction);
    } else {
        day.sun = sun_direction(when);
        if (!context.old_syntax) // there +x is south and +y is west
            day.sun = glm::transpose(up_z) * glm::vec3(day.sun.z, -day.sun.x, day.sun.y);
    }
    day.stretch = glm::clamp(p.number("stretch", 1), 1.0f, 2.0f);
    if (day.sun.y < 0)
        p.note("the sun is below the horizon and is moved to it");
    p.ignore({"sampling_weight", "complex_sun"});
    return day;
}

void add_sky(LoadContext& context, Properties& p, const Daylight& day, float scale) {
    SkySettings settings;
    settings.sun_direction = day.sun;
    settings.turbidity = day.turbidity;
    settings.stretch = day.stretch;
    settings.extend = p.boolean("extend", false);
    settings.scale = Rgb(hosek_scale * scale);
    const int resolution = p.integer("resolution", default_resolution);
    if (resolution < 4 || resolution > max_resolution)
        p.take("resolution")->fail("'resolution' must be from 4 to " + std::to_string(max_resolution), "value");
    p.note("the Preetham sky, scaled by " + std::to_string(hosek_scale).substr(0, 3) +
           ", replaces the Hosek-Wilkie sky, which is not implemented");
    if (p.has("albedo"))
        p.note(*p.take("albedo"), "Preetham's sky does not depend on the albedo of the ground");
    if (context.scene.environment.map) {
        p.note("the scene has another environment already; this sky gives no light");
        return;
    }
    context.scene.environment.map = {std::make_shared<const Bitmap>(sky_bitmap(make_sky(settings), resolution)), 1,
                                     day.to_world};
}

/// Returns the unit direction toward the sun's disk, in the world.
glm::vec3 disk_direction(const Daylight& day) {
    const float zenith_angle = day.stretch * (pi / 2 - day.elevation());
    const glm::vec3 along(day.sun.x, 0, day.sun.z);
    const float length = glm::length(along);
    const glm::vec3 horizontal = length > 0 ? along / length : glm::vec3(1, 0, 0);
    return glm::normalize(day.to_world *
                          (std::sin(zenith_angle) * horizontal + std::cos(zenith_angle) * glm::vec3(0, 1, 0)));
}

void add_sun(LoadContext& context, Properties& p, const Daylight& day, float scale) {
    const float radius_scale = p.number("sun_radius_scale", 1);
    if (radius_scale < 0)
        p.take("sun_radius_scale")->fail("'sun_radius_scale' must not be negative", "value");
    float radius = sun_angular_radius * radius_scale;
    if (p.has("sun_aperture")) { // diameter in degrees
        const float diameter = p.number("sun_aperture", 1);
        if (diameter < 0 || diameter > 180)
            p.take("sun_aperture")->fail("'sun_aperture' must be from 0 to 180 degrees", "value");
        radius = glm::radians(diameter) / 2;
    }
    const Rgb radiance = scale * sun_radiance(day.turbidity, day.elevation());
    const glm::vec3 direction = disk_direction(day);
    if (radius < min_disk_radius)
        context.scene.directional_lights.push_back({direction, sun_irradiance(radiance)});
    else if (context.scene.environment.sun)
        p.note("the scene has another sun already; this one gives no light");
    else
        context.scene.environment.sun = {direction, radius, resized_sun_radiance(radiance, radius)};
}

} // namespace

void read_sunsky(LoadContext& context, Properties& p) {
    const Daylight day = read_daylight(context, p);
    const float both = light_scale(p, "scale");
    add_sky(context, p, day, light_scale(p, "sky_scale", both));
    add_sun(context, p, day, light_scale(p, "sun_scale", both));
}

void read_sky(LoadContext& context, Properties& p) {
    const Daylight day = read_daylight(context, p);
    add_sky(context, p, day, light_scale(p, "scale"));
}

void read_sun(LoadContext& context, Properties& p) {
    const Daylight day = read_daylight(context, p);
    add_sun(context, p, day, light_scale(p, "scale"));
}

} // namespace tessera
