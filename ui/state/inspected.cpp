#include "ui/state/inspected.h"

#include "render/inspect/inspection.h"

#include <algorithm>
#include <utility>

namespace tessera {

namespace {

constexpr float rest = 1.5f; // seconds that a whole tile stays
constexpr float haste = 6;   // past base paths that share nothing

} // namespace

void SlowMotion::start(const SampleChoice& choice) {
    sample = choice;
    if (shows_choice()) // else take() will
        rewind();
}

bool SlowMotion::shows_choice() const {
    return tile && sample && sample->slot == slot && tile->tile.contains(sample->pixel);
}

const InspectedSet& SlowMotion::set() const {
    return tile->sets[static_cast<std::size_t>(place().set)];
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
    const auto pace = [&] { return set().base(place().base).reuse.is_dark() ? haste * speed : speed; };
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
    return rested >= rest;
}

void SlowMotion::step(int by) {
    held = true;
    if (!tile)
        return;
    if (by > 0 && arrived < 1)
        --current; // the one on its way arrives
    current = std::clamp(current + by, 0, std::max(tile->base_count() - 1, 0));
    arrived = 1;
    rested = 0;
}

SlowMotion::Place SlowMotion::place() const {
    Place place{0, current};
    const int last = static_cast<int>(tile->sets.size()) - 1;
    const auto size = [&] { return tile->sets[static_cast<std::size_t>(place.set)].size(); };
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

} // namespace tessera
