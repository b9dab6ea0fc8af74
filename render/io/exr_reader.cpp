#include "render/io/available_memory.h"
#include "render/io/exr.h"
#include "render/io/exr_color.h"
#include "render/io/exr_layers.h"
#include "render/io/exr_part.h"
#include "render/io/files.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

namespace tessera {

namespace {

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

void check_window(const Imath::Box2i& window, std::uintmax_t file_bytes) {
    check_image_size(std::int64_t{window.max.x} - window.min.x + 1, std::int64_t{window.max.y} - window.min.y + 1,
                     file_bytes);
}

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
        std::ranges::move(read_part(input, part, of_part, watch_part), std::back_inserter(file.layers));
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
