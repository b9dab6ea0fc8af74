#pragma once

#include "recon/enumeration.h"
#include "render/session/snapshot.h"
#include "ui/gl/canvas.h"
#include "ui/state/companions.h"

#include <memory>
#include <string>
#include <string_view>

namespace tessera {

/// What a pane can show.
// clang-format off
enum class Buffer {
    reconstruction, primal, dx, dy, reused, outcomes, survival, very_direct,
    error_relative_squared, error_squared, error_absolute, error_relative, // in the order of ErrorKind
    reference,
    albedo, normal, depth, footprint_1, footprint_2,
    primal_variance, dx_variance, dy_variance,
    coefficient, mean_albedo, sampled_albedo, covariance, projection,
    redistributed,
    reuse_set_size, gain, samples
};
// clang-format on
inline constexpr Buffer all_buffers[] = {Buffer::reconstruction,
                                         Buffer::primal,
                                         Buffer::dx,
                                         Buffer::dy,
                                         Buffer::reused,
                                         Buffer::outcomes,
                                         Buffer::survival,
                                         Buffer::very_direct,
                                         Buffer::error_relative_squared,
                                         Buffer::error_squared,
                                         Buffer::error_absolute,
                                         Buffer::error_relative,
                                         Buffer::reference,
                                         Buffer::albedo,
                                         Buffer::normal,
                                         Buffer::depth,
                                         Buffer::footprint_1,
                                         Buffer::footprint_2,
                                         Buffer::primal_variance,
                                         Buffer::dx_variance,
                                         Buffer::dy_variance,
                                         Buffer::coefficient,
                                         Buffer::mean_albedo,
                                         Buffer::sampled_albedo,
                                         Buffer::covariance,
                                         Buffer::projection,
                                         Buffer::redistributed,
                                         Buffer::reuse_set_size,
                                         Buffer::gain,
                                         Buffer::samples};
static_assert(std::size(all_buffers) == enumerator_count<Buffer>);

/// What a buffer is made of.
enum class BufferFamily {
    picture,   ///< a snapshot
    variance,  ///< a snapshot of two or more passes; of gradients, of a method that measures these
    gradient,  ///< a snapshot of a method that measures gradients
    reuse,     ///< a snapshot of a method that shares paths
    error,     ///< a picture and a reference
    reference, ///< the reference itself
    first_hit, ///< the scene and the camera
    basis,     ///< a snapshot of a method whose basis is not none
};

/// What there is to know of a buffer before any image of it.
struct BufferInfo {
    Buffer buffer;
    const char* id;    ///< in log and command line: "reconstruction"
    const char* label; ///< in panels: "Reconstruction"
    const char* help;  ///< what its numbers are, with their unit
    BufferFamily family;
    ColourMap map;
    const char* unit; ///< of false colours; numbers are shown times unit_scale
    float unit_scale;
};
const BufferInfo& info(Buffer buffer);

inline std::string_view short_name(Buffer buffer) {
    return info(buffer).id;
}
inline std::string_view long_name(Buffer buffer) {
    return info(buffer).label;
}
inline ColourMap colour_map(Buffer buffer) {
    return info(buffer).map;
}

inline BufferFamily family(Buffer buffer) {
    return info(buffer).family;
}

/// A method's name as papers write it: "PT", "PR", "G-PT", "G-PR".
std::string_view paper_name(Method method);

/// Whether it shows how wide paths are: of first hits with footprints (FirstHits).
bool is_footprint(Buffer buffer);

/// Whether the buffer shows one part where one is wanted (Companions::part).
bool is_of_parts(Buffer buffer);

/// What of the snapshot the buffer's image is made from: changes exactly when another picture is to be shown.
/// Null: there is none.
std::shared_ptr<const void> picture_source(const Snapshot& snapshot, Buffer buffer);
/// What of the companions the buffer's image is made from beside the snapshot. Null: nothing, or it is not there.
std::shared_ptr<const void> companion_source(const Companions& companions, Buffer buffer);

/// The buffer's image; empty if there is none, as for errors where the sizes differ. Where there is no
/// reconstruction (yet) of the snapshot's size, or none is needed, the primal stands in, which holds the very
/// direct light, so that lamps are not black. `scratch` is storage to build an image in; the result may refer to
/// it, to the snapshot or to the companions.
const RgbImage& picture(const Snapshot& snapshot, Buffer buffer, RgbImage& scratch,
                        const Companions& companions = {});

/// The image in colours of its own, where the buffer has such (ColourMap::own) and there is one; else empty. The
/// numbers of picture() are then what differences are taken of.
RgbImage own_colours(const Snapshot& snapshot, Buffer buffer);

/// Why a pane has no image of its buffer, in words for its place; empty: it has one, or will.
std::string missing_text(const Snapshot* snapshot, Method method, Buffer buffer, const Companions& companions);

/// The value that the last false colour stands for in such a buffer's image: 1 for shares, else the greatest,
/// rounded up to one that reads well. 1 for an image without any value above 0.
float top_value(Buffer buffer, const RgbImage& image);

/// The range of false colours that shows the buffer's image well. Errors have the same for all images of a
/// reference, so that panes and times can be compared.
ValueRange automatic_range(Buffer buffer, const RgbImage& image, const Companions& companions = {});

/// What the colours of a range stand for: "reused: 0 .. 50 paths a pass", "relMSE: 0.0001 .. 1  log scale".
std::string legend_text(Buffer buffer, const ValueRange& range);

} // namespace tessera
