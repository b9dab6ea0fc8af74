#include "render/load/plugins.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace tessera {

namespace {

/// Checks an emitted quantity that was read from the parameter of that name. Clamps it to `brightest`, with a
/// note. Throws LoadError if it is negative.
Rgb checked_light(Properties& p, std::string_view name, Rgb color) {
    if (color.r < 0 || color.g < 0 || color.b < 0)
        p.take(name)->fail("'" + std::string(name) + "' must not be negative", "value");
    const Rgb clamped = glm::min(color, Rgb(brightest));
    if (clamped != color)
        p.note(*p.take(name),
               "'" + std::string(name) + "' is clamped to 1e15: brighter pictures cannot be reconstructed");
    return clamped;
}

/// Reads an emitted quantity such as "intensity".
Rgb light_parameter(Properties& p, std::string_view name) {
    p.ignore({"sampling_weight"}); // Tessera learns the selection probabilities of lights
    return checked_light(p, name, p.color(name, Rgb(1)));
}

/// Reads an emitted quantity that may vary over a surface.
Texture light_texture_parameter(LoadContext& context, Properties& p, std::string_view name) {
    Texture texture = texture_parameter(context, p, name, Rgb(1));
    if (Rgb* constant = std::get_if<Rgb>(&texture.kind))
        *constant = checked_light(p, name, *constant);
    p.ignore({"sampling_weight"});
    return texture;
}

AreaLight read_area(LoadContext& context, Properties& p) {
    return {light_texture_parameter(context, p, "radiance")};
}

glm::vec3 unit_parameter(Properties& p, std::string_view name, glm::vec3 v) {
    const float length = glm::length(v);
    if (!(length > 0))
        (p.has(name) ? *p.take(name) : p.element()).fail("the direction must not be 0");
    return v / length;
}

void read_point(LoadContext& context, Properties& p) {
    PointLight light;
    light.intensity = light_parameter(p, "intensity");
    light.position = p.has("position") ? p.point("position", {}) : glm::vec3(p.transform("to_world")[3]);
    context.scene.point_lights.push_back(light);
}

/// Reads the texture of a spot, which spans the width of its cone. Its u and v run opposite to a camera's.
std::optional<Slide> read_slide(LoadContext& context, Properties& p, float cutoff) {
    if (!(cutoff < 90)) {
        p.note(*p.take("texture"), "the texture is not used: it needs a 'cutoff_angle' below 90 degrees");
        return {};
    }
    const glm::mat4 mirrored = glm::scale(glm::mat4(p.rotation("to_world")), {-1, -1, 1});
    return Slide{
        texture_parameter(context, p, "texture", Rgb(1)), {mirrored, 2 * cutoff, FovAxis::x}, Slide::Kind::share};
}

void read_spot(LoadContext& context, Properties& p) {
    PointLight light;
    light.intensity = light_parameter(p, "intensity");
    const glm::mat4 to_world = p.transform("to_world");
    light.position = glm::vec3(to_world[3]);
    light.axis = unit_parameter(p, "to_world", glm::vec3(to_world[2]));
    light.cutoff = p.number("cutoff_angle", 20);
    light.beam_width = p.number("beam_width", light.cutoff * 0.75f);
    if (!(light.cutoff > 0 && light.cutoff < 180))
        p.take("cutoff_angle")->fail("'cutoff_angle' must be between 0 and 180 degrees", "value");
    if (!(light.beam_width >= 0 && light.beam_width <= light.cutoff))
        p.take("beam_width")->fail("'beam_width' must be between 0 and 'cutoff_angle'", "value");
    if (p.has("texture"))
        light.slide = read_slide(context, p, light.cutoff);
    context.scene.point_lights.push_back(light);
}

/// Reads a projector of Mitsuba 3.
void read_projector(LoadContext& context, Properties& p) {
    Slide slide;
    slide.kind = Slide::Kind::irradiance;
    slide.picture = light_texture_parameter(context, p, "irradiance");
    slide.camera.to_world = glm::mat4(p.rotation("to_world"));
    read_field_of_view(p, slide.camera);
    PointLight light;
    light.intensity = Rgb(light_scale(p, "scale"));
    light.position = glm::vec3(p.transform("to_world")[3]);
    light.slide = slide;
    context.scene.point_lights.push_back(light);
}

void read_directional(LoadContext& context, Properties& p) {
    DirectionalLight light;
    light.irradiance = light_parameter(p, "irradiance");
    const glm::vec3 away = p.has("direction") ? p.point("direction", {}) : glm::vec3(p.transform("to_world")[2]);
    light.to_light = -unit_parameter(p, "direction", away);
    context.scene.directional_lights.push_back(light);
}

/// Sets the environment map. A second one is left out, with a note.
void set_map(LoadContext& context, Properties& p, EnvironmentMap map) {
    if (context.scene.environment.map)
        p.note("the scene has another environment already; this one gives no light");
    else
        context.scene.environment.map = std::move(map);
}

void read_constant(LoadContext& context, Properties& p) {
    Bitmap pixel;
    pixel.width = pixel.height = 1;
    pixel.floats = {light_parameter(p, "radiance")};
    set_map(context, p, {std::make_shared<const Bitmap>(std::move(pixel))});
}

void read_environment_map(LoadContext& context, Properties& p) {
    EnvironmentMap map;
    map.scale = light_scale(p, "scale");
    map.to_world = p.rotation("to_world");
    map.bitmap = bitmap_parameter(context, p, true);
    p.ignore({"sampling_weight", "mis_compensation", "cache"});
    set_map(context, p, std::move(map));
}

constexpr Plugin<AreaLight (*)(LoadContext&, Properties&)> plugins_in_shapes[] = {
    {"area", read_area},
};

constexpr Plugin<void (*)(LoadContext&, Properties&)> plugins_in_scenes[] = {
    {"point", read_point},
    {"spot", read_spot},
    {"projector", read_projector},
    {"directional", read_directional},
    {"constant", read_constant},
    {"envmap", read_environment_map},
    {"sunsky", read_sunsky},
    {"sky", read_sky},
    {"sun", read_sun},
};

} // namespace

float light_scale(Properties& p, std::string_view name, float fallback) {
    return checked_light(p, name, Rgb(p.number(name, fallback))).r;
}

int add_shape_emitter(LoadContext& context, const XmlElement& element) {
    Properties properties(element, context.notes);
    const auto* plugin = find_plugin(plugins_in_shapes, properties.type());
    if (!plugin) {
        properties.note("the emitter '" + properties.type() + "' is not known; it gives no light");
        return -1;
    }
    const AreaLight light = plugin->read(context, properties);
    properties.report_unused();
    context.scene.area_lights.push_back(light);
    return static_cast<int>(context.scene.area_lights.size()) - 1;
}

void add_scene_emitter(LoadContext& context, const XmlElement& element) {
    Properties properties(element, context.notes);
    if (const auto* plugin = find_plugin(plugins_in_scenes, properties.type())) {
        plugin->read(context, properties);
        properties.report_unused();
    } else if (find_plugin(plugins_in_shapes, properties.type())) {
        if (!element.has("id") || !context.referred.contains(element.attribute("id"))) // a shape may refer to it
            properties.note("the emitter '" + properties.type() + "' is outside of a shape; it gives no light");
    } else {
        properties.note("the emitter '" + properties.type() + "' is not known; it gives no light");
    }
}

} // namespace tessera
