#include "render/load/sky_plugins.h"

#include "render/scene/sky.h"
#include "render/scene/sun.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace tessera {

namespace {

constexpr int usual_resolution = 512;
constexpr int highest_resolution = 8192;

float factor(Properties& p, std::string_view name) {
    const float value = p.number(name, 1);
    if (value < 0)
        p.take(name)->fail("'" + std::string(name) + "' must not be negative", "value");
    return value;
}

PlaceAndTime place_and_time(Properties& p) {
    PlaceAndTime when;
    when.latitude = p.number("latitude", static_cast<float>(when.latitude));
    when.longitude = p.number("longitude", static_cast<float>(when.longitude));
    when.timezone = p.number("timezone", static_cast<float>(when.timezone));
    when.year = p.integer("year", when.year);
    when.month = p.integer("month", when.month);
    when.day = p.integer("day", when.day);
    when.hour = p.number("hour", static_cast<float>(when.hour));
    when.minute = p.number("minute", static_cast<float>(when.minute));
    when.second = p.number("second", static_cast<float>(when.second));
    return when;
}

/// What sky and sun share: where the sun stands, and the air.
struct Daylight {
    glm::mat3 to_world; ///< of the model's frame, in which +y is up
    glm::vec3 sun;      ///< toward it, in the model's frame
    float turbidity = 3;

    float elevation() const { return std::asin(glm::clamp(sun.y, 0.0f, 1.0f)); }
};

Daylight read_daylight(const LoadContext& context, Properties& p) {
    Daylight day;
    day.to_world = glm::mat3(p.transform("to_world"));
    if (!(std::abs(glm::determinant(day.to_world)) > 0))
        p.take("to_world")->fail("the transform is flat");
    for (int i = 0; i < 3; ++i)
        day.to_world[i] = glm::normalize(day.to_world[i]);
    if (!context.old_syntax) // +z is up there
        day.to_world = day.to_world * glm::mat3(1, 0, 0, 0, 0, 1, 0, -1, 0);
    day.turbidity = p.number("turbidity", day.turbidity);
    if (!(day.turbidity >= 1 && day.turbidity <= 10))
        p.take("turbidity")->fail("'turbidity' must be from 1 to 10", "value");
    const PlaceAndTime when = place_and_time(p);
    if (const auto direction = p.vector("sun_direction")) {
        if (!(glm::length(*direction) > 0))
            p.take("sun_direction")->fail("the direction must not be 0");
        day.sun = glm::inverse(day.to_world) * glm::normalize(*direction);
    } else {
        day.sun = sun_direction(when);
    }
    if (day.sun.y < 0)
        p.note("the sun is below the horizon; it is taken to stand on it");
    p.ignore({"sampling_weight", "complex_sun"});
    return day;
}

void add_sky(LoadContext& context, Properties& p, const Daylight& day, std::string_view scale) {
    SkySettings settings;
    settings.sun_direction = day.sun;
    settings.turbidity = day.turbidity;
    settings.stretch = glm::clamp(p.number("stretch", 1), 1.0f, 2.0f);
    settings.extend = p.boolean("extend", false);
    settings.scale = Rgb(hosek_level * factor(p, scale));
    const int resolution = p.integer("resolution", usual_resolution);
    if (resolution < 2 || resolution > highest_resolution)
        p.take("resolution")
            ->fail("'resolution' must be from 2 to " + std::to_string(highest_resolution), "value");
    p.note("the sky is Preetham's, scaled by " + std::to_string(hosek_level).substr(0, 3) +
           ": it stands for that of Hosek and Wilkie, which is not in this program");
    if (p.has("albedo"))
        p.note(*p.take("albedo"), "Preetham's sky does not depend on the albedo of the ground");
    if (context.scene.environment.map) {
        p.note("the scene has another environment already; this sky gives no light");
        return;
    }
    context.scene.environment.map = {std::make_shared<const Bitmap>(sky_bitmap(make_sky(settings), resolution)), 1,
                                     day.to_world};
}

void add_sun(LoadContext& context, Properties& p, const Daylight& day, std::string_view scale) {
    float radius = sun_angular_radius * factor(p, "sun_radius_scale");
    if (p.has("sun_aperture")) // degrees across
        radius = glm::radians(p.number("sun_aperture", 1)) / 2;
    const Rgb radiance = factor(p, scale) * sun_radiance(day.turbidity, day.elevation());
    const glm::vec3 direction = glm::normalize(day.to_world * day.sun);
    if (!(radius > 0))
        context.scene.directional_lights.push_back({direction, sun_irradiance(radiance)});
    else if (context.scene.environment.sun)
        p.note("the scene has another sun already; this one gives no light");
    else
        context.scene.environment.sun = {direction, radius, resized_sun_radiance(radiance, radius)};
}

} // namespace

void read_sunsky(LoadContext& context, Properties& p) {
    const Daylight day = read_daylight(context, p);
    add_sky(context, p, day, "sky_scale");
    add_sun(context, p, day, "sun_scale");
}

void read_sky(LoadContext& context, Properties& p) {
    add_sky(context, p, read_daylight(context, p), "scale");
}

void read_sun(LoadContext& context, Properties& p) {
    add_sun(context, p, read_daylight(context, p), "scale");
}

} // namespace tessera
