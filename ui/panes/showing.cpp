#include "ui/panes/showing.h"

#include "ui/state/pane_labels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/core.h>

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
    is_black_ = (buffer == Buffer::reconstruction || buffer == Buffer::primal) && !pixels_->empty() &&
                std::all_of(pixels_->begin(), pixels_->end(), [](const Rgb& p) { return p == Rgb(0); });
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

namespace {

const PaneSettings& settings(const ViewerState& state, int pane) {
    return state.panes[pane].settings;
}

const PaneImage& image_of(int pane, const PaneImages& images) {
    return images[pane];
}

std::string name(const ViewerState& state, int pane) {
    if (pane == the_reference)
        return "Reference";
    return std::to_string(pane + 1) + "  " + pane_label(state, pane);
}

std::string missing_text(int pane, const ViewerState& state) {
    if (pane == the_reference)
        return missing_text(nullptr, Method::pt, Buffer::reference, state.companions);
    const PaneState& shown = state.panes[pane];
    return missing_text(shown.snapshot.get(), shown.settings.render.method, shown.settings.buffer,
                        state.companions);
}

} // namespace

Showing showing_at(const ViewerState& state, int pane, float share) {
    const int other = state.compared_with(pane);
    if (other == pane)
        return {pane};
    if (state.layout.flicker && pane == state.active_pane)
        return {other};
    switch (settings(state, pane).comparison.kind) {
    case Comparison::Kind::off:
        break;
    case Comparison::Kind::wipe:
        return {share < state.layout.wipe ? pane : other};
    case Comparison::Kind::difference:
        return {pane, other};
    }
    return {pane};
}

Sides sides_of(const ViewerState& state, int pane) {
    return {showing_at(state, pane, -1), showing_at(state, pane, 2)};
}

Buffer buffer_of(int pane, const ViewerState& state) {
    return pane == the_reference ? Buffer::reference : settings(state, pane).buffer;
}

ColourMap colour_map(const Showing& showing, const ViewerState& state) {
    return showing.subtrahend >= 0 ? ColourMap::signed_difference : colour_map(buffer_of(showing.pane, state));
}

ValueRange range_of(Buffer buffer, const ViewerState& state, const PaneImages& images) {
    if (const auto set = state.display.ranges.find(buffer); set != state.display.ranges.end())
        return set->second;
    std::optional<ValueRange> all;
    for (const PaneImage& image : images) {
        if (image.empty() || image.buffer() != buffer)
            continue;
        const ValueRange& own = image.range();
        all = all ? ValueRange{std::min(all->low, own.low), std::max(all->high, own.high), own.logarithmic} : own;
    }
    return all.value_or(ValueRange{});
}

CanvasView colours_of(const Showing& showing, const ViewerState& state, const PaneImages& images) {
    CanvasView view;
    view.colour_map = colour_map(showing, state);
    view.tone = state.display.tone;
    if (view.colour_map == ColourMap::signed_difference)
        view.tone.exposure = state.display.tone.of_differences();
    view.range = range_of(buffer_of(showing.pane, state), state, images);
    view.coarse = image_of(showing.pane, images).coarse();
    view.mark_negative = state.display.mark_negative;
    return view;
}

std::optional<float> exposure_of(const Showing& showing, const PaneImages& images) {
    const RgbImage& image = image_of(showing.pane, images).pixels();
    std::vector<float> values;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const glm::vec2 place((static_cast<float>(x) + 0.5f) / static_cast<float>(image.width()),
                                  (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height()));
            values.push_back(luminance(value_at(showing, images, place).value_or(Rgb(0))));
        }
    return exposure_of(std::move(values));
}

std::optional<float> exposure_of(std::vector<float> values) {
    constexpr float quantile = 0.95f, brightness = 0.8f; // not tuned
    for (float& value : values)
        value = std::abs(value);
    std::erase_if(values, [](float value) { return !(std::isfinite(value) && value > 0); });
    if (values.empty())
        return std::nullopt;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<float>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return std::log2(brightness / *at);
}

ShowingTextures textures_of(const Showing& showing, const PaneImages& images) {
    const PaneImage& image = image_of(showing.pane, images);
    if (showing.subtrahend < 0)
        return {image.texture(), nullptr};
    return {image.numbers(), &image_of(showing.subtrahend, images).numbers()};
}

std::string missing_text(const Showing& showing, const ViewerState& state) {
    const std::string text = missing_text(showing.pane, state);
    return text.empty() && showing.subtrahend >= 0 ? missing_text(showing.subtrahend, state) : text;
}

std::optional<Rgb> value_at(const Showing& showing, const PaneImages& images, glm::vec2 place) {
    const PaneImage& image = image_of(showing.pane, images);
    if (image.empty() || place.x < 0 || place.y < 0 || place.x >= 1 || place.y >= 1)
        return std::nullopt;
    if (showing.subtrahend < 0)
        return image.at(place);
    const PaneImage& other = image_of(showing.subtrahend, images);
    return other.empty() ? std::nullopt : std::optional(image.at(place) - other.at(place));
}

std::string label_of(const Showing& showing, const ViewerState& state) {
    if (showing.subtrahend >= 0)
        return name(state, showing.pane) + "  minus  " + name(state, showing.subtrahend);
    if (showing.pane == the_reference)
        return name(state, showing.pane);
    const Buffer buffer = settings(state, showing.pane).buffer;
    const std::shared_ptr<const int>& component = state.companions.component;
    return name(state, showing.pane) + "  " + std::string(long_name(buffer)) +
           (has_components(buffer) && component ? fmt::format(", component {}", *component) : "");
}

ScreenPixels view_picture(int pane, const CanvasShader& shader, const PaneImages& images,
                          const ViewerState& state) {
    const Showing showing = sides_of(state, pane).left;
    const PaneImage& image = images[showing.pane];
    const auto is_missing = [&](int i) {
        const PaneImage& candidate = images[i];
        return candidate.empty() || candidate.coarse();
    };
    if (is_missing(showing.pane) || (showing.subtrahend >= 0 && is_missing(showing.subtrahend)))
        return {};
    CanvasView view = colours_of(showing, state, images);
    view.pane_size = {image.pixels().width(), image.pixels().height()};
    view.image_extent = view.pane_size;
    Canvas canvas;
    const ShowingTextures textures = textures_of(showing, images);
    canvas.draw(shader, textures.image, view, textures.subtrahend);
    const DrawInto source(canvas.framebuffer());
    return read_screen(view.pane_size);
}

} // namespace tessera
