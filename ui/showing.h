#pragma once

#include "ui/pane_image.h"
#include "ui/viewer_state.h"

#include <array>
#include <optional>
#include <string>

namespace tessera {

using PaneImages = std::array<PaneImage, most_panes>;

/// What a part of a pane shows: a pane's image, or its difference to another's.
struct Showing {
    int pane = 0;        ///< whose image it is
    int subtrahend = -1; ///< the pane that is taken off; -1: none

    bool operator==(const Showing&) const = default;
};

/// What `pane` shows at a share of its width, with its comparison and the key that flickers.
Showing showing_at(const ViewerState& state, int pane, float share);

/// The part's colours: a difference has +/- colours whatever its buffer.
ColourMap colour_map(const Showing& showing, const ViewerState& state);

/// The range of its false colours: the user's, else the image's own.
ValueRange range_of(const Showing& showing, const ViewerState& state, const PaneImages& images);

/// The number at a place, fractions of the image. Empty: there is no image, or it does not reach there.
std::optional<Rgb> value_at(const Showing& showing, const PaneImages& images, glm::vec2 place);

/// "2  G-PR  Primal", "1  PT - 2  G-PR".
std::string label_of(const Showing& showing, const ViewerState& state);

} // namespace tessera
