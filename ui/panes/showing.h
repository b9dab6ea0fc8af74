#pragma once

#include "ui/gl/canvas.h"
#include "ui/gl/gl.h"
#include "ui/state/viewer_state.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

/// The image of a pane's buffer and its texture. Both are updated only when the image changes.
class PaneImage {
public:
    PaneImage() = default;
    PaneImage(const PaneImage&) = delete; // pixels_ can point to scratch_
    PaneImage& operator=(const PaneImage&) = delete;

    /// Updates the image.
    /// @param snapshot  may be null; some buffers need none
    void take(const Snapshot* snapshot, Buffer buffer, const Companions& companions);

    bool empty() const { return texture_.empty(); }
    const RgbImage& pixels() const { return *pixels_; }
    /// Returns the texture of the pixels, which differences use.
    const ImageTexture& numbers() const { return texture_; }
    /// Returns the texture to display: the pixels, or the colours of a buffer with ColourMap::own.
    const ImageTexture& texture() const { return colours_.empty() ? texture_ : colours_; }
    Buffer buffer() const { return buffer_; }
    bool coarse() const { return coarse_; }
    /// Returns the range of false colours that fits the first picture of the request. It stays constant
    /// afterwards, so that decreasing values are visible.
    const ValueRange& range() const { return range_; }
    int uploads() const { return texture_.serial(); }
    /// Whether all pixels of a reconstruction or primal image are black.
    bool is_black() const { return is_black_; }

    /// Returns the value at a place, fractions of the image. The image must not be empty.
    const Rgb& at(glm::vec2 place) const;
    /// Returns the outcomes of the shifts to the pixel at a place; null: another buffer is shown.
    const ReuseCounts* outcomes_at(glm::vec2 place) const;

private:
    std::shared_ptr<const void> source_; // of the image: keeps pixels_ valid and the address unique
    std::shared_ptr<const void> companion_;
    Buffer buffer_ = Buffer::reconstruction;
    RgbImage scratch_;
    const RgbImage* pixels_ = &scratch_;
    ImageTexture texture_, colours_;
    std::shared_ptr<const ReuseMaps> outcomes_; // only for Buffer::outcomes
    bool coarse_ = false;
    bool is_black_ = false;

    /// Inputs that determine range_.
    struct RangeKey {
        std::uint64_t generation = 0;
        bool coarse = false;
        Buffer buffer = Buffer::reconstruction;
        std::shared_ptr<const void> companion;
        bool operator==(const RangeKey&) const = default;
    };
    ValueRange range_;
    RangeKey range_of_;
};

using PaneImages = std::array<PaneImage, most_panes + 1>; ///< indexed by pane; the last is the_reference

/// Content of a part of a pane: an image, or the difference of two.
struct Showing {
    int pane = 0;        ///< of the image: a pane or the_reference
    int subtrahend = -1; ///< pane or the_reference to subtract; -1: none

    bool operator==(const Showing&) const = default;
};

/// Returns what `pane` shows at a fraction of its width, with its comparison and flicker.
Showing showing_at(const ViewerState& state, int pane, float share);

/// Content of a pane to the left and to the right of a wipe's line; equal without a wipe.
struct Sides {
    Showing left, right;
    bool divided() const { return left != right; }
};
Sides sides_of(const ViewerState& state, int pane);

/// Returns the buffer of a pane or of the_reference.
Buffer buffer_of(int pane, const ViewerState& state);

/// Returns the part's colour map: a signed one for every difference.
ColourMap colour_map(const Showing& showing, const ViewerState& state);

/// Returns the range of a buffer's false colours, which all panes share: the user's, or else the union of the
/// images' ranges.
ValueRange range_of(Buffer buffer, const ViewerState& state, const PaneImages& images);

/// Returns the part's colours as a canvas view without a position.
CanvasView colours_of(const Showing& showing, const ViewerState& state, const PaneImages& images);

/// Returns the exposure, stops, at which 95 % of the nonzero absolute luminances are below 0.8. Empty: all are 0.
std::optional<float> exposure_of(const Showing& showing, const PaneImages& images);
/// Returns the same exposure for given luminances or their differences.
std::optional<float> exposure_of(std::vector<float> values);

/// Textures that a canvas draws for the part.
struct ShowingTextures {
    const ImageTexture& image;
    const ImageTexture* subtrahend; ///< null: none
};
ShowingTextures textures_of(const Showing& showing, const PaneImages& images);

/// Returns the reason why the part has no image, for display; empty: it has one, or is about to.
std::string missing_text(const Showing& showing, const ViewerState& state);

/// Returns the value at a place, fractions of the image. Empty: there is no image, or the place is outside.
std::optional<Rgb> value_at(const Showing& showing, const PaneImages& images, glm::vec2 place);

/// Returns "2  G-PR  Primal", "1  PT  minus  2  G-PR" or "Reference".
std::string label_of(const Showing& showing, const ViewerState& state);

/// Renders a pane's picture in display colours, one pixel per image pixel; for a wipe, the left side's. Empty:
/// there is none, or only a preview.
ScreenPixels view_picture(int pane, const CanvasShader& shader, const PaneImages& images,
                          const ViewerState& state);

} // namespace tessera
