#include "render/scene/camera.h"
#include "ui/settings/settings_file.h"
#include "ui/state/camera_control.h"
#include "ui/state/file_names.h"
#include "ui/viewer/viewer.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <imgui.h>

namespace tessera {

namespace {

/// Returns the first file with the extension in upper or lower case; null: there is none.
const std::filesystem::path* find_file(const std::vector<std::filesystem::path>& files, const char* extension) {
    const auto found = std::find_if(files.begin(), files.end(), [&](const std::filesystem::path& file) {
        return has_extension(file, extension);
    });
    return found == files.end() ? nullptr : &*found;
}

} // namespace

void Viewer::load(std::string name, SceneLoader loader, SceneSource source) {
    scenes_.load({std::move(name), std::move(source), std::move(loader)});
}

void Viewer::open(const std::filesystem::path& file) {
    scenes_.load(options_.open(file));
    state_.layout.show_gallery = false; // the gallery would hide the scene
}

void Viewer::drop(const std::vector<std::filesystem::path>& files) {
    const std::filesystem::path* scene = options_.open ? find_file(files, ".xml") : nullptr;
    const std::filesystem::path* reference = find_file(files, ".exr");
    const std::filesystem::path* settings = find_file(files, ".json");
    if (scene)
        open(*scene);
    if (reference)
        state_.wishes.open_reference = reference->string();
    if (settings)
        state_.wishes.open_settings = settings->string();
    if (!files.empty() && options_.open && !scene && !reference && !settings)
        state_.add_message(Message::Kind::error, files.front().string() +
                                                     ": the file type is unknown. Drop a Mitsuba scene (.xml), a "
                                                     "reference (.exr) or settings (.json).");
}

void Viewer::load_settings(const std::filesystem::path& file) {
    try {
        apply_settings_file(state_, file);
        state_.tell("Loaded the settings " + file.string());
    } catch (const std::exception& e) {
        state_.add_message(Message::Kind::error, message_of(e));
    }
}

void Viewer::fulfil_wishes() {
    Wishes& wishes = state_.wishes;
    if (std::exchange(wishes.auto_exposure, false))
        pictures_.expose(state_);
    if (std::exchange(wishes.cancel_scene, false))
        scenes_.cancel(state_);
    if (std::exchange(wishes.reload, false))
        scenes_.reload(state_);
    if (const std::string file = std::exchange(wishes.open_scene, {}); !file.empty() && options_.open)
        open(file);
    if (std::exchange(wishes.open_built_in, false) && options_.open)
        open({});
    // Settings wait until a scene load has ended, because the scene replaces their camera and depth.
    if (!wishes.open_settings.empty() && !loading())
        load_settings(std::exchange(wishes.open_settings, {}));
    overlays_.follow_jobs(state_, options_);
    saver_.fulfil(state_, pictures_, scenes_.shown().source);
    if (std::exchange(wishes.copy_camera, false) && state_.scene) {
        ImGui::SetClipboardText(camera_xml(state_.camera.camera()).c_str());
        state_.tell("Copied the camera to the clipboard, as XML for a <sensor> of a Mitsuba scene.");
    }
}

} // namespace tessera
