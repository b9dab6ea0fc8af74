#include "render/io/text.h"
#include "render/load/plugins.h"
#include "render/load/properties.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>

#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr Rgb replacement(0.5f); // in place of a texture that cannot be read
const Bitmap grey_bitmap{1, 1, false, {}, {replacement}};
constexpr const char* grey_instead = "grey is used instead";

/// Reads `to_uv` of Mitsuba 3, or the scale and offset of 0.6.
glm::mat3 uv_transform(Properties& p) {
    if (const auto element = p.take("to_uv"))
        return read_uv_transform(*element, p.notes());
    const float scale = p.number("uvscale", 1);
    return {p.number("uscale", scale), 0, 0, 0, p.number("vscale", scale), 0, p.number("uoffset", 0),
            p.number("voffset", 0),    1};
}

Filter filter_parameter(Properties& p) {
    const std::string name = p.text("filter_type", "bilinear");
    if (name == "nearest")
        return Filter::nearest;
    // Over many samples a pixel, bilinear look-ups average to about the prefiltered look-ups of 0.6: no note.
    if (name != "bilinear" && name != "trilinear" && name != "ewa")
        p.note(*p.take("filter_type"), "the filter '" + name + "' is replaced by 'bilinear'");
    return Filter::bilinear;
}

Wrap wrap_parameter(Properties& p) {
    std::string parameter = "wrap_mode";
    if (!p.has(parameter) && p.has("wrap_mode_u")) {
        parameter = "wrap_mode_u";
        if (p.text("wrap_mode_v", "repeat") != p.text("wrap_mode_u", "repeat"))
            p.note("the wrap mode of u is used for v, too");
    }
    const std::string name = p.text(parameter, "repeat");
    if (name == "clamp")
        return Wrap::clamp;
    if (name == "mirror")
        return Wrap::mirror;
    if (name != "repeat")
        p.note(*p.take(parameter), "the wrap mode '" + name + "' is replaced by 'repeat'");
    return Wrap::repeat;
}

/// Returns whether bytes are sRGB: `raw` of Mitsuba 3, `gamma` of 0.6 (1: linear, -1: sRGB).
bool srgb_parameter(Properties& p) {
    const bool raw = p.boolean("raw", false);
    const float gamma = p.number("gamma", raw ? 1.0f : -1.0f);
    if (gamma != 1 && gamma != -1)
        p.note(*p.take("gamma"), "the gamma is replaced by the curve of sRGB");
    return gamma != 1;
}

/// Reads the channel that becomes grey; a parameter of Mitsuba 0.6.
BitmapChannel channel_parameter(Properties& p) {
    static constexpr std::pair<std::string_view, BitmapChannel> channels[] = {
        {"", BitmapChannel::all},        {"all", BitmapChannel::all},     {"r", BitmapChannel::red},
        {"g", BitmapChannel::green},     {"b", BitmapChannel::blue},      {"a", BitmapChannel::alpha},
        {"red", BitmapChannel::red},     {"green", BitmapChannel::green}, {"blue", BitmapChannel::blue},
        {"alpha", BitmapChannel::alpha},
    };
    const std::string name = lower_case(p.text("channel", ""));
    for (const auto& [known, channel] : channels)
        if (known == name)
            return channel;
    p.take("channel")->fail("'" + name + "' is not a channel (r, g, b or a)", "value");
}

Texture read_bitmap_texture(LoadContext& context, Properties& p) {
    Texture texture;
    const BitmapChannel channel = channel_parameter(p);
    const bool srgb = srgb_parameter(p) && channel != BitmapChannel::alpha;
    texture.kind =
        BitmapTexture{bitmap_parameter(context, p, srgb, channel), filter_parameter(p), wrap_parameter(p)};
    texture.to_uv = uv_transform(p);
    p.ignore({"max_anisotropy", "cache", "format", "accel"}); // speed and memory only
    return texture;
}

Texture read_checkerboard(LoadContext& context, Properties& p) {
    CheckerboardTexture checkerboard;
    const auto field = [&](std::string_view name, Rgb fallback) {
        const Texture color = texture_parameter(context, p, name, fallback);
        if (color.is_constant())
            return std::get<Rgb>(color.kind);
        p.note(*p.take(name), "a texture in a checkerboard is replaced by a constant colour");
        return fallback;
    };
    checkerboard.color0 = field("color0", checkerboard.color0);
    checkerboard.color1 = field("color1", checkerboard.color1);
    Texture texture;
    texture.kind = checkerboard;
    texture.to_uv = uv_transform(p);
    return texture;
}

Texture scaled(Texture texture, float factor) {
    if (Rgb* constant = std::get_if<Rgb>(&texture.kind))
        *constant *= factor;
    else
        texture.scale *= factor;
    return texture;
}

/// Reads numbers that are not converted to a spectrum; a plugin of Mitsuba 3.
Texture read_raw_constant(LoadContext& context, Properties& p) {
    const auto value = p.take("value");
    if (!value)
        p.element().fail("'rawconstant' needs a 'value'");
    if (value->tag() == "vector" || value->tag() == "point")
        return Rgb(read_point(*value));
    return read_color(*value, Rgb(1), context.notes);
}

/// Reads a texture times a factor; a plugin of Mitsuba 0.6.
Texture read_scale(LoadContext& context, Properties& p) {
    const Rgb factors = p.color("scale", Rgb(1));
    if (factors.r != factors.g || factors.g != factors.b)
        p.note(*p.take("scale"), "the coloured scale is replaced by its mean");
    const float factor = (factors.r + factors.g + factors.b) / 3;
    if (const std::optional<XmlElement> nested = context.take_one_nested(p, "texture"))
        return scaled(read_texture(context, *nested), factor);
    return scaled(texture_parameter(context, p, "value", Rgb(1)), factor);
}

Texture attribute_texture(const std::string& name, float scale) {
    Texture texture;
    texture.kind = AttributeTexture{name};
    texture.scale = scale;
    return texture;
}

/// Reads a plugin of Mitsuba 0.6.
Texture read_vertex_colors(LoadContext&, Properties&) {
    return attribute_texture(std::string(vertex_color), 1);
}

/// Reads a plugin of Mitsuba 3.
Texture read_mesh_attribute(LoadContext&, Properties& p) {
    const std::string name = p.text("name", "");
    if (!p.has("name"))
        p.element().fail("'mesh_attribute' needs a 'name'");
    if (!name.starts_with("vertex_") && !name.starts_with("face_"))
        p.take("name")->fail("'" + name + "' is not an attribute: its name must begin with 'vertex_' or 'face_'",
                             "value");
    return attribute_texture(name, p.number("scale", 1));
}

constexpr Plugin<Texture (*)(LoadContext&, Properties&)> plugins[] = {
    {"bitmap", read_bitmap_texture},
    {"checkerboard", read_checkerboard},
    {"scale", read_scale},
    {"vertexcolors", read_vertex_colors},
    {"mesh_attribute", read_mesh_attribute},
    {"rawconstant", read_raw_constant},
};

} // namespace

std::shared_ptr<const Bitmap> bitmap_of_file(LoadContext& context, const LoadContext::File& file, bool srgb,
                                             BitmapChannel channel) {
    auto& shared = context.bitmaps[{file.path.lexically_normal().string(), srgb, channel}];
    if (!shared) {
        shared = std::make_shared<Bitmap>(grey_bitmap);
        const auto read = [target = shared, path = file.path, srgb, channel](const std::function<bool()>& go_on) {
            LoadedBitmap loaded = read_bitmap(path, srgb, go_on, channel);
            *target = std::move(loaded.bitmap);
            FileReport report;
            if (!loaded.note.empty())
                report.notes.push_back(std::move(loaded.note));
            return report;
        };
        context.jobs.add(file.parameter, grey_instead, read);
    }
    return shared;
}

std::shared_ptr<const Bitmap> bitmap_parameter(LoadContext& context, Properties& p, bool srgb,
                                               BitmapChannel channel) {
    const std::optional<LoadContext::File> file = context.take_file(p, grey_instead);
    return file ? bitmap_of_file(context, *file, srgb, channel) : std::make_shared<const Bitmap>(grey_bitmap);
}

Texture read_texture(LoadContext& context, const XmlElement& element) {
    try {
        const NestingGuard guard(context, element);
        Properties properties(element, context.notes);
        const auto* plugin = find_plugin(plugins, properties.type());
        if (!plugin) {
            context.notes.push_back(element.error("the texture '" + properties.type() + "' is not known")
                                        .note("magenta is used instead"));
            return marking_color;
        }
        const Texture texture = plugin->read(context, properties);
        properties.report_unused();
        return texture;
    } catch (const LoadError& error) {
        context.notes.push_back(error.note(grey_instead));
        return replacement;
    }
}

Texture texture_parameter(LoadContext& context, Properties& properties, std::string_view name, Rgb fallback) {
    const auto parameter = properties.take(name);
    if (!parameter)
        return fallback;
    const XmlElement target = context.resolve(*parameter);
    if (target.tag() == "texture")
        return read_texture(context, target);
    return read_color(target, fallback, context.notes, properties.spectrum_of());
}

Texture reflectance_parameter(LoadContext& context, Properties& properties, std::string_view name, Rgb fallback) {
    Texture texture = texture_parameter(context, properties, name, fallback);
    if (Rgb* color = std::get_if<Rgb>(&texture.kind)) {
        if (color->r < 0 || color->g < 0 || color->b < 0)
            properties.take(name)->fail("'" + std::string(name) + "' must not be negative", "value");
        if (color->r > 1 || color->g > 1 || color->b > 1) {
            properties.note(*properties.take(name), "'" + std::string(name) + "' is above 1 and is clamped to 1");
            *color = glm::min(*color, Rgb(1));
        }
    }
    return texture;
}

} // namespace tessera
