#pragma once

#include "recon/image.h"
#include "render/io/exr.h"
#include "render/scene/sensor.h"

#include <filesystem>

namespace tessera {

/// The layer with alpha: the covered fraction of each pixel.
inline constexpr const char* alpha_layer = "A";

/// Throws BadInput for a format without red, green and blue: the buffers of a picture belong to these.
void check_has_rgb(PixelFormat format);

/// Converts the first layer, plain RGB, to a pixel format: to the channel Y, to X, Y and Z [IEC 61966-2-1], or not
/// at all. A file that has the buffers of a reconstruction keeps RGB. Appends the layer A for a format with alpha.
/// Samples are premultiplied by alpha without any change: where nothing is seen, there is no light. A
/// reconstruction may spread light to such pixels.
/// @param coverage  alpha of each pixel; empty for a format without alpha
void set_pixel_format(ExrFile& file, PixelFormat format, const Image<float>& coverage);

/// Writes the first layer as PNG: grey or RGB, with the layer A as alpha if there is one. The colours of a PNG
/// are not premultiplied, so light where alpha is 0 is lost. Throws std::runtime_error that names the file.
void write_first_layer(const std::filesystem::path& path, const ExrFile& file);

} // namespace tessera
