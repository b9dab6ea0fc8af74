#pragma once

#include "recon/enumeration.h"
#include "render/session/snapshot.h"
#include "ui/gl/canvas.h"
#include "ui/state/companions.h"

#include <memory>
#include <string>
#include <string_view>

namespace tessera {

/// An image that a pane can show.
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

/// Source of a buffer's image.
enum class BufferFamily {
    picture,   ///< a snapshot
    variance,  ///< a snapshot of two or more passes; for gradients, of a method that measures them
    gradient,  ///< a snapshot of a method that measures gradients
    reuse,     ///< a snapshot of a method that reuses paths
    error,     ///< a picture and a reference
    reference, ///< the reference itself
    first_hit, ///< scene and camera
    basis,     ///< a snapshot with a basis other than none
};

/// Constant properties of a buffer.
struct BufferInfo {
    Buffer buffer;
    const char* id;    ///< in log and command line: "reconstruction"
    const char* label; ///< in panels: "Result"
    const char* help;  ///< meaning and unit of its values
    BufferFamily family;
    ColourMap map;
    const char* unit; ///< of the displayed values, which are the image's times unit_scale
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

/// Returns a method's name in papers: "PT", "PR", "G-PT", "G-PR".
std::string_view paper_name(Method method);

/// Whether the buffer needs first hits with footprints (FirstHits).
bool is_footprint(Buffer buffer);

/// Whether the buffer can show a single basis component (Companions::part).
bool has_components(Buffer buffer);

/// Returns the part of the snapshot from which picture() makes the buffer's image. The pointer changes exactly
/// when the image does. Null: there is no image, or it does not depend on the snapshot.
std::shared_ptr<const void> picture_source(const Snapshot& snapshot, Buffer buffer);
/// Returns the part of the companions from which picture() makes the buffer's image. Null: it needs none, or it
/// is missing.
std::shared_ptr<const void> companion_source(const Companions& companions, Buffer buffer);

/// Returns the buffer's image; empty if there is none, for example an error buffer with a reference of another
/// size. The primal with directly visible emission replaces a missing reconstruction of the snapshot's size.
/// @param scratch  storage for the image; the result refers to it, to the snapshot or to the companions
const RgbImage& picture(const Snapshot& snapshot, Buffer buffer, RgbImage& scratch,
                        const Companions& companions = {});

/// Returns the image in display colours for a buffer with ColourMap::own; otherwise empty. Differences use the
/// values of picture().
RgbImage own_colours(const Snapshot& snapshot, Buffer buffer);

/// Returns the reason why a pane has no image of its buffer, for display; empty: it has one, or is about to.
std::string missing_text(const Snapshot* snapshot, Method method, Buffer buffer, const Companions& companions);

/// Returns the value of the last false colour: 1 for fractions and for images without positive values, otherwise
/// the image's maximum, rounded up to a short number.
float top_value(Buffer buffer, const RgbImage& image);

/// Returns the default range of false colours for the buffer's image. Error buffers have one range per reference,
/// so that panes and passes can be compared.
ValueRange automatic_range(Buffer buffer, const RgbImage& image, const Companions& companions = {});

/// Returns the caption of a legend: "reused: 0 .. 50 paths per pass", "relMSE: 0.0001 .. 1  log scale".
std::string legend_text(Buffer buffer, const ValueRange& range);

} // namespace tessera
