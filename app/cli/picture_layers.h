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
/// The EXR attribute with BrightestSamples::samples of the layers "brightest_...".
inline constexpr const char* samples_attribute = "tessera:samples";
/// The EXR attribute with the fraction of the radiance that each reconstruction redistributed, as JSON by norm.
inline constexpr const char* redistributed_attribute = "tessera:redistributed";

/// The layer with the radiance as sampled, directly visible emission included: the color input of a denoiser.
inline constexpr const char* primal_layer = "primal";
/// The layer with the radiance as sampled, without directly visible emission: what reconstructions start from.
inline constexpr const char* without_direct_layer = "primal_without_direct";
/// The layer with the directly visible emission.
inline constexpr const char* direct_layer = "direct";

// The layers of the feature buffers, under the names that other programs read.
inline constexpr const char* albedo_layer = "albedo";
inline constexpr const char* normal_layer = "N"; ///< channels X, Y, Z
inline constexpr const char* depth_layer = "Z";  ///< one channel
inline constexpr const char* roughness_layer = "roughness";
/// The layer with FeatureImages::nearness; "Z" is its inverse, up to rounding.
inline constexpr const char* nearness_layer = "nearness";

/// Value of the layer "Z" where the camera sees no surface, as in Blender. It is finite, so that programs can
/// scale it.
inline constexpr float no_depth = 1e10f;

/// Returns the coefficient's counterpart of a layer of the radiance: "coefficient", "coefficient_dx" or
/// "coefficient_dx_variance" for "primal", "dx" or "dx_variance".
inline std::string coefficient_layer(const std::string& name) {
    return name.starts_with("primal") ? "coefficient" + name.substr(6) : "coefficient_" + name;
}

/// Returns the layer `name` of basis component l: "part0_projection", "part0_primal", "part0_dx".
inline std::string part_layer(std::size_t l, const std::string& name) {
    return "part" + std::to_string(l) + "_" + name;
}

/// The layers to make of a picture's images.
struct ReconstructionLayers {
    std::vector<Norm> norms;           ///< the first is the file's plain RGB; empty: no reconstruction
    ReconstructionSettings settings{}; ///< of all reconstructions, except the norm
    bool buffers = false;              ///< also everything that `tessera reconstruct` and denoisers need
};

/// One reconstruction: its cost and what it did.
struct ReconstructionStats {
    Norm norm;
    double seconds, cpu_seconds; ///< wall time; CPU time of all its threads, not a number where it is not known
    int iterations;
    double residual;
    double redistributed = 0; ///< Reconstruction::redistributed
};

/// Throws BadInput unless the name ends in .exr, or in .png with no more than one picture to hold.
void check_picture_name(const std::filesystem::path& output, const ReconstructionLayers& wanted);

/// Returns an upper bound of the bytes that picture_layers() takes for a picture of that size on `threads`
/// threads, its input images included.
std::uint64_t bytes_for_layers(glm::ivec2 size, const RenderSettings& settings, const ReconstructionLayers& wanted,
                               int threads);

/// Makes the layers of a picture: the reconstructions, named after their norms but for the first, which is the
/// plain RGB; the layer "primal", unless the plain RGB equals it; and the buffers, those that are not empty.
/// Moves the buffers out of `images`. Appends the cost of each reconstruction to `stats`. Throws OutOfMemory if a
/// reconstruction does not fit into memory; `images` are then unchanged. No other thread may use the pool.
ExrFile reconstruct_layers(GradientImages&& images, const ReconstructionLayers& wanted, ThreadPool& pool,
                           std::vector<ReconstructionStats>& stats);

/// Makes the same layers and, with path reuse and buffers, the maps of the reuse. Throws as reconstruct_layers().
ExrFile picture_layers(GradientImages&& images, const ReuseMaps& maps, const ReconstructionLayers& wanted,
                       ThreadPool& pool, std::vector<ReconstructionStats>& stats);

/// Makes the layers to keep of a picture that does not fit into memory to be reconstructed: the raw primal as
/// plain RGB; with gradients, for EXR, also the buffers, from which `tessera reconstruct` makes the picture on
/// another machine. With buffers the plain RGB is left out if even that image does not fit into memory.
ExrFile unreconstructed_layers(GradientImages&& images, bool is_exr);

/// Writes to the header which fraction of the radiance each reconstruction redistributed from fireflies; nothing
/// if none did.
void record_redistributed(ExrFile& file, const std::vector<ReconstructionStats>& stats);

/// Writes the first layer as PNG or all layers as EXR, by the name's extension: to a temporary name, which it
/// renames. If that fails, as on a full disk, it writes to the temporary folder: a render may have taken days.
/// Throws std::runtime_error that names the file and the one that holds the picture instead.
void write_picture(const std::filesystem::path& output, const ExrFile& file);

} // namespace tessera
