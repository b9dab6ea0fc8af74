#pragma once

#include "recon/image.h"
#include "render/io/picture_formats.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// Channels of an EXR layer.
enum class ExrChannels {
    rgb,   ///< NAME.R, NAME.G, NAME.B; R, G, B for the empty name
    xyz,   ///< NAME.X, NAME.Y, NAME.Z: a vector
    single ///< NAME: one number, repeated in red, green and blue of the image
};

/// One image of an EXR file; the layer with the empty name is plain R, G, B.
struct ExrLayer {
    std::string name;
    RgbImage image;
    ExrChannels channels = ExrChannels::rgb;
    PixelRect data{}, display{}; ///< windows of a file that was read, as in Picture; not used for writing
};

/// Layers of an EXR file, and string attributes of its first header. Layers to write must have one size.
struct ExrFile {
    std::vector<ExrLayer> layers;
    std::map<std::string, std::string> attributes;
};

/// Returns the layer of that name; null: there is none.
const RgbImage* find_layer(const ExrFile& file, const std::string& name);

/// Returns the layer of that name of a file read from `path`. Throws std::runtime_error that names the file and
/// its layers.
const RgbImage& require_layer(const ExrFile& file, const std::string& name, const std::filesystem::path& path);

/// Writes one part of 32-bit floats through a TemporaryFile. Throws std::runtime_error that names the file.
void write_exr(const std::filesystem::path& path, const ExrFile& file);

/// Callback during reading. Receives the fraction done, in [0, 1], and returns false to cancel.
using ReadProgress = std::function<bool(float fraction)>;

/// Reads layers of all parts but deep ones, named as in ExrLayerNames::name (render/io/exr_layers.h), and the
/// first header's string attributes. Colours become linear with Rec. 709 primaries, a lone channel is repeated,
/// and alpha is left out. `names` selects layers, as far as the file has them; the empty name is the picture of
/// choose_picture(), whatever it is called in the file. Empty: all layers. Layers not selected take no memory.
/// Throws std::runtime_error that names the file, also if the empty name is in `names` and the file has no
/// picture, if `watch` (may be empty) cancels, and if memory is short (require_memory).
ExrFile read_exr(const std::filesystem::path& path, const ReadProgress& watch = {},
                 const std::vector<std::string>& names = {});

/// Returns whether the bytes have the signature of OpenEXR.
bool is_exr(std::string_view bytes);

/// Returns whether the file has that signature. Throws std::runtime_error that names the file if it cannot be
/// opened.
bool is_exr_file(const std::filesystem::path& path);

/// Reads the layer that choose_layer() chooses (render/io/exr_layers.h) of an OpenEXR file in memory. Throws as
/// read_exr() does, without a file name.
Picture parse_exr_picture(std::string_view bytes, const std::string& layer, const ReadProgress& watch);

/// Reads the string attributes only. Throws std::runtime_error that names the file.
std::map<std::string, std::string> read_exr_attributes(const std::filesystem::path& path);

} // namespace tessera
