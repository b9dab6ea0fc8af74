#include "render/io/available_memory.h"
#include "render/io/exr.h"
#include "render/io/exr_color.h"
#include "render/io/exr_layers.h"
#include "render/io/files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

namespace tessera {

namespace {

constexpr int rows_per_call = 64; // rows read between calls of the watch; not tuned

std::vector<ExrPart> parts_of(const Imf::MultiPartInputFile& input) {
    std::vector<ExrPart> parts;
    for (int i = 0; i < input.parts(); ++i) {
        const Imf::Header& header = input.header(i);
        ExrPart& part = parts.emplace_back();
        part.name = header.hasName() ? header.name() : "";
        part.is_deep = header.hasType() && Imf::isDeepData(header.type());
        for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
            part.channels.emplace_back(c.name());
    }
    return parts;
}

PixelRect rect_of(const Imath::Box2i& window) {
    return {window.min.x, window.min.y, window.max.x + 1, window.max.y + 1};
}

void check_window(const Imath::Box2i& window, std::uintmax_t file_bytes) {
    check_image_size(std::int64_t{window.max.x} - window.min.x + 1, std::int64_t{window.max.y} - window.min.y + 1,
                     file_bytes);
}

/// Asks for the memory of reading: the pixels, and a chunk of rows of all channels, which OpenEXR decompresses.
void ask_for_layers(const Imf::Header& header, std::size_t layers) {
    constexpr std::uint64_t max_rows_per_chunk = 256; // in DWAB compression
    std::uint64_t channels = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
        ++channels;
    const PixelRect data = rect_of(header.dataWindow());
    const auto width = static_cast<std::uint64_t>(data.width()),
               height = static_cast<std::uint64_t>(data.height());
    require_memory(sizeof(Rgb) * width * height * layers +
                       2 * sizeof(float) * width * std::min(height, max_rows_per_chunk) * channels,
                   "its pixels");
}

Chromaticities primaries_of(const Imf::Header& header) {
    if (!Imf::hasChromaticities(header))
        return {};
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    return {{c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}};
}

/// Reading of layers of one part.
class PartReader {
public:
    PartReader(Imf::MultiPartInputFile& input, std::size_t part)
        : part_(input, static_cast<int>(part)), header_(part_.header()), window_(header_.dataWindow()) {}

    /// Reads the layers in their order in `names`.
    std::vector<ExrLayer> read(const std::vector<ExrLayerNames>& names, const ReadProgress& watch) {
        ask_for_layers(header_, names.size());
        const PixelRect data = rect_of(window_);
        std::vector<ExrLayer> layers;
        for (const ExrLayerNames& layer : names)
            layers.push_back({layer.name, RgbImage(data.width(), data.height()), channels_of(layer.content), data,
                              rect_of(header_.displayWindow())});
        for (std::size_t i = 0; i < names.size(); ++i)
            for (std::size_t c = 0; c < names[i].channels.size(); ++c)
                add_channel(names[i].channels[c], layers[i].image, static_cast<int>(c));
        part_.setFrameBuffer(buffer_);
        read_rows(watch);
        for (const Subsampled& channel : subsampled_)
            fill(channel);
        for (std::size_t i = 0; i < names.size(); ++i)
            convert(layers[i].image, names[i].content);
        return layers;
    }

private:
    /// A channel with samples at every `step`-th column and row.
    struct Subsampled {
        RgbImage* image;
        int channel;
        glm::ivec2 step;
        Image<float> samples;
    };

    static ExrChannels channels_of(ExrContent content) {
        if (content == ExrContent::single)
            return ExrChannels::single;
        return content == ExrContent::vector ? ExrChannels::xyz : ExrChannels::rgb;
    }

    void add_channel(const std::string& name, RgbImage& image, int channel) {
        const Imf::Channel& c = *header_.channels().findChannel(name);
        const glm::ivec2 step(c.xSampling, c.ySampling);
        if (step == glm::ivec2(1)) {
            insert(name, &image.data()->x + channel, sizeof(Rgb), image.width(), step);
            return;
        }
        // OpenEXR rejects windows that are not a multiple of the step.
        subsampled_.push_back({&image, channel, step, {image.width() / step.x, image.height() / step.y}});
        if (subsampled_.back().samples.empty())
            throw std::runtime_error("its channel " + name + " has no samples");
        insert(name, subsampled_.back().samples.data(), sizeof(float), image.width() / step.x, step);
    }

    /// Has a channel read to `first`, its first sample in the window.
    void insert(const std::string& name, float* first, std::size_t stride, int width, glm::ivec2 step) {
        const std::size_t row = stride * static_cast<std::size_t>(width);
        const auto before = static_cast<std::ptrdiff_t>(stride) * (window_.min.x / step.x) +
                            static_cast<std::ptrdiff_t>(row) * (window_.min.y / step.y);
        buffer_.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first) - before, stride, row, step.x,
                                        step.y, 0.0));
    }

    void read_rows(const ReadProgress& watch) {
        const std::int64_t first = window_.min.y, count = std::int64_t{window_.max.y} - first + 1;
        const auto row = [&](std::int64_t n) {
            return static_cast<int>(std::min<std::int64_t>(first + n, window_.max.y));
        };
        for (std::int64_t done = 0; done < count; done += rows_per_call) {
            if (watch && !watch(static_cast<float>(done) / static_cast<float>(count)))
                throw std::runtime_error("reading was cancelled");
            part_.readPixels(row(done), row(done + rows_per_call - 1));
        }
    }

    static void fill(const Subsampled& channel) {
        RgbImage& image = *channel.image;
        const Image<float> whole = upsampled(channel.samples, channel.step, image.width(), image.height());
        for (std::size_t i = 0; i < image.size(); ++i)
            image.data()[i][channel.channel] = whole.data()[i];
    }

    /// Converts channels as they are in the file to an image with Rec. 709 primaries, or repeats a single one.
    void convert(RgbImage& image, ExrContent content) const {
        if (content == ExrContent::single)
            std::ranges::transform(image, image.begin(), [](Rgb c) { return Rgb(c.r); });
        if (content == ExrContent::cie_xyz)
            std::ranges::transform(image, image.begin(), rgb_of_xyz);
        if (content == ExrContent::luminance_chroma) {
            const glm::dmat3 to_xyz = xyz_of_primaries(primaries_of(header_));
            const glm::dvec3 weights(to_xyz[0].y, to_xyz[1].y, to_xyz[2].y);
            if (std::abs(weights.g) < 1e-6)
                throw std::runtime_error("the chromaticities in its header give green no luminance");
            std::ranges::transform(image, image.begin(),
                                   [&](Rgb c) { return rgb_of_luminance_chroma(c, weights); });
        }
        if (content != ExrContent::rgb && content != ExrContent::luminance_chroma)
            return;
        if (const std::optional<glm::dmat3> to_rec709 = rec709_of_primaries(primaries_of(header_)))
            std::ranges::transform(image, image.begin(), [&](Rgb c) { return Rgb(*to_rec709 * glm::dvec3(c)); });
    }

    Imf::InputPart part_;
    Imf::Header header_;
    Imath::Box2i window_;
    Imf::FrameBuffer buffer_;
    std::deque<Subsampled> subsampled_;
};

/// Returns notes on what was chosen and converted, for a layer that no name selects.
std::vector<std::string> notes_of(const std::vector<ExrPart>& parts, const ExrLayerNames& layer,
                                  const std::string& name, const Imf::Header& header) {
    std::vector<std::string> notes;
    if (name.empty() && parts.size() > 1)
        notes.push_back("its part " + std::to_string(layer.part) + " \"" + parts[layer.part].name + "\" is used");
    const bool is_lone_channel = layer.content == ExrContent::single && layer.layer != "Y";
    if (name.empty() && !layer.layer.empty() && layer.layer != "Y")
        notes.push_back((is_lone_channel ? "its channel \"" : "its layer \"") + layer.layer + "\" is used" +
                        (is_lone_channel ? " as grey" : ""));
    if (layer.content == ExrContent::cie_xyz)
        notes.emplace_back("its X, Y and Z are converted to linear sRGB");
    if (layer.content == ExrContent::luminance_chroma)
        notes.emplace_back("its Y, RY and BY are converted to red, green and blue");
    const bool has_primaries = layer.content == ExrContent::rgb || layer.content == ExrContent::luminance_chroma;
    if (has_primaries && rec709_of_primaries(primaries_of(header)))
        notes.emplace_back("its colours are converted from the primaries in its header to sRGB");
    return notes;
}

std::map<std::string, std::string> attributes_of(const Imf::Header& header) {
    std::map<std::string, std::string> attributes;
    for (auto a = header.begin(); a != header.end(); ++a)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
            attributes[a.name()] = text->value();
    return attributes;
}

ExrFile read_layers(Imf::MultiPartInputFile& input, std::uintmax_t file_bytes,
                    const std::vector<ExrLayerNames>& names, const ReadProgress& watch) {
    ExrFile file;
    file.attributes = attributes_of(input.header(0));
    std::set<std::size_t> parts;
    for (const ExrLayerNames& layer : names)
        parts.insert(layer.part);
    for (const std::size_t part : parts)
        check_window(input.header(static_cast<int>(part)).dataWindow(), file_bytes);
    std::size_t done = 0;
    for (const std::size_t part : parts) {
        std::vector<ExrLayerNames> of_part;
        std::ranges::copy_if(names, std::back_inserter(of_part),
                             [part](const ExrLayerNames& l) { return l.part == part; });
        const auto watch_part = [&](float fraction) {
            return !watch || watch((static_cast<float>(done) + fraction) / static_cast<float>(parts.size()));
        };
        std::ranges::move(PartReader(input, part).read(of_part, watch_part), std::back_inserter(file.layers));
        ++done;
    }
    return file;
}

Picture read_picture(Imf::MultiPartInputFile& input, std::uintmax_t file_bytes, const std::string& name,
                     const ReadProgress& watch) {
    const std::vector<ExrPart> parts = parts_of(input);
    const ExrLayerNames layer = choose_layer(parts, name);
    ExrFile file = read_layers(input, file_bytes, {layer}, watch);
    ExrLayer& read = file.layers.front();
    return {std::move(read.image), read.data, read.display,
            notes_of(parts, layer, name, input.header(static_cast<int>(layer.part)))};
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

/// Chooses the layers to read; `names` as of read_exr().
std::vector<ExrLayerNames> choose_layers(const std::vector<ExrPart>& parts,
                                         const std::vector<std::string>& names) {
    const std::vector<ExrLayerNames> available = find_layers(parts);
    if (names.empty())
        return available;
    std::vector<ExrLayerNames> chosen;
    for (const std::string& name : names) {
        const auto found = std::ranges::find(available, name, &ExrLayerNames::name);
        if (!name.empty() && found == available.end())
            continue;
        ExrLayerNames layer = name.empty() ? choose_picture(parts) : *found;
        layer.name = name;
        if (std::ranges::none_of(chosen, [&](const ExrLayerNames& other) {
                return other.part == layer.part && other.channels == layer.channels;
            }))
            chosen.push_back(std::move(layer));
    }
    return chosen;
}

} // namespace

bool is_exr(std::string_view bytes) {
    return bytes.starts_with("\x76\x2f\x31\x01");
}

bool is_exr_file(const std::filesystem::path& path) {
    try {
        std::ifstream file = open_file(path);
        char signature[4] = {};
        file.read(signature, sizeof signature);
        return is_exr({signature, sizeof signature});
    } catch (const std::exception& error) {
        throw std::runtime_error("cannot read " + path.string() + ": " + message_of(error));
    }
}

Picture parse_exr_picture(std::string_view bytes, const std::string& layer, const ReadProgress& watch) {
    MemoryStream stream(bytes);
    Imf::MultiPartInputFile input(stream);
    return read_picture(input, bytes.size(), layer, watch);
}

ExrFile read_exr(const std::filesystem::path& path, const ReadProgress& watch,
                 const std::vector<std::string>& names) {
    try {
        open_file(path); // throws with a better reason than OpenEXR
        Imf::MultiPartInputFile input(path.c_str());
        const std::vector<ExrLayerNames> chosen = choose_layers(parts_of(input), names);
        return read_layers(input, std::filesystem::file_size(path), chosen, watch);
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
