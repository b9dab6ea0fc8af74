#pragma once

#include "ui/canvas.h"
#include "ui/viewer_state.h"

#include <memory>

namespace tessera {

/// The image of a pane's buffer, here and on the graphics side: taken anew only when there is another one to show.
class PaneImage {
public:
    PaneImage() = default;
    PaneImage(const PaneImage&) = delete; // it may refer to its own scratch image
    PaneImage& operator=(const PaneImage&) = delete;

    void take(const PaneState& pane, const Companions& companions);

    bool empty() const { return texture_.empty(); }
    const RgbImage& pixels() const { return *pixels_; }
    const ImageTexture& texture() const { return texture_; }
    Buffer buffer() const { return buffer_; }
    bool coarse() const { return coarse_; }
    const ValueRange& range() const { return range_; } ///< of false colours that fits the image
    int uploads() const { return texture_.serial(); }

    /// The value at a place given as fractions of the image. Not if empty.
    const Rgb& at(glm::vec2 place) const;

private:
    std::shared_ptr<const void> source_; // what it is made of: kept, so that it stays unique, and its pixels alive
    std::shared_ptr<const void> companion_;
    Buffer buffer_ = Buffer::reconstruction;
    RgbImage scratch_;
    const RgbImage* pixels_ = &scratch_;
    ImageTexture texture_;
    ValueRange range_;
    bool coarse_ = false;
};

} // namespace tessera
