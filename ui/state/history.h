#pragma once

#include "ui/state/document.h"

#include <deque>
#include <optional>
#include <vector>

namespace tessera {

/// What of the document can be taken back: what a user sets of the pictures, and from where they are seen.
struct UndoPoint {
    std::vector<PaneSettings> panes;
    bool linked = true;
    SizeChoice size;
    Camera camera;
    float camera_distance = 1; ///< to its target
    Tone tone;

    bool operator==(const UndoPoint&) const = default;
};

/// The points that the document has been at since its scene was loaded first, to go back to, and forth again.
class History {
public:
    /// Takes down where the document is. While something is held (a drag, a key), it is on its way, and nothing is
    /// taken down: a drag is one step.
    void note(const Document& document, bool is_held);

    bool can_undo() const { return !before_.empty(); }
    bool can_redo() const { return !after_.empty(); }
    /// Takes the document to the point before, or after; nothing where there is none.
    void undo(Document& document) { go(document, before_, after_); }
    void redo(Document& document) { go(document, after_, before_); }

private:
    static constexpr std::size_t most_points = 200;
    void go(Document& document, std::deque<UndoPoint>& from, std::deque<UndoPoint>& to);

    std::deque<UndoPoint> before_, after_; // the nearest last
    std::optional<UndoPoint> now_;         // empty: nothing was taken down yet
};

} // namespace tessera
