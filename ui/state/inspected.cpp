#include "ui/state/inspected.h"

#include "render/inspect/inspection.h"
#include "ui/state/words.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

constexpr float rest_seconds = 1.5f; // display time of a finished tile
constexpr float dark_speed_up = 6;   // for base paths without light to reuse

} // namespace

void SlowMotion::start(const SampleChoice& choice) {
    sample = choice;
    if (shows_choice()) // otherwise take() rewinds
        rewind();
}

bool SlowMotion::shows_choice() const {
    return tile && sample && sample->slot == slot && tile->tile.contains(sample->pixel);
}

const InspectedSet& SlowMotion::set() const {
    return tile->sets[place().set];
}

void SlowMotion::rewind() {
    current = 0;
    arrived = rested = 0;
}

void SlowMotion::take(std::shared_ptr<const TileInspection> found, int of_slot, std::uint64_t of_generation) {
    frames = frames || !tile || !(tile->tile == found->tile) || slot != of_slot;
    tile = std::move(found);
    slot = of_slot;
    generation = of_generation;
    rewind();
}

bool SlowMotion::advance(float seconds) {
    if (!is_playing())
        return false;
    const int count = tile->base_count();
    const auto pace = [&] { return set().base(place().base).reuse.is_dark() ? dark_speed_up * speed : speed; };
    float left = seconds;
    while (current < count && arrived + left * pace() >= 1) {
        left -= (1 - arrived) / pace();
        arrived = 0;
        ++current;
    }
    if (current < count)
        arrived += left * pace();
    if (current < count)
        return false;
    arrived = 1;
    rested += left;
    return rested >= rest_seconds;
}

void SlowMotion::step(int by) {
    held = true;
    if (!tile)
        return;
    if (by > 0 && arrived < 1)
        --current; // completes the current one
    current = std::clamp(current + by, 0, std::max(tile->base_count() - 1, 0));
    arrived = 1;
    rested = 0;
}

SlowMotion::Place SlowMotion::place() const {
    Place place{0, current};
    const int last = static_cast<int>(tile->sets.size()) - 1;
    const auto size = [&] { return tile->sets[place.set].size(); };
    while (place.base >= size() && place.set < last) {
        place.base -= size();
        ++place.set;
    }
    place.base = std::min(place.base, size() - 1);
    return place;
}

glm::ivec2 SlowMotion::next_pixel(glm::ivec2 size) const {
    const PixelRect& t = tile->tile;
    if (t.x1 < size.x)
        return {t.x1, std::max(t.y0, 0)};
    return {0, t.y1 < size.y ? t.y1 : 0};
}

namespace {

struct Outcome {
    ImU32 colour;
    const char* help;
};

constexpr Outcome table[] = {
    // in the order of ShiftOutcome
    {IM_COL32(72, 214, 140, 255), "At least one light path of the base path contributes to the other pixel."},
    {IM_COL32(255, 84, 84, 255), "No light path contributes, and a new edge of the offset path is occluded."},
    {IM_COL32(255, 160, 60, 255),
     "Base and offset vertex scatter in different ways, or only one of their edges is long enough to connect, so "
     "that the shift has no inverse."},
    {IM_COL32(190, 120, 255, 255),
     "The half vector has no refracted direction at the offset vertex: total internal reflection."},
    {IM_COL32(90, 160, 255, 255), "A ray left the scene, or the other pixel sees nothing."},
    {IM_COL32(150, 150, 158, 255), "The offset path carries no light: its BSDF is zero, or it hits no emitter."},
};
static_assert(std::size(table) == shift_outcome_count);

const Outcome& entry(ShiftOutcome outcome) {
    return table[static_cast<std::size_t>(outcome)];
}

} // namespace

ImU32 outcome_colour(ShiftOutcome outcome) {
    return entry(outcome).colour;
}

const char* outcome_help(ShiftOutcome outcome) {
    return entry(outcome).help;
}

RgbImage outcome_colours(const ReuseMaps& maps) {
    std::array<Rgb, shift_outcome_count> colours;
    std::transform(std::begin(table), std::end(table), colours.begin(), [](const Outcome& outcome) {
        const auto channel = [&](int shift) { return static_cast<float>(outcome.colour >> shift & 255) / 255; };
        return Rgb(channel(IM_COL32_R_SHIFT), channel(IM_COL32_G_SHIFT), channel(IM_COL32_B_SHIFT));
    });
    RgbImage image(maps.counts.width(), maps.counts.height());
    std::transform(maps.counts.begin(), maps.counts.end(), image.begin(), [&](const ReuseCounts& counts) {
        Rgb sum(0);
        for (std::size_t i = 0; i < colours.size(); ++i)
            sum += colours[i] * static_cast<float>(counts.shifts[i]);
        return sum / static_cast<float>(std::max(counts.tried(), 1u));
    });
    return image;
}

std::string outcome_shares(const ReuseCounts& counts) {
    std::array<std::size_t, shift_outcome_count> order;
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return counts.shifts[a] > counts.shifts[b]; });
    std::string text;
    for (std::size_t i : order) {
        if (counts.shifts[i] == 0)
            break;
        const double percent = 100.0 * counts.shifts[i] / counts.tried();
        text += fmt::format("{}{} {:.{}f} %", text.empty() ? "" : ", ",
                            label_of_identifier(to_string(static_cast<ShiftOutcome>(i))), percent,
                            percent < 9.95 ? 1 : 0);
    }
    return text.empty() ? "no shifts" : text;
}

} // namespace tessera
