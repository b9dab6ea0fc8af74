#include "app/compare/error_maps.h"

#include "app/cli/terminal.h"
#include "recon/metrics/error_map.h"
#include "recon/metrics/seen_error.h"
#include "recon/metrics/valid_pixels.h"
#include "render/io/exr.h"
#include "render/io/files.h"
#include "render/io/plain_images.h"
#include "ui/gl/tone.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/core.h>
#include <glm/common.hpp>

namespace tessera {

namespace {

constexpr std::pair<const char*, MapKind> kinds[] = {{"squared", MapKind::squared},
                                                     {"relative", MapKind::relative},
                                                     {"flip", MapKind::flip},
                                                     {"difference", MapKind::difference}};

/// Returns I - r of each channel.
RgbImage difference_of(const RgbImage& image, const RgbImage& reference) {
    RgbImage map(image.width(), image.height());
    for (std::size_t i = 0; i < map.size(); ++i)
        map.data()[i] = image.data()[i] - reference.data()[i];
    return map;
}

/// Returns the errors of finite images.
RgbImage map_of(MapKind kind, const RgbImage& image, const RgbImage& reference) {
    switch (kind) {
    case MapKind::squared:
        return error_map(ErrorKind::squared, image, reference);
    case MapKind::relative:
        return error_map(ErrorKind::relative_squared, image, reference);
    case MapKind::flip:
        return grey(flip(image, reference));
    case MapKind::difference:
        break;
    }
    return difference_of(image, reference);
}

glm::vec3 false_colour(float value) {
    constexpr auto last = static_cast<float>(false_colours.size() - 1);
    const float place = std::clamp(value, 0.0f, 1.0f) * last;
    const float first = std::min(std::floor(place), last - 1);
    const auto i = static_cast<std::size_t>(first);
    return glm::mix(false_colours[i], false_colours[i + 1], place - first);
}

/// Returns the sRGB code of an error. Pixels that are left out are black.
glm::vec3 code_of(MapKind kind, const Rgb& error) {
    if (!is_finite(error))
        return glm::vec3(0);
    if (kind == MapKind::difference)
        return glm::clamp(0.5f + 0.5f * error, 0.0f, 1.0f);
    return false_colour(kind == MapKind::flip ? error.r : 1 + std::log10(std::max(error.r, 1e-4f)) / 4);
}

void write_png_map(const std::filesystem::path& path, MapKind kind, const RgbImage& map) {
    std::vector<std::uint8_t> bytes;
    for (const Rgb& error : map) {
        const glm::vec3 code = code_of(kind, error);
        for (int i = 0; i < 3; ++i)
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * code[i])));
    }
    write_png(path, {map.width(), map.height()}, bytes);
}

} // namespace

MapFile parse_map(const std::string& word) {
    const std::size_t end = word.find('=');
    const auto* const found =
        std::ranges::find(kinds, word.substr(0, end), &std::pair<const char*, MapKind>::first);
    if (end == std::string::npos || found == std::end(kinds))
        throw BadInput(
            fmt::format("--map: '{}' is not KIND=FILE with the kind squared, relative, flip or difference", word));
    MapFile map{found->second, word.substr(end + 1)};
    if (extension_of(map.path) != ".exr" && extension_of(map.path) != ".png")
        throw BadInput(fmt::format("--map: {}: the name must end in .exr or .png", map.path.string()));
    return map;
}

std::filesystem::path map_path(const MapFile& map, std::size_t index, std::size_t count) {
    if (count == 1)
        return map.path;
    return map.path.parent_path() /
           fmt::format("{}-{}{}", map.path.stem().string(), index + 1, map.path.extension().string());
}

void write_map(const std::filesystem::path& path, MapKind kind, const AlignedPictures& pictures) {
    const RgbImage reference = pictures.mean_reference();
    const std::vector<std::size_t> invalid = invalid_pixels({&pictures.image, &reference});
    RgbImage map = map_of(kind, blackened(pictures.image, invalid), blackened(reference, invalid));
    for (std::size_t i : invalid)
        map.data()[i] = Rgb(std::numeric_limits<float>::quiet_NaN());
    if (extension_of(path) == ".png")
        write_png_map(path, kind, map);
    else if (kind == MapKind::difference)
        write_exr(path, {{{"", std::move(map)}}, {}});
    else
        write_exr(path, {{{"Y", std::move(map), ExrChannels::single}}, {}});
}

} // namespace tessera
