#pragma once

#include "render/load/load_context.h"
#include "render/surface/texture.h"

#include <filesystem>
#include <functional>
#include <iterator>
#include <string_view>

namespace tessera {

// Readers of the elements of a scene.

/// Row of a table of plugins: the type in the file, and its reader.
template <class Function>
struct Plugin {
    std::string_view type;
    Function read;
};

/// Returns the row of that type; null: there is none.
template <class Function, std::size_t count>
const Plugin<Function>* find_plugin(const Plugin<Function> (&table)[count], std::string_view type) {
    for (const Plugin<Function>& plugin : table)
        if (plugin.type == type)
            return &plugin;
    return nullptr;
}

/// Reads a <bsdf>, once for all references. An unknown type becomes diffuse in marking_color, with a note.
Material read_bsdf(LoadContext& context, const XmlElement& element);

/// Returns the index of a <bsdf> in scene.materials, and adds it on first use.
int material_of(LoadContext& context, const XmlElement& element);

/// Returns the material index for a shape without a <bsdf>: grey, or black if the shape emits light.
int default_material(LoadContext& context, bool emits_light);

/// Reads the <emitter> nested in a shape. Returns its index in scene.area_lights; -1 for an unknown type, with
/// a note.
int add_shape_emitter(LoadContext& context, const XmlElement& element);

/// Reads an <emitter> that belongs to no shape.
void add_scene_emitter(LoadContext& context, const XmlElement& element);

// Readers of the daylight emitters. The sky model is [Preetham 1999], scaled to about the brightness of the
// Hosek-Wilkie sky that Mitsuba uses, with a note.
void read_sunsky(LoadContext& context, Properties& properties);
void read_sky(LoadContext& context, Properties& properties);
void read_sun(LoadContext& context, Properties& properties);

/// Adds a <shape> to the scene: triangles, a group of shapes or an instance of a group. An unknown type is
/// skipped, with a note.
void add_shape(LoadContext& context, const XmlElement& element);

/// Notes mesh attributes that textures look up and meshes lack. Call after all files are read.
void note_missing_attributes(LoadContext& context);

/// Reads a <texture>. One of an unknown type becomes marking_color, and one with an invalid parameter becomes
/// grey, each with an error note.
Texture read_texture(LoadContext& context, const XmlElement& element);

/// Returns the image file of a plugin. It is read by a job, and shared by all plugins that name it. `srgb`:
/// whether bytes are sRGB-encoded or linear. A file that is missing or cannot be read is grey, with an error note.
std::shared_ptr<const Bitmap> bitmap_parameter(LoadContext& context, Properties& properties, bool srgb,
                                               BitmapChannel channel = BitmapChannel::all);
/// Does the same for a file that was found.
std::shared_ptr<const Bitmap> bitmap_of_file(LoadContext& context, const LoadContext::File& file, bool srgb,
                                             BitmapChannel channel = BitmapChannel::all);

/// Reads a parameter that is a colour, a texture or a reference to a texture.
Texture texture_parameter(LoadContext& context, Properties& properties, std::string_view name, Rgb fallback);

/// Reads such a parameter that is a fraction of light. A constant above 1 is clamped, with a note; a negative
/// one throws LoadError.
Texture reflectance_parameter(LoadContext& context, Properties& properties, std::string_view name, Rgb fallback);

/// Largest radiance of an emitter or a pixel of an image file, per channel. Sums of many squares of it fit a
/// float, which solvers and error metrics need. Not tuned.
inline constexpr float brightest = 1e15f;

/// Reads a factor on emitted light, clamped to `brightest` with a note. Throws LoadError if negative.
float light_scale(Properties& properties, std::string_view name, float fallback = 1);

/// Replaces the colour of unknown plugins, so that it is noticed.
inline constexpr Rgb marking_color{1.0f, 0.0f, 1.0f};

/// Reads an <integrator>. Only its depth is used; the method is a setting of Tessera.
void read_integrator(LoadContext& context, const XmlElement& element);

/// Reads the field of view of a perspective: "fov" with "fov_axis", or "focal_length".
void read_field_of_view(Properties& properties, Camera& camera);

/// Reads a <sensor> with its film: camera and image size.
void read_sensor(LoadContext& context, const XmlElement& element);

/// A bitmap, and what was chosen or converted to read it (Picture::notes), as the text of a note.
struct LoadedBitmap {
    Bitmap bitmap;
    std::string note; ///< empty: nothing
};

/// Reads an image as three channels: OpenEXR, Radiance and PFM as linear floats, PNG, JPEG, TGA and BMP as bytes,
/// sRGB-encoded or linear as `srgb` says. The format and the layer are those of decode_picture()
/// (render/io/picture_file.h). Alpha is dropped, grey is repeated. Polls `keep_reading`. Throws
/// std::runtime_error, also for a size that file or memory cannot hold, and once `keep_reading` returns false.
/// With one `channel`, that one is repeated; alpha is read from PNG only, and throws if there is none.
LoadedBitmap read_bitmap(const std::filesystem::path& file, bool srgb, const std::function<bool()>& keep_reading,
                         BitmapChannel channel = BitmapChannel::all);

/// Does the same for an image in memory; `extension` is its file name's.
LoadedBitmap parse_bitmap(std::string_view encoded, std::string_view extension, bool srgb,
                          const std::function<bool()>& keep_reading);

} // namespace tessera
