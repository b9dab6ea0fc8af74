#pragma once

#include "recon/image.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

/// One named RGB image of an EXR file; the empty name is the file's plain R, G, B.
struct ExrLayer {
    std::string name; ///< "primal" becomes the channels primal.R, primal.G, primal.B
    RgbImage image;
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

/// Reads layers with R, G and B channels (a lone Y counts as grey; of a multi-part file the first part), and the
/// header's string attributes. `wanted` names those that are read if they are there, all the others cost nothing;
/// empty: all. Throws std::runtime_error that names the file, also where `watch`, which may be empty, wants it no
/// more, and where there is no memory for it (ask_for_memory).
ExrFile read_exr(const std::filesystem::path& path, const ReadWatch& watch = {},
                 const std::vector<std::string>& wanted = {});

/// Whether the bytes begin as an OpenEXR file does.
bool is_exr(std::string_view bytes);

/// Reads the plain layer of a file in memory, or the first where there is none, and nothing else. Throws as
/// read_exr does, but names nothing.
RgbImage parse_exr_picture(std::string_view bytes, const ReadWatch& watch);

/// The string attributes alone, without reading a pixel. Throws std::runtime_error that names the file.
std::map<std::string, std::string> read_exr_attributes(const std::filesystem::path& path);

} // namespace tessera
