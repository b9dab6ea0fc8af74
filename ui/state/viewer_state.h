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

/// Requested saves, at most one per kind.
class SaveWishes {
public:
    /// Adds a save to `file`. Empty: to the file of a previous add() of this kind, or else to a file named after
    /// kind and date.
    void add(SaveKind kind, std::string file = {});
    bool has(SaveKind kind) const { return files_[static_cast<std::size_t>(kind)].has_value(); }
    bool has_any() const;
    /// Removes the save of this kind, and returns its file, which may be an empty name. Empty: there is none.
    std::optional<std::string> take(SaveKind kind);

private:
    std::array<std::optional<std::string>, enumerator_count<SaveKind>> files_;
};

/// Requests of panels, actions and the mouse. The code that executes a request clears it.
struct Wishes {
    bool redraw = false;           ///< draw another frame
    bool scroll_to_newest = false; ///< scroll the list of messages to its end
    bool quit = false;
    bool auto_exposure = false; ///< fit exposure or false-colour range to the active pane's picture

    // For the session.
    bool restart = false;
    int steps = 0;                        ///< passes to render while paused
    bool give_up_reconstructions = false; ///< cancel those that have run for long

    // Files to read; an empty name is no request. Settings are read after a scene's load ends.
    bool reload = false; ///< load the present scene again
    std::string open_scene;
    bool open_built_in = false; ///< open the built-in scene
    std::string open_reference;
    std::string open_settings;
    std::string follow_jobs;       ///< folder to follow
    bool cancel_scene = false;     ///< cancel the load of a scene
    bool cancel_reference = false; ///< cancel reading a reference

    // Things to save or make.
    SaveWishes saves;
    bool copy_camera = false;    ///< copy the camera to the clipboard
    bool make_reference = false; ///< render a reference as set in ViewerState::reference_making
    bool stop_making = false;    ///< cancel that render
};

/// Everything that panels, actions and the mouse can change. They change only this state; the viewer compares it
/// with its last requests to the session, and sends the differences. Document is a base class for short access:
/// state.panes, but state.layout.show_help and state.wishes.reload.
struct ViewerState : Document {
    Layout layout;
    Wishes wishes;
    History history;

    bool is_on_show(int pane) const { return !layout.alone || pane == active_pane; }

    /// Returns the render size that results from the size choice and the visible panes, pixels.
    glm::ivec2 fitting_size() const;

    /// Opens a sample in the path inspector.
    void inspect(const SampleChoice& sample);
    /// Opens a sample of the active pane. Sets the seed of this pane, and of all panes if they are linked.
    void inspect(glm::ivec2 pixel, int pass, std::uint64_t seed);

    /// Adds a message. An error opens the list of messages at its end.
    void add_message(Message::Kind kind, std::string text, Message::Origin origin = Message::Origin::viewer);

    /// Adds a note, and shows it as a toast.
    void tell(std::string text);

    /// Requests a save, see SaveWishes::add().
    void save(SaveKind kind, std::string file = {}) { wishes.saves.add(kind, std::move(file)); }

    /// Adds a note about a render's invalid samples, if there are any. The first few can be inspected while the
    /// scene is loaded.
    /// @param whose  begins the message
    /// @param slot   pane of the render, or in which the samples are shown
    void add_invalid(const std::string& whose, const Counters& counters, int slot, const PassOrigin& origin);

    /// Removes the messages of this origin. Closes the list if that removes the last error.
    void drop_messages(Message::Origin origin);
};

} // namespace tessera
