#include "app/cli/picture_layers.h"

#include "app/cli/terminal.h"
#include "recon/picture/demodulation.h"
#include "recon/picture/spikes.h"
#include "render/estimator/basis.h"
#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/io/plain_images.h"
#include "render/run/fitting_reconstruction.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/core.h>
#include <glm/vec2.hpp>

namespace tessera {

namespace {

/// Adds the image as a layer, if there is one.
void add_layer(ExrFile& file, std::string name, RgbImage image) {
    if (!image.empty())
        file.layers.push_back({std::move(name), std::move(image)});
}

void add_buffers(ExrFile& file, GradientImages&& images) {
    Demodulation& d = images.demodulation;
    const bool is_demodulated = !d.empty();
    const auto add = [&](const char* name, RgbImage image) {
        add_layer(file, is_demodulated ? coefficient_layer(name) : name, std::move(image));
    };
    add_layer(file, "primal", std::move(d.value)); // if there is one
    add("primal", std::move(images.primal));
    add("dx", std::move(images.dx));
    add("dy", std::move(images.dy));
    add_layer(file, "direct", std::move(images.very_direct));
    add("primal_variance", grey(images.primal_variance));
    add("dx_variance", grey(images.dx_variance));
    add("dy_variance", grey(images.dy_variance));
    file.attributes[patch_attribute] = fmt::format("{}", images.patch);
    add_layer(file, "half_primal", std::move(images.halves.primal));
    add_layer(file, "half_dx", std::move(images.halves.dx));
    add_layer(file, "half_dy", std::move(images.halves.dy));
    add_layer(file, "own", std::move(images.own));
    add_layer(file, "guide_albedo", std::move(images.guides.albedo));
    add_layer(file, "guide_normal", std::move(images.guides.normal));
    add_layer(file, "guide_nearness", grey(images.guides.nearness));
    add_layer(file, "guide_roughness", grey(images.guides.roughness));
    BrightestSamples& b = images.brightest;
    if (!b.empty()) {
        add_layer(file, "brightest_primal", std::move(b.primal));
        add_layer(file, "brightest_dx", std::move(b.dx));
        add_layer(file, "brightest_dy", std::move(b.dy));
        add_layer(file, "brightest_albedo", std::move(b.albedo));
        add_layer(file, "brightest_half", grey(b.half));
        file.attributes[samples_attribute] = fmt::format("{}", b.samples);
    }
    if (!is_demodulated)
        return;
    add_layer(file, "mean_albedo", std::move(d.albedo));
    add_layer(file, "sampled_albedo", std::move(d.sampled_albedo));
    add_layer(file, "albedo_variance", grey(d.albedo_variance));
    add_layer(file, "sampled_share", grey(d.sampled_share));
    add_layer(file, "sampled_variance", std::move(d.sampled_variance));
    add_layer(file, "value_covariance", std::move(d.value_covariance));
    add_layer(file, "unexplained_variance", grey(d.unexplained_variance));
    for (std::size_t l = 0; l < images.parts.size(); ++l) {
        CoefficientPart& part = images.parts[l];
        const auto named = [l](const char* name) { return part_layer(l, name); };
        add_layer(file, named("projection"), grey(part.projection));
        add_layer(file, named("primal"), std::move(part.primal));
        add_layer(file, named("dx"), std::move(part.dx));
        add_layer(file, named("dy"), std::move(part.dy));
        add_layer(file, named("primal_variance"), grey(part.primal_variance));
        add_layer(file, named("dx_variance"), grey(part.dx_variance));
        add_layer(file, named("dy_variance"), grey(part.dy_variance));
    }
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
    const int parts = is_expanded(settings) ? part_count(settings.basis) : 0;
    const std::uint64_t pixels = static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
    const std::uint64_t images =
        pixels * (sizeof(Rgb) + BrightestSamples::bytes_a_pixel + HalfDifferences::bytes_a_pixel +
                  GuideImages::bytes_a_pixel + (gradients ? 4 : 1) * sizeof(Rgb) +
                  (gradients ? 3 : 1) * sizeof(float) + (demodulated ? Demodulation::bytes_a_pixel : 0) +
                  static_cast<std::size_t>(parts) * CoefficientPart::bytes_a_pixel);
    const std::uint64_t remodulation = demodulated ? bytes_to_remodulate(size.x, size.y) : 0;
    const bool is_limited = wanted.settings.spikes == Spikes::consistent;
    const std::uint64_t limits = is_limited ? pixels * bytes_to_limit(gradients, demodulated) : 0;
    std::uint64_t done = 0, most = images;
    for (Norm norm : wanted.norms) {
        most = std::max(most, images + remodulation + limits + done +
                                  Reconstructor().bytes_for(size.x, size.y, applied(norm, gradients), threads,
                                                            parts, is_limited));
        done += pixels * sizeof(Rgb);
    }
    return most;
}

// Nothing is kept that is not to be written: a picture takes more memory here than many a scene.
ExrFile reconstruct_layers(GradientImages&& images, const ReconstructionLayers& wanted, ThreadPool& pool,
                           std::vector<ReconstructionStats>& stats) {
    ExrFile file;
    const ParallelFor parallel_for = pool.row_loops();
    ReconstructionSettings settings = wanted.settings;
    for (Norm norm : wanted.norms) {
        settings.norm = norm;
        Reconstructor solver; // its memory goes before the next norm's comes
        // The denoiser has threads of its own.
        const auto cpu_seconds = [&] { return norm == Norm::oidn ? process_cpu_seconds() : pool.cpu_seconds(); };
        const double cpu = cpu_seconds();
        Reconstruction r = reconstruct_if_it_fits(solver, images, settings, parallel_for, pool.size());
        stats.push_back({norm, r.seconds, cpu_seconds() - cpu, r.iterations, r.residual});
        file.layers.push_back({file.layers.empty() ? "" : std::string(to_string(norm)), std::move(r.image)});
    }
    if (wanted.buffers)
        add_buffers(file, std::move(images));
    return file;
}

ExrFile picture_layers(GradientImages&& images, const ReuseMaps& maps, const ReconstructionLayers& wanted,
                       ThreadPool& pool, std::vector<ReconstructionStats>& stats) {
    ExrFile file = reconstruct_layers(std::move(images), wanted, pool, stats);
    if (!wanted.buffers || maps.empty())
        return file;
    add_layer(file, "reused", grey(maps.reused()));
    add_layer(file, "failed", grey(maps.failed()));
    for (int i = 0; i < shift_outcome_count; ++i) {
        const auto outcome = static_cast<ShiftOutcome>(i);
        add_layer(file, fmt::format("shifts_{}", to_string(outcome)), grey(maps.share(outcome)));
    }
    add_layer(file, "survival", grey(maps.survival()));
    add_layer(file, "sharers", grey(maps.sharers));
    add_layer(file, "gain", grey(maps.gain));
    add_layer(file, "samples", grey(maps.paths));
    return file;
}

ExrFile unreconstructed_layers(GradientImages&& images, bool is_exr) {
    ExrFile file;
    if (is_exr && images.has_gradients()) {
        add_buffers(file, std::move(images));
        return file;
    }
    RgbImage& radiance = images.demodulation.empty() ? images.primal : images.demodulation.value;
    for (std::size_t i = 0; i < images.very_direct.size(); ++i)
        radiance.data()[i] += images.very_direct.data()[i];
    add_layer(file, "", std::move(radiance));
    return file;
}

namespace {

void write_as(const std::filesystem::path& output, const std::string& extension, const ExrFile& file) {
    if (extension == ".png")
        write_png(output, file.layers.front().image);
    else
        write_exr(output, file);
}

/// A name that no file in the temporary folder has.
std::filesystem::path free_temporary_name(const std::string& extension) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path();
    for (int i = 1;; ++i)
        if (auto path = folder / fmt::format("tessera-kept-{}{}", i, extension); !std::filesystem::exists(path))
            return path;
}

/// Keeps a picture that cannot be written where it was to be, and says where; nothing if there is no place either.
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
