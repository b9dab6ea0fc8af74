#pragma once

#include "ui/jobs/scene_load.h"
#include "ui/state/viewer_state.h"

#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace tessera {

/// Loads scenes in the background, one at a time, and puts each into the state when it is complete. If the load
/// fails, the scene on show stays.
class SceneSwitch {
public:
    /// @param max_depth  maximum depth for all scenes; empty: each scene's own
    /// @param wake       called from the loading thread when a load has ended
    SceneSwitch(std::optional<int> max_depth, std::function<void()> wake)
        : max_depth_(max_depth), wake_(std::move(wake)) {}

    /// Starts a load, and cancels the one under way.
    void load(SceneOrigin origin);
    /// Reloads the scene on show. While a load runs or no scene is on show, repeats the last load() instead.
    void reload(const ViewerState& state);
    /// Cancels the load under way, if there is one, and reports it.
    void cancel(ViewerState& state);

    /// Puts a finished load into the state: its scene, or its error. A reload keeps the user's settings, and the
    /// camera unless the file's camera has changed. Returns whether a new scene is on show.
    bool take(ViewerState& state);

    const SceneLoad& under_way() const { return load_; }
    const SceneOrigin& shown() const { return shown_; } ///< origin of the scene on show

private:
    void show(ViewerState& state, std::shared_ptr<const Scene> scene, const SceneOrigin& origin);
    void set_depths(ViewerState& state, const Scene* previous) const;
    void drop_settings_of(ViewerState& state, const SceneOrigin& origin) const;

    std::optional<int> max_depth_;
    std::function<void()> wake_;
    SceneLoad load_;
    SceneOrigin shown_;
    SceneOrigin requested_; // argument of the last load()
};

} // namespace tessera
