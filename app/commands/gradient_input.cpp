#include "app/cli/picture_layers.h"
#include "app/cli/terminal.h"
#include "app/commands/commands.h"
#include "render/io/exr.h"
#include "render/io/files.h"
#include "render/io/picture_file.h"
#include "render/settings/settings_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

/// An image with its name for messages.
struct NamedImage {
    std::string name;
    RgbImage image;
};

/// The images in the order of the command line. The directly visible emission may be missing.
using Buffers = std::vector<NamedImage>;

ExrFile read_layers(const std::filesystem::path& path) {
    if (extension_of(path) != ".exr")
        throw BadInput(
            fmt::format("{}: a single input must be an EXR file with layers, as `tessera render --buffers` writes "
                        "it; or give three or four files: primal, dx, dy and the directly visible emission",
                        path.string()));
    return read_exr(path);
}

std::map<std::string, std::string> own_attributes(const ExrFile& file) {
    std::map<std::string, std::string> attributes;
    for (const auto& [name, text] : file.attributes)
        if (name.starts_with("tessera:"))
            attributes[name] = text;
    return attributes;
}

/// Returns the number in an attribute, from 1 to `most`; 1 if the attribute is missing.
template <class Number>
Number number_of(const std::map<std::string, std::string>& attributes, const char* name, Number most,
                 const std::filesystem::path& path) {
    const auto found = attributes.find(name);
    if (found == attributes.end())
        return 1;
    Number number = 0;
    const std::string& text = found->second;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !(number >= 1 && number <= most))
        throw BadInput(fmt::format("{}: attribute {} is \"{}\", but must be a number from 1 to {}", path.string(),
                                   name, text, most));
    return number;
}

NamedImage named_layer(const ExrFile& file, const std::string& name, const std::filesystem::path& path) {
    return {fmt::format("{}, layer {}", path.string(), name), require_layer(file, name, path)};
}

/// Returns whether the file's gradients are of the coefficient of demodulated radiance.
bool is_demodulated(const ExrFile& file) {
    return find_layer(file, coefficient_layer("primal"));
}

/// Returns the layer with the radiance without directly visible emission. Other programs may write the layer
/// "primal" alone, if there is no such emission. Throws BadInput for a layer "direct" beside it, as "primal" may
/// contain that emission or not.
const char* radiance_layer(const ExrFile& file, const std::filesystem::path& path) {
    if (find_layer(file, without_direct_layer))
        return without_direct_layer;
    if (find_layer(file, direct_layer))
        throw BadInput(fmt::format("{} has a layer \"{}\", but no layer \"{}\": an older version of Tessera or "
                                   "another program wrote it. Render it again with `tessera render --buffers`, or "
                                   "give primal, dx, dy and the directly visible emission as four files",
                                   path.string(), direct_layer, without_direct_layer));
    return primal_layer;
}

Buffers buffers_of(const ExrFile& file, const std::filesystem::path& path) {
    const bool has_coefficient = is_demodulated(file);
    const auto named = [&](const char* name) { return has_coefficient ? coefficient_layer(name) : name; };
    const std::string radiance = radiance_layer(file, path);
    Buffers buffers;
    for (const std::string& name : {has_coefficient ? named("primal") : radiance, named("dx"), named("dy")})
        buffers.push_back(named_layer(file, name, path));
    if (find_layer(file, direct_layer))
        buffers.push_back(named_layer(file, direct_layer, path));
    return buffers;
}

/// Reads an image of signed values. Formats of bytes cannot have these.
RgbImage read_image(const std::filesystem::path& path) {
    if (extension_of(path) != ".exr" && extension_of(path) != ".pfm")
        throw BadInput(fmt::format("{}: the name must end in .exr or .pfm", path.string()));
    Picture picture = read_picture(path);
    for (const std::string& note : picture.notes)
        fmt::print(stderr, "note: {}: {}\n", path.string(), note);
    return std::move(picture.image);
}

std::string text_of_size(const RgbImage& image) {
    return fmt::format("{}x{}", image.width(), image.height());
}

/// Extends `buffer` to the primal's size. It may lack `columns` and `rows` at the end; these become 0 in any
/// case, as they have no meaning.
void fit(NamedImage& buffer, const NamedImage& primal, int columns, int rows) {
    RgbImage& image = buffer.image;
    const int width = primal.image.width(), height = primal.image.height();
    const bool is_whole = image.width() == width && image.height() == height;
    if (!is_whole && (image.width() != width - columns || image.height() != height - rows))
        throw BadInput(fmt::format("sizes differ: {} is {}, {} is {}", primal.name, text_of_size(primal.image),
                                   buffer.name, text_of_size(image)));
    RgbImage fitted(width, height, Rgb(0));
    for (int y = 0; y < height - rows; ++y)
        std::copy_n(image.row(y), width - columns, fitted.row(y));
    image = std::move(fitted);
}

/// Sets pixels that are not finite to 0 and returns their number. Throws BadInput instead unless `repair`.
std::size_t make_finite(NamedImage& buffer, bool repair) {
    if (const std::string bad = text_of_bad_pixel(buffer.image); !bad.empty() && !repair)
        throw BadInput(
            fmt::format("{}: {}, which is not finite; --repair sets such pixels to 0", buffer.name, bad));
    std::size_t count = 0;
    for (Rgb& pixel : buffer.image)
        if (!is_finite(pixel)) {
            pixel = Rgb(0);
            ++count;
        }
    return count;
}

/// Reads a layer of variances. The last `columns` and `rows` have no meaning. Replaces invalid values by
/// `fallback`, or throws BadInput without one.
Image<float> read_variance(const ExrFile& file, const std::string& name, const std::filesystem::path& path,
                           const RgbImage& primal, int columns, int rows, std::optional<float> fallback,
                           std::size_t& repaired) {
    const NamedImage layer = named_layer(file, name, path);
    if (layer.image.width() != primal.width() || layer.image.height() != primal.height())
        throw BadInput(fmt::format("sizes differ: the primal is {}, {} is {}", text_of_size(primal), layer.name,
                                   text_of_size(layer.image)));
    Image<float> variance(primal.width(), primal.height());
    for (int y = 0; y < primal.height() - rows; ++y)
        for (int x = 0; x < primal.width() - columns; ++x) {
            const float value = layer.image(x, y).r;
            const bool is_good = std::isfinite(value) && value >= 0;
            if (!is_good && !fallback)
                throw BadInput(
                    fmt::format("{}: pixel ({}, {}) is {}, which is not a variance; --repair gives gradients "
                                "there the least weight",
                                layer.name, x, y, value));
            variance(x, y) = is_good ? value : *fallback;
            repaired += !is_good;
        }
    return variance;
}

/// Reads layers of the primal's size, and repairs invalid values if `repair` is set.
struct LayerReader {
    const ExrFile& file;
    const std::filesystem::path& path;
    const NamedImage& primal;
    bool repair;
    std::size_t& repaired;

    /// Reads an image. The last `columns` and `rows` have no meaning.
    RgbImage image(const std::string& name, int columns = 0, int rows = 0) const {
        NamedImage layer = named_layer(file, name, path);
        fit(layer, primal, columns, rows);
        repaired += make_finite(layer, repair);
        return std::move(layer.image);
    }
    /// Reads numbers of any sign.
    Image<float> numbers(const std::string& name) const {
        const RgbImage layer = image(name);
        Image<float> result(layer.width(), layer.height());
        std::transform(layer.begin(), layer.end(), result.begin(), [](Rgb value) { return value.r; });
        return result;
    }
    /// Reads variances. `fallback` replaces invalid ones.
    Image<float> variances(const std::string& name, float fallback, int columns = 0, int rows = 0) const {
        return read_variance(file, name, path, primal.image, columns, rows,
                             repair ? std::optional(fallback) : std::nullopt, repaired);
    }
};

constexpr float largest = std::numeric_limits<float>::max();

/// Reads what turns a reconstructed coefficient into radiance. Bad values become zero radiance or zero weight.
Demodulation read_demodulation(const LayerReader& reader) {
    Demodulation d{reader.image(without_direct_layer),   reader.image("mean_albedo"),
                   reader.image("sampled_albedo"),       reader.variances("albedo_variance", largest),
                   reader.variances("sampled_share", 0), reader.image("sampled_variance"),
                   reader.image("value_covariance"),     reader.variances("unexplained_variance", largest)};
    for (float& share : d.sampled_weight)
        share = std::min(share, 1.0f);
    return d;
}

/// Reads each pixel's brightest sample; empty: the file has none.
BrightestSamples read_brightest(const LayerReader& reader, bool has_coefficient, int samples) {
    if (!find_layer(reader.file, "brightest_primal"))
        return {};
    return {reader.image("brightest_primal"),
            reader.image("brightest_dx", 1, 0),
            reader.image("brightest_dy", 0, 1),
            has_coefficient ? reader.image("brightest_albedo") : RgbImage(),
            find_layer(reader.file, "brightest_half") ? reader.numbers("brightest_half") : Image<float>(),
            samples};
}

/// Reads the half differences and the feature buffers, where the file has them. Without the layer "nearness" the
/// features are another program's, and are ignored.
void read_features(const LayerReader& reader, GradientImages& images) {
    if (find_layer(reader.file, "half_primal"))
        images.halves = {reader.image("half_primal"), reader.image("half_dx", 1, 0),
                         reader.image("half_dy", 0, 1)};
    if (find_layer(reader.file, nearness_layer))
        images.features = {reader.image(albedo_layer), reader.image(normal_layer), reader.numbers(nearness_layer),
                           reader.numbers(roughness_layer)};
}

/// Reads the components of the coefficient that the file has. Their projections may be negative.
std::vector<BasisComponent> read_components(const LayerReader& reader, bool has_variances) {
    std::vector<BasisComponent> components;
    for (std::size_t l = 0; find_layer(reader.file, part_layer(l, "primal")); ++l) {
        const auto named = [l](const char* name) { return part_layer(l, name); };
        BasisComponent& component =
            components.emplace_back(reader.numbers(named("projection")), reader.image(named("primal")),
                                    reader.image(named("dx"), 1, 0), reader.image(named("dy"), 0, 1));
        if (!has_variances)
            continue;
        component.primal_variance = reader.variances(named("primal_variance"), 0);
        component.dx_variance = reader.variances(named("dx_variance"), largest, 1, 0);
        component.dy_variance = reader.variances(named("dy_variance"), largest, 0, 1);
    }
    return components;
}

} // namespace

std::string text_of_bad_pixel(const RgbImage& image) {
    const auto bad = std::find_if_not(image.begin(), image.end(), is_finite);
    if (bad == image.end())
        return {};
    const auto index = bad - image.begin();
    return fmt::format("pixel ({}, {}) is ({}, {}, {})", index % image.width(), index / image.width(), bad->r,
                       bad->g, bad->b);
}

GradientInput read_gradients(const std::vector<std::filesystem::path>& files, bool repair) {
    if (files.size() != 1 && files.size() != 3 && files.size() != 4)
        throw BadInput(fmt::format("{} inputs were given: one EXR file with layers, or three or four files are "
                                   "needed: primal, dx, dy and the directly visible emission",
                                   files.size()));
    GradientInput input;
    Buffers buffers;
    ExrFile layers;
    if (files.size() == 1) {
        layers = read_layers(files.front());
        input.attributes = own_attributes(layers);
        input.images.patch = number_of(input.attributes, patch_attribute, 1024.0f, files.front());
        buffers = buffers_of(layers, files.front());
    } else {
        for (const std::filesystem::path& file : files)
            buffers.push_back({file.string(), read_image(file)});
    }
    fit(buffers[1], buffers[0], 1, 0);
    fit(buffers[2], buffers[0], 0, 1);
    if (buffers.size() == 4)
        fit(buffers[3], buffers[0], 0, 0);
    for (NamedImage& buffer : buffers)
        input.repaired += make_finite(buffer, repair);
    const bool has_coefficient = is_demodulated(layers);
    const auto named = [&](const char* name) { return has_coefficient ? coefficient_layer(name) : name; };
    const bool has_variances = find_layer(layers, named("primal_variance"));
    const LayerReader reader{layers, files.front(), buffers[0], repair, input.repaired};
    if (has_coefficient) {
        input.images.demodulation = read_demodulation(reader);
        input.images.components = read_components(reader, has_variances);
    }
    input.images.brightest = read_brightest(
        reader, has_coefficient, number_of(input.attributes, samples_attribute, most_spp, files.front()));
    read_features(reader, input.images);
    if (has_variances) {
        // Unknown variances: a gradient has the least weight if its variance is large and the primal's is 0.
        input.images.primal_variance = reader.variances(named("primal_variance"), 0);
        input.images.dx_variance = reader.variances(named("dx_variance"), largest, 1, 0);
        input.images.dy_variance = reader.variances(named("dy_variance"), largest, 0, 1);
    }
    input.images.primal = std::move(buffers[0].image);
    input.images.dx = std::move(buffers[1].image);
    input.images.dy = std::move(buffers[2].image);
    if (buffers.size() == 4)
        input.images.very_direct = std::move(buffers[3].image);
    return input;
}

} // namespace tessera
