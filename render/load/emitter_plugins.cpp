#include "render/load/emitter_plugins.h"

#include "render/load/plugin_table.h"
#include "render/load/texture_plugins.h"

namespace tessera {

namespace {

AreaLight read_area(LoadContext& context, Properties& p) {
    AreaLight light;
    const Texture radiance = texture_parameter(context, p, "radiance", light.radiance);
    if (const Rgb* constant = std::get_if<Rgb>(&radiance.kind))
        light.radiance = *constant;
    else
        p.note(*p.take("radiance"), "the textured radiance is replaced by a constant one");
    if (light.radiance.r < 0 || light.radiance.g < 0 || light.radiance.b < 0)
        p.take("radiance")->fail("'radiance' must not be negative", "value");
    p.ignore({"sampling_weight"}); // lights are chosen by their power
    return light;
}

constexpr Plugin<AreaLight (*)(LoadContext&, Properties&)> plugins_in_shapes[] = {
    {"area", read_area},
};

} // namespace

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
    const Properties properties(element, context.notes);
    if (find_plugin(plugins_in_shapes, properties.type()))
        properties.note("the emitter '" + properties.type() + "' stands outside of a shape; it gives no light");
    else
        properties.note("the emitter '" + properties.type() + "' is not known; it gives no light");
}

} // namespace tessera
