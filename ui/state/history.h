#pragma once

#include "ui/state/document.h"

#include <deque>
#include <optional>
#include <vector>

namespace tessera {

/// The part of the document that undo restores: settings of the pictures, and the camera.
struct UndoPoint {
    std::vector<PaneSettings> panes;
    bool linked = true;
    SizeChoice size;
    std::optional<std::size_t> sensor; ///< SceneInfo::sensor
    Camera camera;
    float camera_distance = 1; ///< to the camera's target
    Tone tone;

    bool operator==(const UndoPoint&) const = default;
};

/// Undo history of the document.
class History {
public:
    /// Adds the document's state if it has changed. Adds nothing while a button or key is held, so that a whole
    /// drag is one step.
    void note(const Document& document, bool is_held);

    bool can_undo() const { return !before_.empty(); }
    bool can_redo() const { return !after_.empty(); }
    /// Restores the previous or the next state, if there is one.
    void undo(Document& document) { go(document, before_, after_); }
    void redo(Document& document) { go(document, after_, before_); }

private:
    static constexpr std::size_t most_points = 200;
    void go(Document& document, std::deque<UndoPoint>& from, std::deque<UndoPoint>& to);

    std::deque<UndoPoint> before_, after_; // nearest to the present last
    std::optional<UndoPoint> now_;         // the present state; empty before the first note()
};

} // namespace tessera
