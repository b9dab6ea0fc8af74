#pragma once

#include "ui/companions.h"

#include <optional>

namespace tessera {

/// How far a picture is from a reference.
struct PictureError {
    double relative_mse = 0;
    double standard_error = 0;  ///< of it; not a number where the reference has no halves
    std::size_t not_finite = 0; ///< pixels left out, in either
};

/// Against both halves of a reference that has them, where its own error cancels (measure_floor_free_error);
/// otherwise against its image, from which no picture can be less far than that is from the truth. Empty: they
/// differ in size, or nothing is finite.
std::optional<PictureError> error_to(const Reference& reference, const RgbImage& picture);

/// What a chart of errors to it must tell beside its points; empty: nothing.
std::string caveat_of(const Reference& reference);

/// A reference from the layers of a file. `halves` that are not both of the image's size are dropped.
std::shared_ptr<const Reference> make_reference(std::string name, RgbImage image, std::array<RgbImage, 2> halves,
                                                std::optional<SceneChecksums> scene = {});

} // namespace tessera
