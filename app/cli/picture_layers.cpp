#include "app/cli/picture_layers.h"

#include "app/cli/terminal.h"
#include "render/io/files.h"
#include "render/io/plain_images.h"

#include <string>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

/// Adds the image as a layer, if there is one.
void add_layer(ExrFile& file, std::string name, RgbImage image) {
    if (!image.empty())
        file.layers.push_back({std::move(name), std::move(image)});
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

// Nothing is kept that is not to be written: a picture takes more memory here than many a scene.
ExrFile reconstruct_layers(GradientImages images, const ReconstructionLayers& wanted, ThreadPool& pool,
                           std::vector<ReconstructionStats>& stats) {
    ExrFile file;
    const ParallelFor parallel_for = pool.loops();
    ReconstructionSettings settings = wanted.settings;
    for (Norm norm : wanted.norms) {
        settings.norm = norm;
        const double cpu = pool.cpu_seconds();
        Reconstruction r = reconstruct(images, settings, parallel_for);
        stats.push_back({norm, r.seconds, pool.cpu_seconds() - cpu, r.iterations, r.residual});
        file.layers.push_back({file.layers.empty() ? "" : std::string(to_string(norm)), std::move(r.image)});
    }
    if (wanted.buffers) {
        add_layer(file, "primal", std::move(images.primal));
        add_layer(file, "dx", std::move(images.dx));
        add_layer(file, "dy", std::move(images.dy));
        add_layer(file, "direct", std::move(images.very_direct));
        add_layer(file, "primal_variance", grey(images.primal_variance));
        add_layer(file, "dx_variance", grey(images.dx_variance));
        add_layer(file, "dy_variance", grey(images.dy_variance));
        file.attributes[patch_attribute] = fmt::format("{}", images.patch);
    }
    return file;
}

ExrFile picture_layers(GradientImages images, const ReuseMaps& maps, const ReconstructionLayers& wanted,
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
        throw std::runtime_error(error.what() + keep_aside(extension, file));
    }
}

} // namespace tessera
