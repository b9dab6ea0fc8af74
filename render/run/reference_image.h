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

/// Names of the EXR layers of the two halves.
inline constexpr const char* half_names[] = {"half1", "half2"};

/// A reference: two independent renders of a scene, which differ only in the seed, and their mean. The difference
/// of the halves gives the variance of the mean for any method and reconstruction. An error against both halves
/// does not contain their noise (measure_floor_free_error() in recon/metrics/metrics.h). A bias is equal in both
/// halves, so their difference does not show it.
struct ReferenceImage {
    RgbImage mean;
    std::array<RgbImage, 2> halves;
    std::array<std::uint64_t, 2> seeds;       ///< of the halves; pictures to be measured need other seeds
    std::string settings;                     ///< settings_json() and the norm, as JSON
    std::string camera = {};                  ///< camera_json()
    std::optional<SceneChecksums> scene = {}; ///< empty: unknown
    Image<float> doubt = {}; ///< doubt_of() the halves; empty if the reference was read from a file
};

/// Method and reconstruction of a reference, from its settings.
struct ReferenceOrigin {
    std::optional<Method> method; ///< empty: unknown, such as in files of other programs
    std::string reconstruction;   ///< "l2", "none"; empty: unknown

    bool operator==(const ReferenceOrigin&) const = default;
};

ReferenceOrigin origin_of(const ReferenceImage& reference);

/// Returns "gpr, reconstructed by l2", "pt", or "an unknown method".
std::string to_string(const ReferenceOrigin& origin);

/// Estimates the error of the mean from the difference of the halves.
FloorFreeError error_of(const ReferenceImage& reference);

/// Returns the variance of the mean in each pixel and channel, ((h1 - h2) / 2)^2, a squared radiance. The estimate
/// is unbiased for independent halves. It has one degree of freedom, so only means of it over pixels are useful.
RgbImage variance_of(const ReferenceImage& reference);

/// Finds pixels that are unreliable even if both halves agree: those with a firefly, and those without light. It
/// reads the halves before their reconstruction.
class UnreliablePixels {
public:
    explicit UnreliablePixels(glm::ivec2 size) : fireflies_(size.x, size.y), dark_(size.x, size.y, 1.0f) {}

    /// Adds the means of one half.
    void look_at(const GradientImages& images);
    /// Returns 1 where clamped_radiance() of a half is not black, or where no half has found light although the
    /// pixel sees a surface that is not black; otherwise 0.
    Image<float> unknown() const;

private:
    Image<float> fireflies_, dark_;
};

/// Doubt above which a pixel counts as untrusted; not tuned.
inline constexpr float untrusted_threshold = 0.1f;

/// Returns the relative standard error of each pixel of the mean: the root mean square of half the halves'
/// difference over 3x3 pixels, divided by their mean luminance plus 1 % of that of the picture. It is at least
/// `unknown`, because both halves can have missed the same light.
/// @param unknown  UnreliablePixels::unknown()
Image<float> doubt_of(const std::array<RgbImage, 2>& halves, const Image<float>& unknown);

/// Returns the fraction of untrusted pixels, in [0, 1].
double untrusted_fraction(const Image<float>& doubt);

/// Returns the mean of two images of equal size.
RgbImage mean_of(const RgbImage& a, const RgbImage& b);

/// Returns a checksum of the halves' pixels.
std::uint32_t checksum_of(const ReferenceImage& reference);

/// Writes an EXR file: the mean as plain RGB, the layers half1, half2, variance and doubt. The header
/// holds the method and the reconstruction, the mean's error, the fraction of untrusted pixels and the scene's
/// checksums. Throws std::runtime_error that names the file.
void write_reference(const std::filesystem::path& path, const ReferenceImage& reference);

/// Returns whether a file is an EXR file with the header of a reference. Reads no pixels. Throws
/// std::runtime_error that names the file if it cannot be read.
bool is_reference(const std::filesystem::path& path);

/// Reads a file of write_reference(). Throws std::runtime_error that names any other file.
ReferenceImage read_reference(const std::filesystem::path& path);

/// Returns the scene's checksums from the header of a picture; empty: it has none, such as files of other
/// programs.
std::optional<SceneChecksums> scene_of(const ExrFile& file);

} // namespace tessera
