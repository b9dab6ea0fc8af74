#include "ui/settings/thumbnails.h"

#include "render/io/files.h"
#include "render/io/memory.h"
#include "render/io/picture_formats.h"
#include "render/io/plain_images.h"
#include "ui/gl/tone.h"
#include "ui/settings/preferences.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <set>
#include <span>
#include <system_error>
#include <vector>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/ext/vector_int2.hpp>
#include <glm/vec2.hpp>

namespace tessera {

namespace {

namespace fs = std::filesystem;
constexpr glm::ivec2 thumbnail_size(160, 120);

fs::path folder_of(const fs::path& preferences) {
    return preferences.parent_path() / "recent";
}

/// Returns the thumbnail's file: the scene's name and a checksum of its path, because many are called scene.xml.
fs::path file_of(const fs::path& preferences, const std::string& scene) {
    const std::string full = fs::path(scene).lexically_normal().string();
    return folder_of(preferences) /
           fmt::format("{}-{:08x}.png", fs::path(full).stem().string(), checksum(std::as_bytes(std::span(full))));
}

/// Removes the thumbnails of scenes that are not recent.
void tidy(const fs::path& preferences) {
    std::string ignored;
    std::set<fs::path> kept;
    for (const std::string& scene : read_preferences(preferences, ignored).recent_scenes)
        kept.insert(file_of(preferences, scene));
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_of(preferences), failed))
        if (entry.path().extension() == ".png" && !kept.contains(entry.path()))
            fs::remove(entry.path(), failed);
}

} // namespace

RgbImage thumbnail_of(const RgbImage& image, float exposure) {
    const glm::vec2 size(image.width(), image.height());
    const glm::vec2 crop = glm::min(size, glm::vec2(size.y * 4 / 3, size.x * 3 / 4));
    const glm::vec2 first = (size - crop) * 0.5f, step = crop / glm::vec2(thumbnail_size);
    const Tone tone{Tone::Curve::srgb, exposure};
    RgbImage small(thumbnail_size.x, thumbnail_size.y);
    for (int y = 0; y < small.height(); ++y)
        for (int x = 0; x < small.width(); ++x) {
            const glm::vec2 from = first + step * glm::vec2(x, y);
            const glm::ivec2 begin = glm::min(glm::ivec2(from), glm::ivec2(size) - 1);
            const glm::ivec2 end = glm::clamp(glm::ivec2(from + step), begin + 1, glm::ivec2(size));
            Rgb sum(0);
            for (int v = begin.y; v < end.y; ++v)
                for (int u = begin.x; u < end.x; ++u)
                    if (is_finite(image(u, v)))
                        sum += displayed(image(u, v), tone);
            small(x, y) = sum / static_cast<float>((end.x - begin.x) * (end.y - begin.y));
        }
    return small;
}

void store_thumbnail(const fs::path& preferences, const std::string& scene, const RgbImage& thumbnail) {
    std::vector<std::uint8_t> bytes;
    for (const Rgb& pixel : thumbnail)
        for (int c = 0; c < 3; ++c)
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(pixel[c], 0.0f, 1.0f))));
    fs::create_directories(folder_of(preferences));
    write_png(file_of(preferences, scene), {thumbnail.width(), thumbnail.height()},
              bytes); // atomic: under a temporary name first
    tidy(preferences);
}

RgbImage read_thumbnail(const fs::path& preferences, const std::string& scene) {
    try {
        return to_rgb(parse_png(read_bytes(file_of(preferences, scene)), [] { return true; }));
    } catch (const std::exception&) { // no thumbnail is stored, or the file is broken
        return {};
    }
}

} // namespace tessera
