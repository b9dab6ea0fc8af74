#include "render/run/reference_image.h"

#include "recon/guided/fireflies.h"
#include "render/io/json_text.h"
#include "render/io/memory.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

constexpr const char* reference_attribute = "tessera:reference";
constexpr const char* scene_attribute = "tessera:scene";

/// Returns whether a pixel sees nothing or a black surface, directly or in a mirror. Bsdf::albedo() of black
/// surfaces is 0.01.
bool sees_black(const GradientImages& images, std::size_t i) {
    if (images.demodulation.empty())
        return false;
    const Rgb a = images.demodulation.albedo.data()[i];
    return std::max({a.r, a.g, a.b}) <= 0.0101f;
}

} // namespace

ReferenceOrigin origin_of(const ReferenceImage& reference) {
    const nlohmann::json settings = nlohmann::json::parse(reference.settings, nullptr, false);
    if (!settings.is_object())
        return {};
    const auto text_of = [&](const char* key) {
        const auto found = settings.find(key);
        return found != settings.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    const std::string method = text_of("method");
    const auto known = std::ranges::find(all_methods, method, short_name);
    return {known == std::end(all_methods) ? std::nullopt : std::optional(*known), text_of("recon")};
}

std::string to_string(const ReferenceOrigin& origin) {
    if (!origin.method)
        return "an unknown method";
    std::string text(short_name(*origin.method));
    if (has_gradients(*origin.method) && !origin.reconstruction.empty())
        text += ", reconstructed by " + origin.reconstruction;
    return text;
}

FloorFreeError error_of(const ReferenceImage& reference) {
    return measure_reference_error(reference.halves[0], reference.halves[1]);
}

RgbImage variance_of(const ReferenceImage& reference) {
    RgbImage variance = reference.halves[0];
    for (std::size_t i = 0; i < variance.size(); ++i) {
        const Rgb half = 0.5f * (variance.data()[i] - reference.halves[1].data()[i]);
        variance.data()[i] = half * half;
    }
    return variance;
}

void UnreliablePixels::look_at(const GradientImages& images) {
    const RgbImage clamped = clamped_radiance(images);
    for (std::size_t i = 0; i < fireflies_.size(); ++i) {
        if (clamped.data()[i] != Rgb(0))
            fireflies_.data()[i] = 1;
        if (images.radiance().data()[i] != Rgb(0) || images.very_direct.data()[i] != Rgb(0) ||
            sees_black(images, i))
            dark_.data()[i] = 0;
    }
}

Image<float> UnreliablePixels::unknown() const {
    Image<float> unknown = fireflies_;
    for (std::size_t i = 0; i < unknown.size(); ++i)
        unknown.data()[i] = std::max(unknown.data()[i], dark_.data()[i]);
    return unknown;
}

Image<float> doubt_of(const std::array<RgbImage, 2>& halves, const Image<float>& unknown) {
    const int width = halves[0].width(), height = halves[0].height();
    const auto mean_at = [&](int x, int y) {
        return 0.5f * (luminance(halves[0](x, y)) + luminance(halves[1](x, y)));
    };
    double sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            sum += static_cast<double>(std::abs(mean_at(x, y)));
    const auto dark = static_cast<float>(0.01 * sum / static_cast<double>(halves[0].size()));
    Image<float> doubt(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float squares = 0, brightness = 0;
            int count = 0;
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
                for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i, ++count) {
                    const float error = 0.5f * luminance(halves[0](i, j) - halves[1](i, j));
                    squares += error * error;
                    brightness += std::abs(mean_at(i, j));
                }
            const float scale = brightness / static_cast<float>(count) + dark;
            const float error = std::sqrt(squares / static_cast<float>(count));
            doubt(x, y) = std::max(scale > 0 ? error / scale : 0, unknown(x, y));
        }
    return doubt;
}

double untrusted_fraction(const Image<float>& doubt) {
    const auto count = std::count_if(doubt.begin(), doubt.end(), [](float d) { return d > untrusted_threshold; });
    return doubt.empty() ? 0 : static_cast<double>(count) / static_cast<double>(doubt.size());
}

RgbImage mean_of(const RgbImage& a, const RgbImage& b) {
    RgbImage mean = a;
    for (std::size_t i = 0; i < mean.size(); ++i)
        mean.data()[i] = 0.5f * (a.data()[i] + b.data()[i]);
    return mean;
}

std::uint32_t checksum_of(const ReferenceImage& reference) {
    std::uint32_t sum = 0;
    for (const RgbImage& half : reference.halves)
        sum = checksum(std::as_bytes(std::span(half.data(), half.size())), sum);
    return sum;
}

void write_reference(const std::filesystem::path& path, const ReferenceImage& reference) {
    const FloorFreeError error = error_of(reference);
    const nlohmann::ordered_json about{{"made_by", to_string(origin_of(reference))},
                                       {"seeds", reference.seeds},
                                       {"relmse", error.relative_mse},
                                       {"relmse_standard_error", error.standard_error},
                                       {"untrusted", untrusted_fraction(reference.doubt)}};
    ExrFile file{{{"", reference.mean}}, {}};
    for (std::size_t i = 0; i < 2; ++i)
        file.layers.push_back({half_names[i], reference.halves[i]});
    file.layers.push_back({"variance", variance_of(reference)});
    if (!reference.doubt.empty())
        file.layers.push_back({"doubt", grey(reference.doubt), ExrChannels::single});
    file.attributes = {{"tessera:version", TESSERA_VERSION},
                       {"tessera:settings", reference.settings},
                       {"tessera:camera", reference.camera},
                       {reference_attribute, to_text(about)}};
    if (reference.scene)
        file.attributes[scene_attribute] = to_string(*reference.scene);
    write_exr(path, file);
}

bool is_reference(const std::filesystem::path& path) {
    return is_exr_file(path) && read_exr_attributes(path).count(reference_attribute) > 0;
}

ReferenceImage read_reference(const std::filesystem::path& path) {
    ExrFile file = read_exr(path, {}, {"", half_names[0], half_names[1]});
    ReferenceImage reference;
    for (std::size_t i = 0; i < 2; ++i)
        reference.halves[i] = require_layer(file, half_names[i], path);
    reference.mean = require_layer(file, "", path);
    try {
        reference.seeds = parse_json(file.attributes[reference_attribute]).at("seeds");
    } catch (const nlohmann::json::exception&) {
        throw std::runtime_error(fmt::format("{}: is not a reference: its header has no seeds", path.string()));
    }
    reference.settings = file.attributes["tessera:settings"];
    reference.camera = file.attributes["tessera:camera"];
    reference.scene = scene_of(file);
    return reference;
}

std::optional<SceneChecksums> scene_of(const ExrFile& file) {
    const auto found = file.attributes.find(scene_attribute);
    return found == file.attributes.end() ? std::nullopt : scene_checksums_from(found->second);
}

} // namespace tessera
