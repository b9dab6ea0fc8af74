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

/// The image of a pane's buffer, here and on the graphics side: taken anew only when there is another one to show.
class PaneImage {
public:
    PaneImage() = default;
    PaneImage(const PaneImage&) = delete; // it may refer to its own scratch image
    PaneImage& operator=(const PaneImage&) = delete;

    /// `snapshot` may be null: some buffers need none.
    void take(const Snapshot* snapshot, Buffer buffer, const Companions& companions);

    bool empty() const { return texture_.empty(); }
    const RgbImage& pixels() const { return *pixels_; }
    /// The pixels, of which differences are taken.
    const ImageTexture& numbers() const { return texture_; }
    /// What is shown by itself: the pixels, or the colours of a buffer that has its own.
    const ImageTexture& texture() const { return colours_.empty() ? texture_ : colours_; }
    Buffer buffer() const { return buffer_; }
    bool coarse() const { return coarse_; }
    /// The range of false colours that fits the first picture of the request. It stays while more samples come, so
    /// that one can see the numbers fall.
    const ValueRange& range() const { return range_; }
    int uploads() const { return texture_.serial(); }
    /// Whether it is a picture of light without any.
    bool is_black() const { return is_black_; }

    /// The value at a place given as fractions of the image, which must not be empty.
    const Rgb& at(glm::vec2 place) const;
    /// How the shifts to the pixel there ended; null: the image is of something else.
    const ReuseCounts* outcomes_at(glm::vec2 place) const;

private:
    std::shared_ptr<const void> source_; // what it is made of: kept, so that it stays unique, and its pixels alive
    std::shared_ptr<const void> companion_;
    Buffer buffer_ = Buffer::reconstruction;
    RgbImage scratch_;
    const RgbImage* pixels_ = &scratch_;
    ImageTexture texture_, colours_;
    std::shared_ptr<const ReuseMaps> outcomes_; // of an image of these
    bool coarse_ = false;
    bool is_black_ = false;

    /// What a range is found for.
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

using PaneImages = std::array<PaneImage, most_panes + 1>; ///< the last: of the_reference

/// What a part of a pane shows: an image, or its difference to another.
struct Showing {
    int pane = 0;        ///< whose image it is: a pane's or the_reference
    int subtrahend = -1; ///< likewise, what is taken off; -1: nothing

    bool operator==(const Showing&) const = default;
};

/// What `pane` shows at a share of its width, with its comparison and the key that flickers.
Showing showing_at(const ViewerState& state, int pane, float share);

/// Where a pane is divided: what is shown to the left and to the right of its middle line. Equal: it is not.
struct Sides {
    Showing left, right;
    bool divided() const { return left != right; }
};
Sides sides_of(const ViewerState& state, int pane);

/// What the image of a pane or of the_reference is of.
Buffer buffer_of(int pane, const ViewerState& state);

/// The part's colours: a difference has +/- colours whatever its buffer.
ColourMap colour_map(const Showing& showing, const ViewerState& state);

/// The range of a buffer's false colours, which all panes share: the user's, else what holds those of all images.
ValueRange range_of(Buffer buffer, const ViewerState& state, const PaneImages& images);

/// How the part is coloured: a canvas view without its place.
CanvasView colours_of(const Showing& showing, const ViewerState& state, const PaneImages& images);

/// The exposure, in stops, that brings all but the brightest of what is shown, or the largest of differences and
/// gradients, to below white. Empty: there is nothing to see.
std::optional<float> exposure_of(const Showing& showing, const PaneImages& images);
/// The same for luminances, or differences of such.
std::optional<float> exposure_of(std::vector<float> values);

/// What a canvas draws for the part.
struct ShowingTextures {
    const ImageTexture& image;
    const ImageTexture* subtrahend; ///< null: nothing is taken off
};
ShowingTextures textures_of(const Showing& showing, const PaneImages& images);

/// Why there is nothing to show, in words for its place; empty: there is, or will be.
std::string missing_text(const Showing& showing, const ViewerState& state);

/// The number at a place, fractions of the image. Empty: there is no image, or it does not reach there.
std::optional<Rgb> value_at(const Showing& showing, const PaneImages& images, glm::vec2 place);

/// "2  G-PR  Primal", "1  PT  minus  2  G-PR", "Reference".
std::string label_of(const Showing& showing, const ViewerState& state);

/// What a pane shows, one pixel for each of the image's, in the colours that are on show; of a wipe, the pane's
/// own picture. Empty: there is none, or only a first look.
ScreenPixels view_picture(int pane, const CanvasShader& shader, const PaneImages& images,
                          const ViewerState& state);

} // namespace tessera
