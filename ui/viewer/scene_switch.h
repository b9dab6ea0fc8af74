#pragma once

#include "ui/jobs/scene_load.h"
#include "ui/state/viewer_state.h"

#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace tessera {

/// Loads scenes in the background, one at a time, and puts each into the state when it is complete. The scene
/// before stays in the state until then, or if the load fails.
class SceneSwitch {
public:
    /// @param max_depth  of all scenes; empty: each scene's own
    /// @param wake       called from the loading thread when a load has ended
    SceneSwitch(std::optional<int> max_depth, std::function<void()> wake)
        : max_depth_(max_depth), wake_(std::move(wake)) {}

    /// Starts a load. Cancels the one under way.
    void load(SceneOrigin origin);
    /// Loads the scene on show again, or the last one that load() was called for if it is not on show yet.
    void reload(const ViewerState& state);
    /// Cancels the load under way, if there is one, and reports it.
    void cancel(ViewerState& state);

    /// Puts a load that has ended into the state: its scene, or its error. True: another scene is on show. A scene
    /// that is loaded again keeps the camera, unless the file's has changed, and what the user has set.
    bool take(ViewerState& state);

    const SceneLoad& under_way() const { return load_; }
    const SceneOrigin& shown() const { return shown_; } ///< origin of the scene on show

private:
    void show(ViewerState& state, std::shared_ptr<const Scene> scene, const SceneOrigin& origin);
    void set_depths(ViewerState& state, const Scene* same_before) const;
    void drop_settings_of(ViewerState& state, const SceneOrigin& origin) const;

    std::optional<int> max_depth_;
    std::function<void()> wake_;
    SceneLoad load_;
    SceneOrigin shown_;
    SceneOrigin asked_; // of the last load()
};

} // namespace tessera
