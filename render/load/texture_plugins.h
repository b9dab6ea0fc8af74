#pragma once

#include "render/load/load_context.h"
#include "render/scene/texture.h"

namespace tessera {

/// A <texture>. An unknown plugin becomes a marking colour, with a note.
Texture read_texture(LoadContext& context, const XmlElement& element);

/// The image file of a plugin, read later and shared by all that name it. `srgb`: what its bytes are.
std::shared_ptr<const Bitmap> bitmap_parameter(LoadContext& context, Properties& properties, bool srgb);

/// A parameter that is a colour, a texture or a reference to a texture.
Texture texture_parameter(LoadContext& context, Properties& properties, std::string_view name, Rgb fallback);

/// The same for a share of light: a constant above 1 is cut, with a note; one below 0 throws LoadError.
Texture reflectance_parameter(LoadContext& context, Properties& properties, std::string_view name, Rgb fallback);

/// Stands for what this program does not know, so that it meets the eye.
inline constexpr Rgb marking_color{1.0f, 0.0f, 1.0f};

} // namespace tessera
