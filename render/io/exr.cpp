#include "render/io/exr.h"

#include "render/io/available_memory.h"
#include "render/io/files.h"

#include <algorithm>
#include <stdexcept>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

namespace tessera {

namespace {

int channel_count(ExrChannels channels) {
    return channels == ExrChannels::single ? 1 : 3;
}

/// Returns the full name of channel `i` of a layer: "R", "primal.R", "N.X", "Z".
std::string channel_name(const ExrLayer& layer, int i) {
    if (layer.channels == ExrChannels::single)
        return layer.name;
    const char channel = (layer.channels == ExrChannels::rgb ? "RGB" : "XYZ")[i];
    return layer.name.empty() ? std::string(1, channel) : layer.name + "." + channel;
}

/// Returns the memory layout of a channel.
Imf::Slice slice(const RgbImage& image, int channel) {
    // OpenEXR wants mutable memory for writing, too, but does not modify it.
    char* base = reinterpret_cast<char*>(const_cast<float*>(&image.data()->x) + channel);
    return {Imf::FLOAT, base, sizeof(Rgb), sizeof(Rgb) * static_cast<std::size_t>(image.width()), 1, 1, 0.0};
}

void check_layers(const ExrFile& file) {
    if (file.layers.empty() || file.layers.front().image.empty())
        throw std::runtime_error("there is no image to write");
    const RgbImage& first = file.layers.front().image;
    check_image_size(first.width(), first.height()); // larger images cannot be read again
    for (const ExrLayer& layer : file.layers)
        if (layer.image.width() != first.width() || layer.image.height() != first.height())
            throw std::runtime_error("layer \"" + layer.name + "\" differs in size from the first");
}

void write_layers(const std::filesystem::path& path, const ExrFile& file) {
    check_layers(file);
    const RgbImage& first = file.layers.front().image;
    Imf::Header header(first.width(), first.height());
    header.compression() = Imf::NO_COMPRESSION; // noise hardly compresses, and trying takes seconds
    for (const auto& [name, text] : file.attributes)
        header.insert(name, Imf::StringAttribute(text));
    Imf::FrameBuffer buffer;
    for (const ExrLayer& layer : file.layers) {
        for (int i = 0; i < channel_count(layer.channels); ++i) {
            const std::string name = channel_name(layer, i);
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            buffer.insert(name, slice(layer.image, i));
        }
    }
    Imf::OutputFile output(path.c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(first.height());
}

} // namespace

const RgbImage* find_layer(const ExrFile& file, const std::string& name) {
    const auto has_name = [&](const ExrLayer& layer) { return layer.name == name; };
    const auto found = std::find_if(file.layers.begin(), file.layers.end(), has_name);
    return found == file.layers.end() ? nullptr : &found->image;
}

const RgbImage& require_layer(const ExrFile& file, const std::string& name, const std::filesystem::path& path) {
    if (const RgbImage* image = find_layer(file, name))
        return *image;
    std::string message = path.string() + " has no layer \"" + name + "\", only:";
    for (const ExrLayer& layer : file.layers)
        message += " \"" + layer.name + "\"";
    throw std::runtime_error(message);
}

void write_exr(const std::filesystem::path& path, const ExrFile& file) {
    try {
        TemporaryFile temporary(path);
        write_layers(temporary.path(), file);
        temporary.commit();
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot write " + path.string() + ": " + message_of(error));
    }
}

} // namespace tessera
