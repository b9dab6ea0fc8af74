// Writes OpenEXR files as other programs do, without Tessera's code.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>

namespace tessera::test {

/// Channel of a file; `value(x, y)` at coordinates of the display window that are multiples of `step`.
struct ExrTestChannel {
    std::string name;
    std::function<float(int x, int y)> value;
    int step = 1;
};

/// Part of a file. Windows are inclusive.
struct ExrTestPart {
    std::vector<ExrTestChannel> channels;
    std::string name = {};
    Imath::Box2i data{{0, 0}, {7, 5}};
    Imath::Box2i display{{0, 0}, {7, 5}};
    const Imf::Chromaticities* primaries = nullptr;
};

/// Pixels of a part while it is written.
class ExrTestPixels {
public:
    explicit ExrTestPixels(const ExrTestPart& part)
        : header_(part.display, part.data), width_(part.data.max.x - part.data.min.x + 1),
          height_(part.data.max.y - part.data.min.y + 1) {
        if (!part.name.empty())
            header_.setName(part.name);
        header_.setType(Imf::SCANLINEIMAGE);
        if (part.primaries)
            Imf::addChromaticities(header_, *part.primaries);
        values_.reserve(part.channels.size());
        for (const ExrTestChannel& channel : part.channels)
            add(part, channel);
    }
    const Imf::Header& header() const { return header_; }
    const Imf::FrameBuffer& buffer() const { return buffer_; }
    int rows() const { return height_; }

private:
    void add(const ExrTestPart& part, const ExrTestChannel& channel) {
        const int step = channel.step, columns = width_ / step;
        header_.channels().insert(channel.name, Imf::Channel(Imf::FLOAT, step, step));
        std::vector<float>& values = values_.emplace_back();
        for (int y = 0; y < height_; y += step)
            for (int x = 0; x < width_; x += step)
                values.push_back(channel.value(part.data.min.x + x, part.data.min.y + y));
        const auto before = part.data.min.x / step + part.data.min.y / step * std::ptrdiff_t{columns};
        buffer_.insert(channel.name,
                       Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data() - before), sizeof(float),
                                  sizeof(float) * static_cast<std::size_t>(columns), step, step));
    }

    Imf::Header header_;
    int width_, height_;
    std::vector<std::vector<float>> values_;
    Imf::FrameBuffer buffer_;
};

/// Writes a file of one part, or of several.
inline void write_test_exr(const std::filesystem::path& path, const std::vector<ExrTestPart>& parts) {
    std::vector<ExrTestPixels> pixels(parts.begin(), parts.end());
    if (parts.size() == 1) {
        Imf::OutputFile file(path.c_str(), pixels[0].header());
        file.setFrameBuffer(pixels[0].buffer());
        file.writePixels(pixels[0].rows());
        return;
    }
    std::vector<Imf::Header> headers;
    for (const ExrTestPixels& part : pixels)
        headers.push_back(part.header());
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        Imf::OutputPart part(file, static_cast<int>(i));
        part.setFrameBuffer(pixels[i].buffer());
        part.writePixels(pixels[i].rows());
    }
}

/// Returns channels of constant value with these names.
inline std::vector<ExrTestChannel> constant_channels(const std::vector<std::pair<std::string, float>>& values) {
    std::vector<ExrTestChannel> channels;
    for (const auto& [name, value] : values)
        channels.push_back({name, [value = value](int, int) { return value; }});
    return channels;
}

} // namespace tessera::test
