#pragma once

#include "recon/enumeration.h"
#include "ui/state/document.h"
#include "ui/state/history.h"
#include "ui/state/layout.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <glm/vec2.hpp>

namespace tessera {

/// What is to be saved: at most one of each kind, with its file.
class SaveWishes {
public:
    /// Adds one, to that file; empty: to the one that was chosen before, or else one named by what it is and the
    /// date.
    void add(SaveKind kind, std::string file = {});
    bool has(SaveKind kind) const { return files_[static_cast<std::size_t>(kind)].has_value(); }
    bool has_any() const;
    /// Its file, or an empty name; the wish is gone with that, whatever becomes of it. Nothing: there is none.
    std::optional<std::string> take(SaveKind kind);

private:
    std::array<std::optional<std::string>, enumerator_count<SaveKind>> files_;
};

/// What panels, actions and the mouse ask for. Who fulfils a wish clears it.
struct Wishes {
    bool redraw = false;           ///< something has come since the last frame was drawn, and is to be seen
    bool scroll_to_newest = false; ///< of the list of messages
    bool quit = false;
    bool auto_exposure = false; ///< the exposure and the range that show the active pane's picture

    // These are for the session.
    bool restart = false;
    int steps = 0;                        ///< passes to do though paused
    bool give_up_reconstructions = false; ///< those under way for long

    // These are for what is read. An empty name is no file. Settings wait until no scene is on its way.
    bool reload = false; ///< the scene on show
    std::string open_scene;
    bool open_built_in = false; ///< the scene within the program
    std::string open_reference;
    std::string open_settings;
    std::string follow_jobs;       ///< a folder
    bool cancel_scene = false;     ///< the one that is being loaded
    bool cancel_reference = false; ///< the one that is being read

    // These are for what is saved or made.
    SaveWishes saves;
    bool copy_camera = false;    ///< to the clipboard
    bool make_reference = false; ///< as ViewerState::reference_making says
    bool stop_making = false;    ///< that reference
};

/// Everything that panels, actions and the mouse may change. They do no more than that: the viewer compares the
/// state with what it last asked of the session, and sends what differs. The document is a base, as most that is
/// said of the state is said of it: state.panes, but state.layout.show_help and state.wishes.reload.
struct ViewerState : Document {
    Layout layout;
    Wishes wishes;
    History history;

    bool is_on_show(int pane) const { return !layout.alone || pane == active_pane; }

    /// The size that the choice and the panes on show now come to, pixels.
    glm::ivec2 fitting_size() const;

    /// Opens a sample in the path inspector.
    void inspect(const SampleChoice& sample);
    /// Opens one of the active pane, which gets that seed (with the others, where they are linked).
    void inspect(glm::ivec2 pixel, int pass, std::uint64_t seed);

    /// Adds a message; an error opens the list at its end.
    void add_message(Message::Kind kind, std::string text, Message::Origin origin = Message::Origin::viewer);

    /// Adds a note, and shows it over the pictures for a while.
    void tell(std::string text);

    /// Wishes that it is saved: SaveWishes::add.
    void save(SaveKind kind, std::string file = {}) { wishes.saves.add(kind, std::move(file)); }

    /// Adds a note on samples of the scene that a render refused, the first few of which can be inspected if the
    /// scene is still on show. Adds nothing where there are none. `whose` begins it; `slot` is of the pane that
    /// rendered it, or in which the samples are shown.
    void add_refused(const std::string& whose, const Counters& counters, int slot, const PassOrigin& origin);

    /// Takes away the messages of that origin. Closes the list if that leaves no error of some.
    void drop_messages(Message::Origin origin);
};

} // namespace tessera
