#include "render/io/exr_part.h"

#include "render/io/available_memory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <stdexcept>
#include <string>

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

namespace tessera {

namespace {

constexpr int rows_per_call = 64; // rows read between calls of the watch; not tuned

PixelRect rect_of(const Imath::Box2i& window) {
    return {window.min.x, window.min.y, window.max.x + 1, window.max.y + 1};
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

/// Reads layers of one part.
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

} // namespace

Chromaticities primaries_of(const Imf::Header& header) {
    if (!Imf::hasChromaticities(header))
        return {};
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    return {{c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}};
}

std::vector<ExrLayer> read_part(Imf::MultiPartInputFile& input, std::size_t part,
                                const std::vector<ExrLayerNames>& names, const ReadProgress& watch) {
    return PartReader(input, part).read(names, watch);
}

} // namespace tessera
