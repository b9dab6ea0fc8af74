#pragma once

#include "render/load/load_context.h"
#include "render/surface/texture.h"

#include <filesystem>
#include <functional>
#include <iterator>
#include <string_view>

namespace tessera {

// What the loader makes of each element of a scene, from its materials to its camera.

/// A row of a table of plugins: the type in the file, and what reads it.
template <class Function>
struct Plugin {
    std::string_view type;
    Function read;
};

/// The row of that type; null: there is no such plugin.
template <class Function, std::size_t count>
const Plugin<Function>* find_plugin(const Plugin<Function> (&table)[count], std::string_view type) {
    for (const Plugin<Function>& plugin : table)
        if (plugin.type == type)
            return &plugin;
    return nullptr;
}

/// A <bsdf>. An unknown plugin becomes a diffuse marking colour, with a note.
Material read_bsdf(LoadContext& context, const XmlElement& element);

/// The index in scene.materials of a <bsdf>, which is read when it is met for the first time.
int material_of(LoadContext& context, const XmlElement& element);

/// The index of the material of a shape that names none: grey, or black where the shape gives light.
int default_material(LoadContext& context, bool gives_light);

/// The index in scene.area_lights of the <emitter> nested in a shape, -1 when it is none that a shape can be.
int add_shape_emitter(LoadContext& context, const XmlElement& element);

/// An <emitter> that belongs to no shape.
void add_scene_emitter(LoadContext& context, const XmlElement& element);

// The emitters of daylight; the model is that of [Preetham 1999], scaled to the brightness of the one that Mitsuba
// uses, with a note.
void read_sunsky(LoadContext& context, Properties& properties);
void read_sky(LoadContext& context, Properties& properties);
void read_sun(LoadContext& context, Properties& properties);

/// Adds a <shape> to the scene, be it triangles, a group of shapes or an instance of such; one of an unknown
/// plugin is left out, with a note.
void add_shape(LoadContext& context, const XmlElement& element);

/// Notes the attributes that textures look up and meshes do not have; for when all files are read.
void note_missing_attributes(LoadContext& context);

/// A <texture>. An unknown plugin becomes a marking colour, with a note.
Texture read_texture(LoadContext& context, const XmlElement& element);

/// The image file of a plugin, read later and shared by all that name it. `srgb`: what its bytes are.
std::shared_ptr<const Bitmap> bitmap_parameter(LoadContext& context, Properties& properties, bool srgb);

/// A parameter that is a colour, a texture or a reference to a texture.
Texture texture_parameter(LoadContext& context, Properties& properties, std::string_view name, Rgb fallback);

/// Such a parameter that is a share of light: a constant above 1 is cut, with a note; one below 0 throws
/// LoadError.
Texture reflectance_parameter(LoadContext& context, Properties& properties, std::string_view name, Rgb fallback);

/// The most light that is given off or stands in a picture file, per channel: squares of it, and sums of many of
/// these, are floats still, as solvers and errors take them.
inline constexpr float brightest = 1e15f;

/// What light is multiplied by: at most so much as well, with a note. Throws LoadError below 0.
float light_scale(Properties& properties, std::string_view name, float fallback = 1);

/// Stands for what this program does not know, so that it meets the eye.
inline constexpr Rgb marking_color{1.0f, 0.0f, 1.0f};

/// An <integrator>: of its settings only the depth belongs to the scene; methods are chosen in the program.
void read_integrator(LoadContext& context, const XmlElement& element);

/// What a plugin with a perspective sees: "fov" with "fov_axis", or "focal_length".
void read_field_of_view(Properties& properties, Camera& camera);

/// A <sensor> with its film: camera and size.
void read_sensor(LoadContext& context, const XmlElement& element);

/// Reads a picture as three channels: OpenEXR and Radiance as linear floats, PNG, JPEG, TGA and BMP as bytes,
/// which are sRGB encoded or linear as `srgb` says. What it holds decides, not what it is called; only TGA, which
/// has no mark, must be called ".tga". Transparency is dropped, grey repeated. Throws std::runtime_error, also for
/// a size that the file is far too short for, or the memory, and once `wanted`, asked now and then, wants it no
/// more.
Bitmap read_bitmap(const std::filesystem::path& file, bool srgb, const std::function<bool()>& wanted);

/// The same of a picture in memory; `extension` is that of its name.
Bitmap parse_bitmap(std::string_view encoded, std::string_view extension, bool srgb,
                    const std::function<bool()>& wanted);

} // namespace tessera
