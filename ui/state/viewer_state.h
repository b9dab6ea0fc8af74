#pragma once

#include "ui/state/document.h"
#include "ui/state/layout.h"
#include "ui/state/wishes.h"

#include <cstdint>
#include <string>

#include <glm/vec2.hpp>

namespace tessera {

/// Everything that panels, actions and the mouse may change. They do no more than that: the viewer compares the
/// state with what it last asked of the session, and sends what differs. The document is a base, as most that is
/// said of the state is said of it: state.panes, but state.layout.show_help and state.wishes.save_exr.
struct ViewerState : Document {
    Layout layout;
    Wishes wishes;

    bool is_on_show(int pane) const { return !layout.alone || pane == active_pane; }

    /// The size that the choice and the panes on show now come to, pixels.
    glm::ivec2 fitting_size() const;

    /// Opens a sample in the path inspector.
    void inspect(const SampleChoice& sample);
    /// Opens one of the active pane, which gets that seed (with the others, where they are linked).
    void inspect(glm::ivec2 pixel, int pass, std::uint64_t seed);

    /// Adds a message; an error opens the list at its end.
    void add_message(Message::Kind kind, std::string text, Message::Origin origin = Message::Origin::viewer);

    /// Adds a note on samples of the scene that a render refused, the first few of which can be inspected if the
    /// scene is still on show. Adds nothing where there are none. `whose` begins it; `slot` is of the pane that
    /// rendered it, or in which the samples are shown.
    void add_refused(const std::string& whose, const Counters& counters, int slot, const PassOrigin& origin);

    /// Takes away the messages of that origin. Closes the list if that leaves no error of some.
    void drop_messages(Message::Origin origin);
};

} // namespace tessera
