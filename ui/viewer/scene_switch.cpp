#include "ui/viewer/scene_switch.h"

#include "render/scene/scene.h"
#include "ui/state/file_names.h"
#include "ui/state/words.h"

#include <algorithm>
#include <string>

namespace tessera {

void SceneSwitch::load(SceneOrigin origin) {
    asked_ = std::move(origin);
    load_.start(asked_, wake_);
}

void SceneSwitch::reload(const ViewerState& state) {
    const SceneOrigin origin = load_.running() || !state.scene ? asked_ : shown_;
    if (origin.loader)
        load(origin);
}

void SceneSwitch::cancel(ViewerState& state) {
    if (!load_.running())
        return;
    const SceneOrigin origin = load_.origin();
    const std::string text = "Loading " + origin.name + " was given up.";
    load_.cancel();
    state.add_message(Message::Kind::note, text, Message::Origin::failed_load);
    state.scene_info.loading.clear();
    drop_settings_of(state, origin);
    if (!state.scene)
        state.scene_info.problem = {text, false};
}

/// Drops the settings that wait for a scene which does not come, unless they are for the one on show.
void SceneSwitch::drop_settings_of(ViewerState& state, const SceneOrigin& origin) const {
    if (!is_same_scene(shown_, origin))
        state.wishes.open_settings.clear();
}

bool SceneSwitch::take(ViewerState& state) {
    std::optional<SceneLoadResult> result = load_.take();
    state.scene_info.loading = load_.running() ? to_string(load_.progress()) : "";
    if (!result)
        return false;
    using Origin = Message::Origin;
    state.drop_messages(Origin::failed_load);
    if (result->scene)
        state.drop_messages(Origin::scene);
    for (SceneNote& note : result->notes)
        state.add_message(note.is_error ? Message::Kind::error : Message::Kind::note, std::move(note.text),
                          result->scene ? Origin::scene : Origin::failed_load);
    if (result->scene) {
        show(state, std::move(result->scene), result->origin);
        return true;
    }
    if (!state.scene)
        state.scene_info.problem = {result->error, true};
    drop_settings_of(state, result->origin);
    state.add_message(Message::Kind::error, std::move(result->error), Origin::failed_load);
    return false;
}

void SceneSwitch::show(ViewerState& state, std::shared_ptr<const Scene> scene, const SceneOrigin& origin) {
    const std::shared_ptr<const Scene> before = std::exchange(state.scene, std::move(scene));
    const bool again = before && is_same_scene(shown_, origin);
    shown_ = origin;
    state.scene_info.problem = {};
    state.scene_info.name = origin.name;
    state.scene_info.source = origin.source;
    state.space = {};
    ++state.scene_info.shown;
    if (!again || !(before->camera() == state.scene->camera())) {
        state.camera.set_home(state.scene->camera(), state.scene->center(), state.scene->radius());
        state.set_view({});
    }
    if (!again) {
        state.history = {};
        state.bookmarks.views.clear();
        state.bookmarks.current = -1;
    }
    set_depths(state, again ? before.get() : nullptr);
}

/// Sets the maximum depth of all panes to the scene's.
/// @param same_before  the same scene as loaded before, against which a depth that the user has set is recognised
/// and
///                     kept; null: it is another scene
void SceneSwitch::set_depths(ViewerState& state, const Scene* same_before) const {
    const auto depth_of = [&](const Scene& s) {
        return std::clamp(max_depth_.value_or(s.max_depth()), 1, most_edges);
    };
    const auto set_depth = [&](PaneSettings& pane) {
        int& depth = pane.render.max_depth;
        if (!same_before || depth == depth_of(*same_before))
            depth = depth_of(*state.scene);
    };
    std::ranges::for_each(state.panes, set_depth, &PaneState::settings);
    std::ranges::for_each(state.spare_panes, set_depth);
}

} // namespace tessera
