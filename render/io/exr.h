#pragma once

#include "recon/image.h"

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
};

/// A single-part EXR file in 32-bit floats: layers of equal size, and string attributes of the header.
struct ExrFile {
    std::vector<ExrLayer> layers;
    std::map<std::string, std::string> attributes;
};

/// Returns the layer of that name; null: there is none.
const RgbImage* find_layer(const ExrFile& file, const std::string& name);

/// Returns the layer of that name of a file read from `path`. Throws std::runtime_error that names the file and
/// its layers.
const RgbImage& require_layer(const ExrFile& file, const std::string& name, const std::filesystem::path& path);

/// Writes the file through a TemporaryFile. Throws std::runtime_error that names the file.
void write_exr(const std::filesystem::path& path, const ExrFile& file);

/// Callback during reading. Receives the fraction done, in [0, 1], and returns false to cancel.
using ReadProgress = std::function<bool(float fraction)>;

/// Reads the first part of a file: layers with channels R, G and B (a lone plain Y is grey), named layers with
/// X, Y and Z, every other channel but alpha as a layer of its own, and the header's string attributes. `names`
/// selects layers, as far as the file has them; empty: all. Layers not selected take no memory. Throws
/// std::runtime_error that names the file, also if there is no R, G and B, if `watch` (may be empty) cancels,
/// and if memory is short (require_memory).
ExrFile read_exr(const std::filesystem::path& path, const ReadProgress& watch = {},
                 const std::vector<std::string>& names = {});

/// Returns whether the bytes have the signature of OpenEXR.
bool is_exr(std::string_view bytes);

/// Reads the plain layer of an OpenEXR file in memory, or its first RGB layer if there is no plain one. Throws
/// as read_exr() does, without a file name.
RgbImage parse_exr_picture(std::string_view bytes, const ReadProgress& watch);

/// Reads the string attributes only. Throws std::runtime_error that names the file.
std::map<std::string, std::string> read_exr_attributes(const std::filesystem::path& path);

} // namespace tessera
