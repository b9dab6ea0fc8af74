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

    /// `snapshot` may be null: some buffers need none.
    void take(const Snapshot* snapshot, Buffer buffer, const Companions& companions);

    bool empty() const { return texture_.empty(); }
    const RgbImage& pixels() const { return *pixels_; }
    /// What differences are taken of: the pixels, ...
    const ImageTexture& numbers() const { return texture_; }
    /// ... and what is shown by itself: the same, but for a buffer with colours of its own.
    const ImageTexture& texture() const { return colours_.empty() ? texture_ : colours_; }
    Buffer buffer() const { return buffer_; }
    bool coarse() const { return coarse_; }
    /// Of false colours: what fits the first picture of the request, and stays while more samples come, so that
    /// one can see the numbers fall.
    const ValueRange& range() const { return range_; }
    int uploads() const { return texture_.serial(); }

    /// The value at a place given as fractions of the image. Not if empty.
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

} // namespace tessera
