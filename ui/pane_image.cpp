#include "ui/pane_image.h"

#include <algorithm>

namespace tessera {

void PaneImage::take(const PaneState& pane, const Companions& companions) {
    static const RgbImage none;
    const Buffer buffer = pane.settings.buffer;
    std::shared_ptr<const void> source = pane.snapshot ? picture_source(*pane.snapshot, buffer) : nullptr;
    std::shared_ptr<const void> companion = pane.snapshot ? companion_source(companions, buffer) : nullptr;
    coarse_ = pane.snapshot && pane.snapshot->coarse && family(buffer) != BufferFamily::first_hit;
    if (source == source_ && companion == companion_ && buffer == buffer_)
        return;
    source_ = std::move(source);
    companion_ = std::move(companion);
    buffer_ = buffer;
    pixels_ = pane.snapshot ? &picture(*pane.snapshot, buffer, scratch_, companions) : &none;
    texture_.show(*pixels_);
    range_ = automatic_range(buffer, *pixels_, companions);
}

const Rgb& PaneImage::at(glm::vec2 place) const {
    const auto index = [](float fraction, int count) {
        return std::clamp(static_cast<int>(fraction * static_cast<float>(count)), 0, count - 1);
    };
    return (*pixels_)(index(place.x, pixels_->width()), index(place.y, pixels_->height()));
}

} // namespace tessera
