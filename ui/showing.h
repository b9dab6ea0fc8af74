#pragma once

#include "ui/pane_image.h"
#include "ui/viewer_state.h"

#include <array>
#include <optional>
#include <string>

namespace tessera {

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

} // namespace tessera
