#include "app/cli/pixel_format.h"

#include "app/cli/picture_layers.h"
#include "app/cli/terminal.h"
#include "render/io/exr_color.h"
#include "render/io/plain_images.h"

#include <array>
#include <utility>

#include <fmt/core.h>
#include <glm/mat3x3.hpp>

namespace tessera {

namespace {

template <class Value>
ExrLayer numbers(const char* name, const RgbImage& image, Value value) {
    ExrLayer layer{name, RgbImage(image.width(), image.height()), ExrChannels::single};
    for (std::size_t i = 0; i < image.size(); ++i)
        layer.image.data()[i] = Rgb(value(image.data()[i]));
    return layer;
}

/// Replaces the first layer by its channels in a format.
void convert_first(ExrFile& file, PixelFormat format) {
    const RgbImage image = std::move(file.layers.front().image);
    file.layers.erase(file.layers.begin());
    if (format == PixelFormat::luminance || format == PixelFormat::luminance_alpha) {
        file.layers.insert(file.layers.begin(), numbers("Y", image, [](Rgb c) { return luminance(c); }));
        return;
    }
    const glm::mat3 to_xyz(xyz_of_primaries(Chromaticities()));
    constexpr std::array names{"Z", "Y", "X"};
    for (int i = 0; i < 3; ++i)
        file.layers.insert(file.layers.begin(), numbers(names[static_cast<std::size_t>(i)], image,
                                                        [&](Rgb c) { return (to_xyz * c)[2 - i]; }));
}

bool is_rgb(PixelFormat format) {
    return format == PixelFormat::rgb || format == PixelFormat::rgba;
}

} // namespace

void check_has_rgb(PixelFormat format) {
    if (!is_rgb(format))
        throw BadInput(fmt::format("--pixel-format {}: --buffers needs rgb or rgba", to_string(format)));
}

void set_pixel_format(ExrFile& file, PixelFormat format, const Image<float>& coverage) {
    const bool has_buffers = find_layer(file, direct_layer) != nullptr;
    if (!is_rgb(format) && !has_buffers && !file.layers.empty())
        convert_first(file, format);
    if (!coverage.empty())
        file.layers.push_back({alpha_layer, grey(coverage), ExrChannels::single});
}

void write_first_layer(const std::filesystem::path& path, const ExrFile& file) {
    RgbImage image = file.layers.front().image;
    if (file.layers.front().name == "X") // a PNG has no XYZ
        for (std::size_t i = 0; i < image.size(); ++i)
            image.data()[i] = rgb_of_xyz({file.layers[0].image.data()[i].r, file.layers[1].image.data()[i].r,
                                          file.layers[2].image.data()[i].r});
    const RgbImage* const alpha = find_layer(file, alpha_layer);
    if (!alpha)
        return write_png(path, image);
    Image<float> coverage(image.width(), image.height());
    for (std::size_t i = 0; i < image.size(); ++i) {
        coverage.data()[i] = alpha->data()[i].r;
        image.data()[i] *= alpha->data()[i].r > 0 ? 1 / alpha->data()[i].r : 0;
    }
    write_png(path, image, coverage);
}

} // namespace tessera
