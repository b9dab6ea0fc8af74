#include "ui/viewer/scene_switch.h"

#include "render/scene/scene.h"
#include "ui/state/file_names.h"
#include "ui/state/words.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

namespace {

/// Returns the camera of the sensor that the user chose, or the scene's own without a choice.
const Camera& chosen_camera(const Scene& scene, std::optional<std::size_t> sensor) {
    const std::vector<Sensor>& sensors = scene.description().sensors;
    return sensor && *sensor < sensors.size() ? sensors[*sensor].camera : scene.camera();
}

} // namespace

void SceneSwitch::load(SceneOrigin origin) {
    requested_ = std::move(origin);
    load_.start(requested_, wake_);
}

void SceneSwitch::reload(const ViewerState& state) {
    const SceneOrigin origin = load_.running() || !state.scene ? requested_ : shown_;
    if (origin.loader)
        load(origin);
}

void SceneSwitch::cancel(ViewerState& state) {
    if (!load_.running())
        return;
    const SceneOrigin origin = load_.origin();
    const std::string text = "Loading " + origin.name + " was cancelled.";
    load_.cancel();
    state.add_message(Message::Kind::note, text, Message::Origin::failed_load);
    state.scene_info.loading.clear();
    drop_settings_of(state, origin);
    if (!state.scene)
        state.scene_info.problem = {text, false};
}

/// Drops the settings that wait for this load, which has ended without a scene. After a failed reload they apply
/// to the scene on show.
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
    const std::shared_ptr<const Scene> previous = std::exchange(state.scene, std::move(scene));
    const bool is_reload = previous && is_same_scene(shown_, origin);
    shown_ = origin;
    state.scene_info.problem = {};
    state.scene_info.name = origin.name;
    state.scene_info.source = origin.source;
    state.space = {};
    ++state.scene_info.shown;
    if (!is_reload || state.scene_info.sensor >= state.scene->description().sensors.size())
        state.scene_info.sensor = {};
    const Camera& home = chosen_camera(*state.scene, state.scene_info.sensor);
    if (!is_reload || !(chosen_camera(*previous, state.scene_info.sensor) == home)) {
        state.camera.set_home(home, state.scene->center(), state.scene->radius());
        state.set_view({});
    }
    if (!is_reload) {
        state.history = {};
        state.bookmarks.views.clear();
        state.bookmarks.current = -1;
    }
    set_depths(state, is_reload ? previous.get() : nullptr);
}

/// Sets the maximum depth of all panes to the scene's. A reload keeps depths that differ from the previous
/// load's.
/// @param previous  the previous load of the same scene; null: the scene is another one
void SceneSwitch::set_depths(ViewerState& state, const Scene* previous) const {
    const auto depth_of = [&](const Scene& s) {
        return std::clamp(max_depth_.value_or(s.max_depth()), 1, most_edges);
    };
    const auto set_depth = [&](PaneSettings& pane) {
        int& depth = pane.render.max_depth;
        if (!previous || depth == depth_of(*previous))
            depth = depth_of(*state.scene);
    };
    std::ranges::for_each(state.panes, set_depth, &PaneState::settings);
    std::ranges::for_each(state.spare_panes, set_depth);
}

} // namespace tessera
