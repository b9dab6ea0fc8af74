// Finds the pictures in the channels of an OpenEXR file, by the names that programs give to channels.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tessera {

/// Names of one part of an OpenEXR file.
struct ExrPart {
    std::string name; ///< empty: the file gives none
    bool is_deep = false;
    std::vector<std::string> channels; ///< in file order
};

/// Meaning of the channels of a layer.
enum class ExrContent {
    rgb,              ///< red, green, blue
    cie_xyz,          ///< CIE 1931 X, Y, Z
    luminance_chroma, ///< Y, RY, BY: luminance and colour differences
    vector,           ///< x, y, z of a vector, such as a normal
    single            ///< one number
};

/// A layer: one channel or three of a part.
struct ExrLayerNames {
    std::size_t part = 0;
    std::string layer; ///< what precedes R, G and B in the channels' names; or a lone channel's name
    std::string name;  ///< unique in the file: LAYER, PART, or PART:LAYER
    ExrContent content = ExrContent::rgb;
    std::vector<std::string> channels; ///< as the file spells them, in the order of `content`
};

/// Returns all layers of flat parts but alpha. Channels of three form a layer if they have one prefix
/// and end in R, G, B or X, Y, Z or Y, RY, BY, also in lower case or as red, green, blue. The prefix may be empty
/// or a lone dot. X, Y and Z without a prefix are a colour unless the file has another. All other channels are
/// single.
std::vector<ExrLayerNames> find_layers(const std::vector<ExrPart>& parts);

/// Chooses the picture of a file: the layer without a prefix that is a colour, else a lone Y, else the only
/// colour, else the only channel. Of several, the one that is called beauty, combined, rgba or rgb is the picture.
/// Throws std::runtime_error that lists the parts and channels if no rule applies.
ExrLayerNames choose_picture(const std::vector<ExrPart>& parts);

/// Chooses the layer that is called LAYER, PART, PART:LAYER, or as one channel; parts may be given by their
/// number, from 0. An empty name chooses as choose_picture(). Throws std::runtime_error that lists the parts and
/// channels.
ExrLayerNames choose_layer(const std::vector<ExrPart>& parts, const std::string& name);

/// Returns the parts and channels of a file, for messages: `part "depth": Z; part "beauty": B, G, R`.
std::string list_channels(const std::vector<ExrPart>& parts);

} // namespace tessera
