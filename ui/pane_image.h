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
    const ImageTexture& texture() const { return texture_; }
    Buffer buffer() const { return buffer_; }
    bool coarse() const { return coarse_; }
    /// Of false colours: what fits the first picture of the request, and stays while more samples come, so that
    /// one can see the numbers fall.
    const ValueRange& range() const { return range_; }
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
