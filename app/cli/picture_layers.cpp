#include "app/cli/picture_layers.h"

#include "app/cli/pixel_format.h"
#include "app/cli/terminal.h"
#include "recon/guided/demodulation.h"
#include "render/estimator/basis.h"
#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/io/json_text.h"
#include "render/io/plain_images.h"
#include "render/run/checked_reconstruction.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/core.h>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

namespace tessera {

namespace {

/// Adds the image as a layer, unless it is empty.
void add_layer(ExrFile& file, std::string name, RgbImage image, ExrChannels channels = ExrChannels::rgb) {
    if (!image.empty())
        file.layers.push_back({std::move(name), std::move(image), channels});
}

/// Adds the numbers as a layer of one channel, unless there are none.
void add_numbers(ExrFile& file, std::string name, const Image<float>& numbers) {
    if (!numbers.empty())
        add_layer(file, std::move(name), grey(numbers), ExrChannels::single);
}

/// Returns the radiance as sampled, directly visible emission included. Moves it out of `images` unless `kept`.
RgbImage raw_primal(GradientImages& images, bool kept) {
    RgbImage& radiance = images.demodulation.empty() ? images.primal : images.demodulation.value;
    RgbImage sum = kept ? radiance : std::move(radiance);
    for (std::size_t i = 0; i < images.very_direct.size(); ++i)
        sum.data()[i] += images.very_direct.data()[i];
    return sum;
}

/// Converts mean inverse distances to depths.
Image<float> depth_of(const Image<float>& nearness) {
    Image<float> depth(nearness.width(), nearness.height());
    std::transform(nearness.begin(), nearness.end(), depth.begin(),
                   [](float inverse) { return inverse > 1 / no_depth ? 1 / inverse : no_depth; });
    return depth;
}

void add_features(ExrFile& file, FeatureImages&& features) {
    if (features.empty())
        return;
    add_layer(file, albedo_layer, std::move(features.albedo));
    add_layer(file, normal_layer, std::move(features.normal), ExrChannels::xyz);
    add_numbers(file, depth_layer, depth_of(features.nearness));
    add_numbers(file, nearness_layer, features.nearness);
    add_numbers(file, roughness_layer, features.roughness);
}

void add_brightest(ExrFile& file, BrightestSamples&& b) {
    if (b.empty())
        return;
    add_layer(file, "brightest_primal", std::move(b.primal));
    add_layer(file, "brightest_dx", std::move(b.dx));
    add_layer(file, "brightest_dy", std::move(b.dy));
    add_layer(file, "brightest_albedo", std::move(b.albedo));
    add_numbers(file, "brightest_half", b.half);
    file.attributes[samples_attribute] = fmt::format("{}", b.samples);
}

void add_demodulation(ExrFile& file, Demodulation&& d) {
    add_layer(file, "mean_albedo", std::move(d.albedo));
    add_layer(file, "sampled_albedo", std::move(d.sampled_albedo));
    add_numbers(file, "albedo_variance", d.albedo_variance);
    add_numbers(file, "sampled_share", d.sampled_weight);
    add_layer(file, "sampled_variance", std::move(d.sampled_variance));
    add_layer(file, "value_covariance", std::move(d.value_covariance));
    add_numbers(file, "unexplained_variance", d.unexplained_variance);
}

void add_components(ExrFile& file, std::vector<BasisComponent>&& components) {
    for (std::size_t l = 0; l < components.size(); ++l) {
        BasisComponent& component = components[l];
        const auto named = [l](const char* name) { return part_layer(l, name); };
        add_numbers(file, named("projection"), component.projection);
        add_layer(file, named("primal"), std::move(component.primal));
        add_layer(file, named("dx"), std::move(component.dx));
        add_layer(file, named("dy"), std::move(component.dy));
        add_numbers(file, named("primal_variance"), component.primal_variance);
        add_numbers(file, named("dx_variance"), component.dx_variance);
        add_numbers(file, named("dy_variance"), component.dy_variance);
    }
}

/// Adds everything that `tessera reconstruct` reads (app/commands/gradient_input.cpp).
void add_buffers(ExrFile& file, GradientImages&& images) {
    const bool is_demodulated = !images.demodulation.empty();
    const auto named = [&](const char* name) { return is_demodulated ? coefficient_layer(name) : name; };
    if (is_demodulated)
        add_layer(file, without_direct_layer, std::move(images.demodulation.value));
    add_layer(file, is_demodulated ? coefficient_layer("primal") : without_direct_layer, std::move(images.primal));
    add_layer(file, named("dx"), std::move(images.dx));
    add_layer(file, named("dy"), std::move(images.dy));
    add_layer(file, direct_layer, std::move(images.very_direct));
    add_numbers(file, named("primal_variance"), images.primal_variance);
    add_numbers(file, named("dx_variance"), images.dx_variance);
    add_numbers(file, named("dy_variance"), images.dy_variance);
    file.attributes[patch_attribute] = fmt::format("{}", images.patch);
    add_layer(file, "half_primal", std::move(images.halves.primal));
    add_layer(file, "half_dx", std::move(images.halves.dx));
    add_layer(file, "half_dy", std::move(images.halves.dy));
    add_features(file, std::move(images.features));
    add_brightest(file, std::move(images.brightest));
    add_demodulation(file, std::move(images.demodulation));
    add_components(file, std::move(images.components));
}

/// Returns whether the images have the same pixels.
bool are_equal(const RgbImage& a, const RgbImage& b) {
    return a.width() == b.width() && std::equal(a.begin(), a.end(), b.begin(), b.end());
}

} // namespace

void check_picture_name(const std::filesystem::path& output, const ReconstructionLayers& wanted) {
    const std::string extension = extension_of(output);
    if (extension != ".png" && extension != ".exr")
        throw BadInput(fmt::format("{}: the name must end in .exr or .png", output.string()));
    if (extension == ".png" && (wanted.buffers || wanted.norms.size() > 1))
        throw BadInput(fmt::format(
            "{}: a PNG file holds one picture; buffers and several reconstructions take EXR", output.string()));
}

std::uint64_t bytes_for_layers(glm::ivec2 size, const RenderSettings& settings, const ReconstructionLayers& wanted,
                               int threads) {
    const bool gradients = has_gradients(settings.method), demodulated = is_demodulated(settings);
    const int components = is_expanded(settings) ? component_count(settings.basis) : 0;
    const std::uint64_t pixels = static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
    const std::uint64_t images =
        pixels * (sizeof(Rgb) + BrightestSamples::bytes_a_pixel + HalfDifferences::bytes_a_pixel +
                  FeatureImages::bytes_a_pixel + (gradients ? 3 : 1) * sizeof(Rgb) +
                  (gradients ? 3 : 1) * sizeof(float) + (demodulated ? Demodulation::bytes_a_pixel : 0) +
                  static_cast<std::size_t>(components) * BasisComponent::bytes_a_pixel);
    const ReconstructionSize picture{size.x, size.y, gradients, demodulated, components, threads};
    std::uint64_t done = 0, most = images;
    for (Norm norm : wanted.norms) {
        most = std::max(most, images + done + Reconstructor().bytes_for(picture, applied(norm, gradients)));
        done += pixels * sizeof(Rgb);
    }
    // Memory of the layer "primal", and of "Z" beside the nearness from which it is computed.
    return std::max(most,
                    images + done + pixels * (sizeof(Rgb) + (wanted.buffers ? sizeof(Rgb) + sizeof(float) : 0)));
}

ExrFile reconstruct_layers(GradientImages&& images, const ReconstructionLayers& wanted, ThreadPool& pool,
                           std::vector<ReconstructionStats>& stats) {
    ExrFile file;
    const ParallelFor parallel_for = pool.row_loops();
    ReconstructionSettings settings = wanted.settings;
    for (Norm norm : wanted.norms) {
        settings.norm = norm;
        Reconstructor solver; // a new one for each norm, to free the memory of the last
        // Open Image Denoise has threads of its own.
        const auto cpu_seconds = [&] { return norm == Norm::oidn ? process_cpu_seconds() : pool.cpu_seconds(); };
        const double cpu = cpu_seconds();
        Reconstruction r = reconstruct_checked(solver, images, settings, parallel_for, pool.size());
        stats.push_back({norm, r.seconds, cpu_seconds() - cpu, r.iterations, r.residual, r.redistributed});
        file.layers.push_back({file.layers.empty() ? "" : std::string(to_string(norm)), std::move(r.image)});
    }
    RgbImage primal = raw_primal(images, wanted.buffers);
    if (file.layers.empty() || !are_equal(file.layers.front().image, primal))
        add_layer(file, primal_layer, std::move(primal));
    if (wanted.buffers)
        add_buffers(file, std::move(images));
    return file;
}

ExrFile picture_layers(GradientImages&& images, const ReuseMaps& maps, const ReconstructionLayers& wanted,
                       ThreadPool& pool, std::vector<ReconstructionStats>& stats) {
    ExrFile file = reconstruct_layers(std::move(images), wanted, pool, stats);
    if (!wanted.buffers || maps.empty())
        return file;
    add_numbers(file, "reused", maps.reused());
    add_numbers(file, "failed", maps.failed());
    for (int i = 0; i < shift_outcome_count; ++i) {
        const auto outcome = static_cast<ShiftOutcome>(i);
        add_numbers(file, fmt::format("shifts_{}", to_string(outcome)), maps.share(outcome));
    }
    add_numbers(file, "survival", maps.survival());
    add_numbers(file, "reuse_set_size", maps.reuse_set_size);
    add_numbers(file, "gain", maps.gain);
    add_numbers(file, "samples", maps.paths);
    return file;
}

ExrFile unreconstructed_layers(GradientImages&& images, bool is_exr) {
    ExrFile file;
    const bool has_buffers = is_exr && images.has_gradients();
    if (!has_buffers || has_free_memory(sizeof(Rgb) * images.primal.size()))
        add_layer(file, "", raw_primal(images, has_buffers));
    if (has_buffers)
        add_buffers(file, std::move(images));
    return file;
}

void record_redistributed(ExrFile& file, const std::vector<ReconstructionStats>& stats) {
    nlohmann::json fractions = nlohmann::json::object();
    for (const ReconstructionStats& r : stats)
        if (r.redistributed > 0)
            fractions[std::string(to_string(r.norm))] = r.redistributed;
    if (fractions.empty())
        file.attributes.erase(redistributed_attribute);
    else
        file.attributes[redistributed_attribute] = to_text(fractions);
}

namespace {

void write_as(const std::filesystem::path& output, const std::string& extension, const ExrFile& file) {
    if (extension == ".png")
        write_first_layer(output, file);
    else
        write_exr(output, file);
}

/// Returns a name that no file in the temporary folder has.
std::filesystem::path free_temporary_name(const std::string& extension) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path();
    for (int i = 1;; ++i)
        if (auto path = folder / fmt::format("tessera-kept-{}{}", i, extension); !std::filesystem::exists(path))
            return path;
}

/// Writes the picture to the temporary folder. Returns a text with its name; empty if that also fails.
std::string keep_aside(const std::string& extension, const ExrFile& file) {
    try {
        const std::filesystem::path kept = free_temporary_name(extension);
        write_as(kept, extension, file);
        return fmt::format("; the picture is kept as {}", kept.string());
    } catch (const std::exception&) {
        return "";
    }
}

} // namespace

void write_picture(const std::filesystem::path& output, const ExrFile& file) {
    const std::string extension = extension_of(output);
    try {
        write_as(output, extension, file);
    } catch (const std::exception& error) {
        throw std::runtime_error(message_of(error) + keep_aside(extension, file));
    }
}

} // namespace tessera
