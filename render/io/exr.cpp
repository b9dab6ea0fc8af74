#include "render/io/exr.h"

#include "render/io/available_memory.h"
#include "render/io/files.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <set>
#include <stdexcept>
#include <utility>

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

namespace tessera {

namespace {

constexpr int rows_per_call = 64; // rows read between calls of the watch; not tuned

/// Name and channels of a layer.
struct LayerName {
    std::string name;
    ExrChannels channels = ExrChannels::rgb;
};

int channel_count(ExrChannels channels) {
    return channels == ExrChannels::single ? 1 : 3;
}

/// Returns the full name of channel `i` of a layer: "R", "primal.R", "N.X", "Z".
std::string channel_name(const LayerName& layer, int i) {
    if (layer.channels == ExrChannels::single)
        return layer.name;
    const char channel = (layer.channels == ExrChannels::rgb ? "RGB" : "XYZ")[i];
    return layer.name.empty() ? std::string(1, channel) : layer.name + "." + channel;
}

/// Returns the memory layout of channel `channel`, for an image whose first pixel is (first_x, first_y) of the
/// file.
Imf::Slice slice(const RgbImage& image, int channel, int first_x = 0, int first_y = 0) {
    const std::size_t row = sizeof(Rgb) * static_cast<std::size_t>(image.width());
    const auto first_pixel =
        static_cast<std::ptrdiff_t>(sizeof(Rgb)) * first_x + static_cast<std::ptrdiff_t>(row) * first_y;
    // OpenEXR wants mutable memory for writing, too, but does not modify it.
    char* base = reinterpret_cast<char*>(const_cast<float*>(&image.data()->x) + channel);
    return {Imf::FLOAT, base - first_pixel, sizeof(Rgb), row, 1, 1, 0.0};
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
            const std::string name = channel_name({layer.name, layer.channels}, i);
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            buffer.insert(name, slice(layer.image, i));
        }
    }
    Imf::OutputFile output(path.c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(first.height());
}

/// Returns whether the plain layer is a lone Y.
bool is_grey(const Imf::ChannelList& channels) {
    return !channels.findChannel("R") && channels.findChannel("Y");
}

/// Returns whether the file has all channels of a layer.
bool has_layer(const Imf::ChannelList& channels, const LayerName& layer) {
    for (int i = 0; i < channel_count(layer.channels); ++i)
        if (!channels.findChannel(channel_name(layer, i)))
            return false;
    return true;
}

/// Returns the layers of three channels: the plain one, then RGB and then XYZ layers in file order.
std::vector<LayerName> layers_of_three(const Imf::ChannelList& channels) {
    std::vector<LayerName> layers;
    if (has_layer(channels, {""}) || channels.findChannel("Y"))
        layers.push_back({""});
    for (const auto& [suffix, kind] : {std::pair(".R", ExrChannels::rgb), std::pair(".X", ExrChannels::xyz)})
        for (auto c = channels.begin(); c != channels.end(); ++c) {
            const std::string name = c.name();
            if (!name.ends_with(suffix))
                continue;
            const LayerName layer{name.substr(0, name.size() - 2), kind};
            if (!layer.name.empty() && has_layer(channels, layer))
                layers.push_back(layer);
        }
    return layers;
}

/// Returns all layers: those with three channels, then one for each other channel but alpha.
std::vector<LayerName> layers_in(const Imf::ChannelList& channels) {
    std::vector<LayerName> layers = layers_of_three(channels);
    std::set<std::string> taken;
    for (const LayerName& layer : layers)
        for (int i = 0; i < channel_count(layer.channels); ++i)
            taken.insert(channel_name(layer, i));
    if (is_grey(channels))
        taken.insert("Y");
    for (auto c = channels.begin(); c != channels.end(); ++c) {
        const std::string name = c.name();
        if (!taken.contains(name) && name != "A" && !name.ends_with(".A"))
            layers.push_back({name, ExrChannels::single});
    }
    return layers;
}

struct Size {
    int width, height;
};

Size size_of(const Imath::Box2i& window, std::uintmax_t file_bytes) {
    const auto width = std::int64_t{window.max.x} - window.min.x + 1;
    const auto height = std::int64_t{window.max.y} - window.min.y + 1;
    check_image_size(width, height, file_bytes);
    return {static_cast<int>(width), static_cast<int>(height)};
}

void read_rows(Imf::InputPart& part, int first, int last, const ReadProgress& watch) {
    const auto row = [&](std::int64_t n) { return static_cast<int>(std::min<std::int64_t>(first + n, last)); };
    const std::int64_t count = std::int64_t{last} - first + 1;
    for (std::int64_t done = 0; done < count; done += rows_per_call) {
        if (watch && !watch(static_cast<float>(done) / static_cast<float>(count)))
            throw std::runtime_error("reading was cancelled");
        part.readPixels(row(done), row(done + rows_per_call - 1));
    }
}

std::map<std::string, std::string> attributes_of(const Imf::Header& header) {
    std::map<std::string, std::string> attributes;
    for (auto a = header.begin(); a != header.end(); ++a)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
            attributes[a.name()] = text->value();
    return attributes;
}

/// Asks for the memory of reading: the pixels, and a chunk of rows of all channels, which OpenEXR decompresses.
void ask_for_layers(const Imf::Header& header, Size size, std::size_t layers) {
    constexpr std::uint64_t max_rows_per_chunk = 256; // in DWAB compression
    std::uint64_t channels = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
        ++channels;
    const auto width = static_cast<std::uint64_t>(size.width), height = static_cast<std::uint64_t>(size.height);
    require_memory(sizeof(Rgb) * width * height * layers +
                       2 * sizeof(float) * width * std::min(height, max_rows_per_chunk) * channels,
                   "its pixels");
}

/// Selects the layers to read from those of the file.
using LayerChoice = std::function<std::vector<LayerName>(const std::vector<LayerName>& available)>;

ExrFile read_layers(Imf::MultiPartInputFile& input, std::uintmax_t file_bytes, const ReadProgress& watch,
                    const LayerChoice& choose) {
    Imf::InputPart part(input, 0);
    const Imf::Header& header = part.header();
    const Imath::Box2i window = header.dataWindow();
    const Size size = size_of(window, file_bytes);
    const Imf::ChannelList& channels = header.channels();
    const std::vector<LayerName> available = layers_in(channels);
    if (available.empty() || available.front().channels != ExrChannels::rgb)
        throw std::runtime_error("it has no R, G and B channels");
    const std::vector<LayerName> chosen = choose(available);
    ask_for_layers(header, size, chosen.size());
    ExrFile file;
    for (const LayerName& layer : chosen)
        file.layers.push_back({layer.name, RgbImage(size.width, size.height), layer.channels});
    const auto is_single = [&](const ExrLayer& layer) {
        return layer.channels == ExrChannels::single || (layer.name.empty() && is_grey(channels));
    };
    Imf::FrameBuffer buffer;
    for (const ExrLayer& layer : file.layers) {
        // A lone Y is read as the single channel of the layer "".
        const LayerName name = is_single(layer)
                                   ? LayerName{layer.name.empty() ? "Y" : layer.name, ExrChannels::single}
                                   : LayerName{layer.name, layer.channels};
        for (int i = 0; i < channel_count(name.channels); ++i)
            buffer.insert(channel_name(name, i), slice(layer.image, i, window.min.x, window.min.y));
    }
    part.setFrameBuffer(buffer);
    read_rows(part, window.min.y, window.max.y, watch);
    for (ExrLayer& layer : file.layers)
        if (is_single(layer))
            for (Rgb& pixel : layer.image)
                pixel = Rgb(pixel.r);
    file.attributes = attributes_of(header);
    return file;
}

/// Gives OpenEXR access to a file in memory.
class MemoryStream : public Imf::IStream {
public:
    explicit MemoryStream(std::string_view bytes) : Imf::IStream("a picture"), bytes_(bytes) {}

    bool read(char data[], int count) override {
        if (count < 0 || static_cast<std::size_t>(count) > bytes_.size() - at_)
            throw std::runtime_error("the file ends too early");
        std::memcpy(data, bytes_.data() + at_, static_cast<std::size_t>(count));
        at_ += static_cast<std::size_t>(count);
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t at) override { at_ = std::min<std::uint64_t>(at, bytes_.size()); }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

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

bool is_exr(std::string_view bytes) {
    return bytes.starts_with("\x76\x2f\x31\x01");
}

RgbImage parse_exr_picture(std::string_view bytes, const ReadProgress& watch) {
    MemoryStream stream(bytes);
    Imf::MultiPartInputFile input(stream);
    ExrFile file = read_layers(input, bytes.size(), watch, [](const std::vector<LayerName>& available) {
        return std::vector<LayerName>{available.front()}; // the plain layer comes first
    });
    return std::move(file.layers.front().image);
}

ExrFile read_exr(const std::filesystem::path& path, const ReadProgress& watch,
                 const std::vector<std::string>& names) {
    try {
        open_file(path); // throws with a better reason than OpenEXR
        Imf::MultiPartInputFile input(path.c_str());
        return read_layers(input, std::filesystem::file_size(path), watch,
                           [&](const std::vector<LayerName>& available) {
                               std::vector<LayerName> layers;
                               for (const LayerName& layer : available)
                                   if (names.empty() || std::ranges::find(names, layer.name) != names.end())
                                       layers.push_back(layer);
                               return layers;
                           });
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot read " + path.string() + ": " + message_of(error));
    }
}

std::map<std::string, std::string> read_exr_attributes(const std::filesystem::path& path) {
    try {
        open_file(path);
        return attributes_of(Imf::MultiPartInputFile(path.c_str()).header(0));
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot read " + path.string() + ": " + message_of(error));
    }
}

} // namespace tessera
