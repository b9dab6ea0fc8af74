#include "render/io/exr_layers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace tessera {

namespace {

using Layers = std::vector<ExrLayerNames>;

std::string lower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

/// Returns the channel's name without its prefix, in lower case and short form: "r" for "Beauty.R" and "rgba.red".
std::string short_name(std::string_view channel) {
    const std::string name = lower(channel.substr(channel.rfind('.') + 1)); // npos + 1 is 0
    for (const auto& [whole, letter] :
         {std::pair("red", "r"), std::pair("green", "g"), std::pair("blue", "b"), std::pair("alpha", "a")})
        if (name == whole)
            return letter;
    return name;
}

/// Returns what precedes the last dot, with the dot; empty: there is no dot.
std::string prefix_of(std::string_view channel) {
    return std::string(channel.substr(0, channel.rfind('.') + 1));
}

bool is_colour(const ExrLayerNames& layer) {
    return layer.content != ExrContent::vector && layer.content != ExrContent::single;
}

constexpr std::pair<ExrContent, std::array<const char*, 3>> triples[] = {
    {ExrContent::rgb, {"r", "g", "b"}},
    {ExrContent::luminance_chroma, {"y", "ry", "by"}},
    {ExrContent::vector, {"x", "y", "z"}},
};

/// Channels of one prefix, by short name.
using Group = std::map<std::string, std::string>;

/// Finds the layers of one part.
class PartLayers {
public:
    PartLayers(std::size_t index, const ExrPart& part) : index_(index) {
        for (const std::string& channel : part.channels)
            groups_[prefix_of(channel)].emplace(short_name(channel), channel);
        for (const auto& [prefix, group] : groups_)
            add_triple(prefix, group);
        for (const std::string& channel : part.channels)
            if (!taken_.contains(channel) && short_name(channel) != "a")
                layers_.push_back({index_, channel, "", ExrContent::single, {channel}});
    }
    Layers take() { return std::move(layers_); }

private:
    void add_triple(const std::string& prefix, const Group& group) {
        for (const auto& [content, names] : triples) {
            std::vector<std::string> channels;
            for (const char* name : names)
                if (const auto found = group.find(name); found != group.end())
                    channels.push_back(found->second);
            if (channels.size() < names.size())
                continue;
            taken_.insert(channels.begin(), channels.end());
            layers_.push_back({index_, free_name(prefix), "", content, std::move(channels)});
            return;
        }
    }
    /// Returns the prefix without its dot, unless another layer has that name.
    std::string free_name(const std::string& prefix) const {
        std::string name = prefix.substr(0, prefix.empty() ? 0 : prefix.size() - 1);
        return std::ranges::find(layers_, name, &ExrLayerNames::layer) == layers_.end() ? name : prefix;
    }

    std::size_t index_;
    std::map<std::string, Group> groups_;
    std::set<std::string> taken_;
    Layers layers_;
};

std::string part_name(const std::vector<ExrPart>& parts, std::size_t part) {
    return parts[part].name.empty() ? std::to_string(part) : parts[part].name;
}

/// Gives each layer a name that no other has.
void name_layers(const std::vector<ExrPart>& parts, Layers& layers) {
    std::map<std::string, int> count;
    for (const ExrLayerNames& layer : layers)
        ++count[layer.layer];
    for (ExrLayerNames& layer : layers) {
        const bool is_unique = parts.size() == 1 || (count[layer.layer] == 1 && !layer.layer.empty());
        const std::string part = part_name(parts, layer.part);
        layer.name = is_unique ? layer.layer : layer.layer.empty() ? part : part + ":" + layer.layer;
    }
}

/// Returns whether the layer is called as programs call their picture.
bool is_called_picture(const std::vector<ExrPart>& parts, const ExrLayerNames& layer) {
    const std::string whole = layer.layer.empty() ? parts[layer.part].name : layer.layer;
    const std::string name = lower(whole.substr(whole.rfind('.') + 1));
    return name == "beauty" || name == "combined" || name == "rgba" || name == "rgb";
}

[[noreturn]] void refuse(const std::vector<ExrPart>& parts, const std::string& reason) {
    throw std::runtime_error(reason + "; its channels are " + list_channels(parts));
}

/// Returns the only layer with a property, or the only one of these that is called a picture; empty: there is
/// none. Throws if there are several.
std::optional<ExrLayerNames> only_layer(const std::vector<ExrPart>& parts, const Layers& layers,
                                        const std::function<bool(const ExrLayerNames&)>& fits) {
    Layers found;
    std::ranges::copy_if(layers, std::back_inserter(found), fits);
    if (found.size() > 1)
        if (std::ranges::count_if(found, [&](const auto& l) { return is_called_picture(parts, l); }) == 1)
            return *std::ranges::find_if(found, [&](const auto& l) { return is_called_picture(parts, l); });
    if (found.size() > 1) {
        std::string names;
        for (const ExrLayerNames& layer : found)
            names += (names.empty() ? "\"" : ", \"") + layer.name + "\"";
        refuse(parts, "it has several pictures (" + names + "), and one must be chosen");
    }
    return found.empty() ? std::nullopt : std::optional(found.front());
}

/// Returns whether the layer is a Y without a prefix and without the channels that would make it a colour.
bool is_lone_y(const std::vector<ExrPart>& parts, const ExrLayerNames& layer) {
    const std::string prefix = prefix_of(layer.layer);
    if (layer.content != ExrContent::single || short_name(layer.layer) != "y" || (prefix != "" && prefix != "."))
        return false;
    return std::ranges::none_of(parts[layer.part].channels, [&](const std::string& channel) {
        const std::string name = short_name(channel);
        return prefix_of(channel) == prefix &&
               (name == "x" || name == "ry" || name == "by" || name == "r" || name == "g" || name == "b");
    });
}

[[noreturn]] void refuse_deep() {
    throw std::runtime_error("deep images are not supported");
}

/// Chooses the picture among `layers`.
ExrLayerNames choose_among(const std::vector<ExrPart>& parts, const Layers& layers) {
    const auto is_plain_colour = [](const ExrLayerNames& l) { return is_colour(l) && l.layer.empty(); };
    const auto is_grey = [&](const ExrLayerNames& l) { return is_lone_y(parts, l); };
    for (const std::function<bool(const ExrLayerNames&)>& rule :
         {std::function<bool(const ExrLayerNames&)>(is_plain_colour), {is_grey}, {is_colour}})
        if (const auto layer = only_layer(parts, layers, rule))
            return *layer;
    if (std::ranges::any_of(parts, &ExrPart::is_deep))
        refuse_deep();
    if (layers.size() == 1 && layers.front().content == ExrContent::single)
        return layers.front();
    refuse(parts,
           "it has no picture with red, green and blue (or X, Y, Z, or Y, RY, BY) and more than one channel");
}

/// Returns the layers that a name may mean: layers of that name, or all layers of a part.
Layers called(const std::vector<ExrPart>& parts, const Layers& layers, const std::string& name) {
    const auto has_part = [&](const ExrLayerNames& l, std::string_view text) {
        return text == parts[l.part].name || text == std::to_string(l.part);
    };
    Layers found;
    for (const ExrLayerNames& l : layers) {
        const bool has_both = name.size() > l.layer.size() && name.ends_with(":" + l.layer) &&
                              has_part(l, std::string_view(name).substr(0, name.size() - l.layer.size() - 1));
        if (l.layer == name || l.name == name || has_both)
            found.push_back(l);
    }
    if (found.empty() && parts.size() > 1)
        std::ranges::copy_if(layers, std::back_inserter(found),
                             [&](const ExrLayerNames& l) { return has_part(l, name); });
    return found;
}

/// Returns the channels of that name, or of PART:CHANNEL, as layers of one number.
Layers channels_called(const std::vector<ExrPart>& parts, const std::string& name) {
    Layers found;
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (const std::string& channel : parts[i].channels)
            if (!parts[i].is_deep && (channel == name || part_name(parts, i) + ":" + channel == name))
                found.push_back({i, channel, channel, ExrContent::single, {channel}});
    return found;
}

} // namespace

std::vector<ExrLayerNames> find_layers(const std::vector<ExrPart>& parts) {
    Layers layers;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (!parts[i].is_deep)
            std::ranges::move(PartLayers(i, parts[i]).take(), std::back_inserter(layers));
    name_layers(parts, layers);
    // X, Y and Z without a layer name are the picture unless another one has no layer name.
    const bool has_picture =
        std::ranges::any_of(layers, [](const ExrLayerNames& l) { return l.layer.empty() && is_colour(l); });
    for (ExrLayerNames& layer : layers)
        if (layer.content == ExrContent::vector && layer.layer.empty() && !has_picture)
            layer.content = ExrContent::cie_xyz;
    return layers;
}

ExrLayerNames choose_picture(const std::vector<ExrPart>& parts) {
    return choose_among(parts, find_layers(parts));
}

ExrLayerNames choose_layer(const std::vector<ExrPart>& parts, const std::string& name) {
    if (name.empty())
        return choose_picture(parts);
    Layers found = called(parts, find_layers(parts), name);
    if (found.empty())
        found = channels_called(parts, name);
    if (found.empty() && std::ranges::any_of(parts, &ExrPart::is_deep))
        refuse_deep();
    if (found.empty())
        refuse(parts, "it has no layer \"" + name + "\"");
    return found.size() == 1 ? found.front() : choose_among(parts, found);
}

std::string list_channels(const std::vector<ExrPart>& parts) {
    std::string text;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts.size() > 1)
            text += (i == 0 ? "part \"" : "; part \"") + part_name(parts, i) + "\"" +
                    (parts[i].is_deep ? " (deep): " : ": ");
        for (const std::string& channel : parts[i].channels)
            text += (&channel == &parts[i].channels.front() ? "" : ", ") + channel;
    }
    return text;
}

} // namespace tessera
