#include "ui/pane_image.h"

#include <algorithm>

namespace tessera {

namespace {

template <class Pixel>
const Pixel& pixel_at(const Image<Pixel>& image, glm::vec2 place) {
    const auto index = [](float fraction, int count) {
        return std::clamp(static_cast<int>(fraction * static_cast<float>(count)), 0, count - 1);
    };
    return image(index(place.x, image.width()), index(place.y, image.height()));
}

} // namespace

void PaneImage::take(const Snapshot* snapshot, Buffer buffer, const Companions& companions) {
    static const Snapshot none;
    const Snapshot& from = snapshot ? *snapshot : none;
    std::shared_ptr<const void> source = picture_source(from, buffer);
    std::shared_ptr<const void> companion = companion_source(companions, buffer);
    coarse_ = from.coarse() && source;
    if (source == source_ && companion == companion_ && buffer == buffer_)
        return;
    source_ = std::move(source);
    companion_ = std::move(companion);
    buffer_ = buffer;
    pixels_ = &picture(from, buffer, scratch_, companions);
    texture_.show(*pixels_);
    colours_.show(own_colours(from, buffer));
    outcomes_ = buffer == Buffer::outcomes ? from.reuse : nullptr;
    const RangeKey wanted{from.generation, coarse_, buffer, companion_};
    if (pixels_->empty() || wanted == range_of_)
        return;
    range_ = automatic_range(buffer, *pixels_, companions);
    range_of_ = wanted;
}

const Rgb& PaneImage::at(glm::vec2 place) const {
    return pixel_at(*pixels_, place);
}

const ReuseCounts* PaneImage::outcomes_at(glm::vec2 place) const {
    return outcomes_ ? &pixel_at(outcomes_->counts, place) : nullptr;
}

} // namespace tessera
