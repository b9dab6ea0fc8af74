#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/io/plain_images.h"
#include "render/scene/camera.h"
#include "ui/charts/charts.h"
#include "ui/panes/showing.h"
#include "ui/settings/settings_file.h"
#include "ui/settings/thumbnails.h"
#include "ui/state/buffer.h"
#include "ui/state/camera_control.h"
#include "ui/state/file_names.h"
#include "ui/viewer/viewer.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <system_error>
#include <utility>

#include <imgui.h>

namespace tessera {

namespace {

constexpr const char* no_picture_yet = "There is no picture to save yet: only a first look, or none.";

/// The first file with the extension, in either case; null: there is none.
const std::filesystem::path* find_file(const std::vector<std::filesystem::path>& files, const char* extension) {
    const auto found = std::find_if(files.begin(), files.end(), [&](const std::filesystem::path& file) {
        return has_extension(file, extension);
    });
    return found == files.end() ? nullptr : &*found;
}

} // namespace

// --- reading ---

void Viewer::load(std::string name, SceneLoader loader, SceneSource source) {
    asked_ = {std::move(name), std::move(source), std::move(loader)};
    load_.start(asked_, options_.wake);
}

void Viewer::reload() {
    const SceneOrigin origin = load_.running() || !state_.scene ? asked_ : shown_;
    if (origin.loader)
        load(origin.name, origin.loader, origin.source);
}

void Viewer::open(const std::filesystem::path& file) {
    const SceneOrigin origin = options_.open(file);
    load(origin.name, origin.loader, origin.source);
    state_.layout.show_gallery = false; // it would hide the scene
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
                                                     ": this is no scene; what can be dropped here is a Mitsuba "
                                                     "scene, an .xml file, a reference, an .exr file, or "
                                                     "settings, a .json file");
}

void Viewer::drop_settings_of(const SceneOrigin& origin) {
    if (!is_same_scene(shown_, origin))
        state_.wishes.open_settings.clear();
}

void Viewer::load_settings(const std::filesystem::path& file) {
    try {
        apply_settings_file(state_, file);
        state_.tell("The settings are now those of " + file.string());
    } catch (const std::exception& e) {
        state_.add_message(Message::Kind::error, message_of(e));
    }
}

// --- wishes ---

void Viewer::fulfil_wishes() {
    if (std::exchange(state_.wishes.cancel_scene, false) && load_.running()) {
        state_.add_message(Message::Kind::note, "Loading " + load_.origin().name + " was given up.",
                           Message::Origin::failed_load);
        load_.cancel();
        state_.loading.clear();
        drop_settings_of(load_.origin());
        if (!state_.scene)
            state_.scene_problem = {"Loading " + load_.origin().name + " was given up.", false};
    }
    if (std::exchange(state_.wishes.reload, false))
        reload();
    if (const std::string file = std::exchange(state_.wishes.open_scene, {}); !file.empty() && options_.open)
        open(file);
    if (std::exchange(state_.wishes.open_built_in, false) && options_.open)
        open({});
    // Settings wait for a scene under way, which would put its own camera and depth in their place.
    if (!state_.wishes.open_settings.empty() && !load_.running())
        load_settings(std::exchange(state_.wishes.open_settings, {}));
    follow_jobs();
    fulfil_saves();
    if (std::exchange(state_.wishes.copy_camera, false) && state_.scene) {
        ImGui::SetClipboardText(camera_xml(state_.camera.camera()).c_str());
        state_.tell("The camera is on the clipboard, for a <sensor> of a Mitsuba scene.");
    }
}

void Viewer::follow_jobs() {
    const std::filesystem::path folder = std::exchange(state_.wishes.follow_jobs, {});
    if (folder.empty() || !options_.read_jobs)
        return;
    std::error_code gone; // the current folder: then it is called as it was given
    const std::filesystem::path whole = std::filesystem::absolute(folder, gone).lexically_normal();
    follower_.follow(gone ? folder : whole, options_.read_jobs(folder), options_.wake);
    state_.layout.show_jobs = true;
}

std::filesystem::path Viewer::file_to_save(const std::string& chosen, const std::string& ending) const {
    return chosen.empty() ? dated_file(ending, state_.layout.save_folder) : std::filesystem::path(chosen);
}

void Viewer::save_camera(const std::string& file) {
    if (!state_.scene)
        return;
    save([file, scene = shown_.source.file, folder = state_.layout.save_folder, camera = state_.camera.camera()] {
        if (file.empty())
            return "the camera to " + store_camera(scene, camera, folder).string();
        write_camera(file, camera);
        return "the camera to " + file;
    });
}

void Viewer::save_settings(const std::string& file) {
    save([file = file_to_save(file, "-settings.json"), text = settings_json(state_)] {
        write_text(file, text);
        return "the settings to " + file.string();
    });
}

/// Each wish is gone with its file before it is known whether there is something to save.
void Viewer::fulfil_saves() {
    const auto fulfil = [this](SaveKind kind, void (Viewer::*save_as)(const std::string&)) {
        if (const auto file = state_.wishes.saves.take(kind))
            (this->*save_as)(*file);
    };
    fulfil(SaveKind::camera, &Viewer::save_camera);
    fulfil(SaveKind::settings, &Viewer::save_settings);
    fulfil(SaveKind::exr, &Viewer::save_exr);
    fulfil(SaveKind::picture, &Viewer::save_picture);
    if (const auto outcome = save_queue_.take())
        take(*outcome);
}

void Viewer::take(const SaveQueue::Outcome& outcome) {
    if (!outcome.result)
        return state_.add_message(Message::Kind::error, outcome.error);
    if (!outcome.result->what.empty())
        state_.tell("Saved " + outcome.result->what);
    if (outcome.result->then)
        outcome.result->then();
}

void Viewer::save_exr(const std::string& file) {
    const PaneState& pane = state_.active();
    if (!options_.write_exr)
        return state_.add_message(Message::Kind::error, "EXR files cannot be written here.");
    if (!pane.snapshot || pane.snapshot->coarse())
        return state_.add_message(Message::Kind::error, no_picture_yet);
    save([write = options_.write_exr,
          file = file_to_save(file, "-" + std::string(short_name(pane.snapshot->settings.method)) + ".exr"),
          picture = SavedPicture{pane.snapshot, pane.settings.reconstruction, shown_.source,
                                 pane.snapshot->scene.lock(), state_.companions.reference}] {
        write(file, picture);
        return file.string();
    });
}

void Viewer::save_picture(const std::string& file) {
    const PaneSettings& pane = state_.active().settings;
    ScreenPixels picture = view_picture(state_.active_pane, shader_, images_, state_);
    if (picture.rgb.empty()) {
        const std::string why = missing_text(sides_of(state_, state_.active_pane).left, state_);
        return state_.add_message(Message::Kind::error, why.empty() ? no_picture_yet : why);
    }
    const std::string name =
        std::string(short_name(pane.render.method)) + "-" + std::string(short_name(pane.buffer));
    save([file = file_to_save(file, "-" + name + ".png"), picture = std::move(picture)] {
        write_png(file, picture.size, picture.rgb);
        return file.string();
    });
}

void Viewer::save_charts(const std::string& file) {
    save([file = file_to_save(file, "-charts.csv"), csv = chart_csv(state_), svg = chart_svg(state_),
          picture = chart_picture(state_)] {
        const auto with_ending = [&](const char* ending) {
            return std::filesystem::path(file).replace_extension(ending);
        };
        write_text(file, csv);
        write_text(with_ending(".svg"), svg);
        write_png(with_ending(".png"), picture.size, picture.rgb);
        return "the charts to " + file.string() + ", .svg and .png";
    });
}

// --- what is remembered ---

void Viewer::take_preferences() {
    if (options_.preferences.empty())
        return;
    const KeptPreferences kept = claim_preferences(options_.preferences);
    preferences_ = kept.preferences;
    take(kept);
    state_.layout.restore(preferences_);
    if (options_.panes_as_remembered && preferences_.panes > 0)
        state_.set_pane_count(preferences_.panes);
}

/// Takes in what the file says of itself, and the scenes that other viewers have opened.
void Viewer::take(const KeptPreferences& kept) {
    if (!kept.note.empty() && kept.note != told_of_preferences_)
        state_.add_message(Message::Kind::note, kept.note);
    told_of_preferences_ = kept.note;
    preferences_.recent_scenes = kept.preferences.recent_scenes;
    state_.recent_scenes = current_preferences().recent_scenes; // more may have been opened meanwhile
    state_.wishes.redraw = true;
}

Preferences Viewer::current_preferences() const {
    Preferences now{state_.layout, 0, preferences_.recent_scenes};
    if (state_.layout.window_size.x == 0) // nothing has been drawn
        now.window = preferences_.window;
    for (const std::string& scene : opened_scenes_)
        now.add_recent(scene);
    // What was asked for on the command line is for this time only.
    const int panes = static_cast<int>(state_.panes.size());
    now.panes = panes == asked_panes_ && preferences_.panes > 0 ? preferences_.panes : panes;
    return now;
}

void Viewer::remember() {
    if (options_.preferences.empty())
        return;
    const KeptPreferences kept = store_preferences(options_.preferences, current_preferences(), opened_scenes_);
    if (!kept.note.empty() && kept.note != told_of_preferences_) // there is nobody to read messages any more
        std::fprintf(stderr, "%s\n", kept.note.c_str());
}

/// Stores in the background: the disk may take its time, also to tell what other viewers have stored.
void Viewer::remember_later() {
    if (options_.preferences.empty())
        return;
    const Preferences now = current_preferences();
    state_.recent_scenes = now.recent_scenes;
    save([this, file = options_.preferences, now, opened = opened_scenes_] {
        return Saved("", [this, kept = store_preferences(file, now, opened)] { take(kept); });
    });
}

/// Keeps a picture of the scene for the gallery, once, when it is worth looking at.
void Viewer::keep_thumbnail() {
    constexpr int enough_spp = 16;
    constexpr double enough_seconds = 5; // of a scene that renders slowly
    if (options_.preferences.empty() || opened_scenes_.empty() || shown_.source.file.empty() ||
        pictured_ == state_.scenes_shown)
        return;
    const auto shows_much = [](const PaneState& pane) {
        return pane.snapshot && !pane.snapshot->coarse() &&
               (pane.snapshot->spp >= enough_spp || pane.snapshot->seconds >= enough_seconds);
    };
    const auto pane = std::find_if(state_.panes.rbegin(), state_.panes.rend(), shows_much);
    if (pane == state_.panes.rend() || pane->snapshot->scene.lock() != state_.scene)
        return;
    RgbImage scratch;
    const RgbImage& image = picture(*pane->snapshot, Buffer::reconstruction, scratch);
    if (image.empty())
        return;
    pictured_ = state_.scenes_shown;
    save([this, file = options_.preferences, scene = opened_scenes_.back(), image] {
        std::vector<float> luminances;
        for (const Rgb& pixel : image)
            luminances.push_back(luminance(pixel));
        try { // a full disk is nothing to tell of here
            store_thumbnail(file, scene, thumbnail_of(image, exposure_of(std::move(luminances)).value_or(0)));
        } catch (const std::exception&) {
        }
        return Saved("", [this] { ++thumbnails_stored_; });
    });
}

} // namespace tessera
