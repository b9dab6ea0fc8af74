#pragma once

#include "ui/image_view.h"
#include "ui/inspector.h"

namespace tessera {

/// One tile of a pass, whose base paths arrive one after the other.
struct SlowMotion {
    static constexpr float least_speed = 0.25f, most_speed = 60;

    /// The base path that arrives, in which of the tile's sampling sets.
    struct Place {
        int set = 0, base = 0;
    };

    bool active = false;
    bool held = false;                  ///< waits for steps by hand
    float speed = 3;                    ///< base paths a second
    std::optional<SampleChoice> sample; ///< a pixel of the tile; empty: it is to be found

    /// The newest that has been found out; null: nothing yet.
    std::shared_ptr<const TileInspection> tile;
    int slot = 0;                 ///< of the pane whose it is, ...
    std::uint64_t generation = 0; ///< ... and of which request

    int current = 0;    ///< base path of the tile, over all its sets; base_count(): all have arrived
    float arrived = 0;  ///< how far that has come, [0, 1]
    float rested = 0;   ///< seconds since all have arrived
    bool frames = true; ///< the picture is to be moved and enlarged, so that the tile is seen well
    std::optional<ImageView> view_before; ///< the picture goes back to it

    void start(const SampleChoice& choice);
    void rewind();
    /// A tile that was asked for is there.
    void take(std::shared_ptr<const TileInspection> found, int of_slot, std::uint64_t of_generation);
    /// Time goes by. True: it is over, and the next tile is due.
    bool advance(float seconds);
    /// One base path on, or back, and waits there.
    void step(int by);
    bool shows_choice() const {
        return tile && sample && sample->slot == slot && tile->tile.contains(sample->pixel);
    }
    bool is_playing() const { return active && shows_choice() && !held; }

    /// Once all have arrived: the last.
    Place place() const;
    const InspectedSet& set() const { return tile->sets[static_cast<std::size_t>(place().set)]; }
    /// A pixel of the tile to the right of this, or of the first one in the row below; after the last the first.
    glm::ivec2 next_pixel(glm::ivec2 size) const;
};

} // namespace tessera
