// Viewer: what it reads and writes.
#include "render/load/camera_file.h"
#include "ui/camera_store.h"
#include "ui/output_files.h"
#include "ui/settings_file.h"
#include "ui/viewer.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <utility>

#include <imgui.h>

namespace tessera {

namespace {

/// The first file with the extension, in either case; null: there is none.
const std::filesystem::path* find_file(const std::vector<std::filesystem::path>& files, const char* extension) {
    const auto has_it = [&](const std::filesystem::path& file) {
        std::string own = file.extension().string();
        std::transform(own.begin(), own.end(), own.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        return own == extension;
    };
    const auto found = std::find_if(files.begin(), files.end(), has_it);
    return found == files.end() ? nullptr : &*found;
}

} // namespace

// --- reading ---

void Viewer::load(std::string name, SceneLoader loader, std::filesystem::path file) {
    asked_ = {std::move(name), std::move(file), std::move(loader)};
    load_.start(asked_, options_.wake);
}

void Viewer::reload() {
    const SceneOrigin origin = load_.running() || !state_.scene ? asked_ : shown_;
    if (origin.loader)
        load(origin.name, origin.loader, origin.file);
}

void Viewer::drop(const std::vector<std::filesystem::path>& files) {
    const std::filesystem::path* scene = options_.open ? find_file(files, ".xml") : nullptr;
    const std::filesystem::path* reference = find_file(files, ".exr");
    const std::filesystem::path* settings = find_file(files, ".json");
    if (scene)
        load(scene->string(), options_.open(*scene), *scene);
    if (reference)
        state_.reference_file = reference->string();
    if (settings)
        load_settings(*settings);
    if (!files.empty() && options_.open && !scene && !reference && !settings)
        state_.add_message(Message::Kind::error, files.front().string() +
                                                     ": this is no scene; what can be dropped here is a Mitsuba "
                                                     "scene, an .xml file, a reference, an .exr file, or "
                                                     "settings, a .json file");
}

void Viewer::load_settings(const std::filesystem::path& file) {
    try {
        apply_settings_file(state_, file);
        state_.add_message(Message::Kind::note, "The settings are now those of " + file.string());
    } catch (const std::exception& e) {
        state_.add_message(Message::Kind::error, e.what());
    }
}

// --- wishes ---

void Viewer::fulfil_wishes() {
    if (std::exchange(state_.reload, false))
        reload();
    if (const std::string file = std::exchange(state_.open_scene, {}); !file.empty() && options_.open)
        load(file, options_.open(file), file);
    if (const std::string file = std::exchange(state_.settings_file, {}); !file.empty())
        load_settings(file);
    fulfil_saves();
    if (std::exchange(state_.copy_camera, false) && state_.scene) {
        ImGui::SetClipboardText(camera_xml(state_.camera.camera()).c_str());
        state_.add_message(Message::Kind::note,
                           "The camera is on the clipboard, for a <sensor> of a Mitsuba scene.");
    }
}

void Viewer::fulfil_saves() {
    if (std::exchange(state_.save_camera, false) && state_.scene)
        save([&] { return "the camera to " + store_camera(shown_.file, state_.camera.camera()).string(); });
    if (std::exchange(state_.save_settings, false))
        save([&] { return "the settings to " + write_dated("-settings.json", settings_json(state_)); });
    if (std::exchange(state_.save_exr, false))
        save_exr();
    if (const auto outcome = save_job_.poll())
        state_.add_message(outcome->result ? Message::Kind::note : Message::Kind::error,
                           outcome->result ? "Saved " + *outcome->result : outcome->error);
}

/// Tells how it went. `write` returns what was saved where.
void Viewer::save(const std::function<std::string()>& write) {
    try {
        state_.add_message(Message::Kind::note, "Saved " + write());
    } catch (const std::exception& e) {
        state_.add_message(Message::Kind::error, e.what());
    }
}

void Viewer::save_exr() {
    const PaneState& pane = state_.active();
    if (!options_.write_exr || !pane.snapshot || pane.snapshot->coarse || save_job_.running())
        return;
    const std::filesystem::path file =
        dated_file("-" + std::string(short_name(pane.snapshot->settings.method)) + ".exr");
    save_job_.start(
        [write = options_.write_exr, file, scene = shown_.file, snapshot = pane.snapshot,
         reconstruction = pane.settings.reconstruction](std::stop_token) {
            write(file, scene, *snapshot, reconstruction);
            return file.string();
        },
        options_.wake);
}

// --- what is remembered ---

void Viewer::take_preferences() {
    if (options_.preferences.empty())
        return;
    std::string note;
    preferences_ = read_preferences(options_.preferences, note);
    if (!note.empty())
        state_.add_message(Message::Kind::note, note);
    state_.recent_scenes = preferences_.recent_scenes;
    state_.theme = preferences_.theme;
    state_.ui_scale = preferences_.ui_scale;
    state_.show_panel = preferences_.show_panel;
    state_.show_statistics = preferences_.show_statistics;
    state_.show_charts = preferences_.show_charts;
}

/// A layout that cannot be remembered is no reason to fail.
void Viewer::remember() {
    if (options_.preferences.empty())
        return;
    if (state_.window_size.x > 0) // it has been drawn
        preferences_.window_size = state_.window_size;
    preferences_.theme = state_.theme;
    preferences_.ui_scale = state_.ui_scale;
    preferences_.show_panel = state_.show_panel;
    preferences_.show_statistics = state_.show_statistics;
    preferences_.show_charts = state_.show_charts;
    try {
        write_preferences(options_.preferences, preferences_);
    } catch (const std::exception&) {
    }
}

} // namespace tessera
