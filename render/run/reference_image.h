#pragma once

#include "recon/image.h"
#include "recon/metrics/metrics.h"
#include "render/io/exr.h"
#include "render/scene/scene_checksums.h"
#include "render/settings/settings.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <glm/vec2.hpp>

namespace tessera {

/// The layers of the two halves in a reference's file.
inline constexpr const char* half_names[] = {"half1", "half2"};

/// A reference: two independent renders of a scene that differ in the seed alone, and their mean. The difference
/// of the halves gives the variance of the mean, for any method and reconstruction. An error against both halves
/// does not contain their noise (measure_floor_free_error in recon/metrics/metrics.h). A bias of the method or the
/// reconstruction is in both halves, and shows in neither.
struct ReferenceImage {
    RgbImage mean;
    std::array<RgbImage, 2> halves;
    std::array<std::uint64_t, 2> seeds;       ///< of the halves: no picture to be measured may have one of them
    std::string settings;                     ///< JSON: how it was made
    std::string camera = {};                  ///< JSON: from where (render/scene/camera.h)
    std::optional<SceneChecksums> scene = {}; ///< what it shows; empty: its file does not say
    Image<float> doubt = {};                  ///< doubt_of() the halves; empty where it was read from a file
};

/// The method and the reconstruction of a reference, as its settings name them.
struct ReferenceOrigin {
    std::optional<Method> method; ///< empty: unknown, as another program made the file
    std::string reconstruction;   ///< "l2", "none"; empty: unknown

    bool operator==(const ReferenceOrigin&) const = default;
};

ReferenceOrigin origin_of(const ReferenceImage& reference);

/// Returns "gpr, reconstructed by l2", "pt", or "an unknown method".
std::string to_string(const ReferenceOrigin& origin);

/// Estimates the error of the mean from the difference of the halves.
FloorFreeError error_of(const ReferenceImage& reference);

/// The variance of the mean, in each pixel and channel: ((h1 - h2) / 2)^2 [radiance^2], which is unbiased where
/// the halves are independent, but has one degree of freedom: it says something only when blurred, or as a mean.
RgbImage variance_of(const ReferenceImage& reference);

/// What is to be looked for in the halves of a reference before they are pictures: pixels of which next to nothing
/// is known, however well the halves agree.
class KnownPixels {
public:
    explicit KnownPixels(glm::ivec2 size) : ruled_(size.x, size.y), dark_(size.x, size.y, 1.0f) {}

    /// Looks at what one half has found.
    void look_at(const GradientImages& images);
    /// 1 where one sample makes more than a quarter of what a half has found, or no half has found light although
    /// there is something to see; else 0.
    Image<float> unknown() const;

private:
    Image<float> ruled_, dark_;
};

/// A pixel of a reference with a doubt above this is not to be trusted yet.
inline constexpr float most_doubt = 0.1f;

/// How far each pixel of a reference is not to be trusted: the standard error of the mean over its brightness (and
/// 1 % of the picture's), from what the halves differ by in the 3x3 pixels around; at least 1 where one sample
/// alone makes more than a quarter of what a half found, or neither has found any: what such samples miss, both
/// halves may have missed.
/// @param unknown  1 where that is so, else 0
Image<float> doubt_of(const std::array<RgbImage, 2>& halves, const Image<float>& unknown);

/// The share of the pixels that are not to be trusted yet.
double untrusted_share(const Image<float>& doubt);

/// The mean of two images of one size.
RgbImage mean_of(const RgbImage& a, const RgbImage& b);

/// A checksum of the halves' pixels.
std::uint32_t checksum_of(const ReferenceImage& reference);

/// Writes an EXR file: the mean as plain RGB, the layers half1, half2, variance and doubt (see above). The header
/// holds the method and the reconstruction, the mean's error, the fraction of untrusted pixels and the scene's
/// checksums. Throws std::runtime_error that names the file.
void write_reference(const std::filesystem::path& path, const ReferenceImage& reference);

/// Whether the file is one of these, as its header says: no pixels are read. Throws std::runtime_error that names
/// a file that is no EXR.
bool is_reference(const std::filesystem::path& path);

/// Reads what write_reference wrote. Throws std::runtime_error that names the file if it is anything else.
ReferenceImage read_reference(const std::filesystem::path& path);

/// What the header of a picture says that it shows; empty: it does not, as those of other programs.
std::optional<SceneChecksums> scene_of(const ExrFile& file);

} // namespace tessera
