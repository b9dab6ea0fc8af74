#pragma once

#include "recon/picture/reconstruct.h"
#include "render/film/film.h"
#include "render/io/exr.h"
#include "render/run/thread_pool.h"
#include "render/settings/settings.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

/// The EXR attribute with GradientImages::patch.
inline constexpr const char* patch_attribute = "tessera:patch";
/// BrightestSamples::samples of the layers "brightest_...".
inline constexpr const char* samples_attribute = "tessera:samples";

/// The layer with the coefficient's part that radiance has in layer `name`: "primal", "dx", "dx_variance".
inline std::string coefficient_layer(const std::string& name) {
    return name.starts_with("primal") ? "coefficient" + name.substr(6) : "coefficient_" + name;
}

/// The layer with what the coefficient's part l has as `name`: "projection", "primal", "dx", "dx_variance".
inline std::string part_layer(std::size_t l, const std::string& name) {
    return "part" + std::to_string(l) + "_" + name;
}

/// The layers of a picture file that are made from gradients.
struct ReconstructionLayers {
    std::vector<Norm> norms;           ///< the first is the file's plain RGB; empty: none is made
    ReconstructionSettings settings{}; ///< of each, but for its norm
    bool buffers = false;              ///< primal, dx, dy, direct and variances, too
};

/// What one reconstruction cost: wall seconds, and the CPU seconds of the threads that worked for it; not a number
/// where they are not known.
struct ReconstructionStats {
    Norm norm;
    double seconds, cpu_seconds;
    int iterations;
    double residual;
};

/// Throws BadInput unless the name ends in .exr, or in .png with no more than one picture to hold.
void check_picture_name(const std::filesystem::path& output, const ReconstructionLayers& wanted);

/// The most memory that it takes to make the layers of a picture of that size on so many threads, the images they
/// are made of included.
std::uint64_t bytes_for_layers(glm::ivec2 size, const RenderSettings& settings, const ReconstructionLayers& wanted,
                               int threads);

/// The layers wanted, named as their norms; of the buffers those that are not empty, which are taken from
/// `images`. What each reconstruction cost is appended to `stats`. Throws OutOfMemory where there is no memory for
/// one; `images` are then as they were. Nobody else may use the pool meanwhile.
ExrFile reconstruct_layers(GradientImages&& images, const ReconstructionLayers& wanted, ThreadPool& pool,
                           std::vector<ReconstructionStats>& stats);

/// Those layers and, where pixels share paths, the maps of how that went. Throws likewise.
ExrFile picture_layers(GradientImages&& images, const ReuseMaps& maps, const ReconstructionLayers& wanted,
                       ThreadPool& pool, std::vector<ReconstructionStats>& stats);

/// What there is to keep of a picture that there is no memory to reconstruct; takes little itself. Of gradients
/// and for EXR that are the buffers, of which `tessera reconstruct` makes the picture elsewhere; else, the primal
/// and very direct light.
ExrFile unreconstructed_layers(GradientImages&& images, bool is_exr);

/// Writes the first layer as PNG where the name says so, or all as EXR: aside, and renamed. Where that fails, on a
/// full disk, it is kept in the temporary folder: a render may have taken days. Throws std::runtime_error that
/// names the file, and the one in which the picture is kept.
void write_picture(const std::filesystem::path& output, const ExrFile& file);

} // namespace tessera
