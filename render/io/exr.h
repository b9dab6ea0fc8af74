#pragma once

#include "recon/image.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// The channels of an EXR layer.
enum class ExrChannels {
    rgb,   ///< NAME.R, NAME.G, NAME.B; R, G, B for the empty name
    xyz,   ///< NAME.X, NAME.Y, NAME.Z: a vector
    single ///< one channel, NAME: a number, which the image holds in red, green and blue
};

/// One named image of an EXR file; the empty name is the file's plain R, G, B.
struct ExrLayer {
    std::string name;
    RgbImage image;
    ExrChannels channels = ExrChannels::rgb;
};

/// A single-part EXR in 32-bit floats: layers of one size and string attributes of the header.
struct ExrFile {
    std::vector<ExrLayer> layers;
    std::map<std::string, std::string> attributes;
};

/// The layer of that name; null: there is none.
const RgbImage* find_layer(const ExrFile& file, const std::string& name);

/// The layer of that name of a file read from `path`. Throws std::runtime_error that names the file and the layers
/// there are.
const RgbImage& require_layer(const ExrFile& file, const std::string& name, const std::filesystem::path& path);

/// Writes to a temporary name beside `path` and renames it. Throws std::runtime_error that names the file.
void write_exr(const std::filesystem::path& path, const ExrFile& file);

/// A watch of a file that is read: it is told now and then which share is done, [0, 1], and says whether to go on.
/// False: the file is wanted no more.
using ReadWatch = std::function<bool(float share)>;

/// Reads the first part of a file: layers with R, G and B channels (a lone plain Y counts as grey), named layers
/// with X, Y and Z, every other channel but alpha as a layer of its own, and the header's string attributes.
/// `wanted` names the layers to read, where the file has them; empty: all. Other layers cost no memory. Throws
/// std::runtime_error that names the file: where it has no R, G and B, where `watch` (may be empty) ends the read,
/// and where memory is short (ask_for_memory).
ExrFile read_exr(const std::filesystem::path& path, const ReadWatch& watch = {},
                 const std::vector<std::string>& wanted = {});

/// Whether the bytes begin as an OpenEXR file does.
bool is_exr(std::string_view bytes);

/// Reads the plain layer of a file in memory, or its first RGB layer where it has no plain one. Throws as read_exr
/// does, without the file's name.
RgbImage parse_exr_picture(std::string_view bytes, const ReadWatch& watch);

/// The string attributes alone, without reading a pixel. Throws std::runtime_error that names the file.
std::map<std::string, std::string> read_exr_attributes(const std::filesystem::path& path);

} // namespace tessera
