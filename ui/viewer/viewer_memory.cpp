#include "ui/viewer/viewer_memory.h"

#include "render/scene/scene.h"
#include "ui/panes/showing.h"
#include "ui/settings/thumbnails.h"
#include "ui/state/buffer.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <system_error>

namespace tessera {

void ViewerMemory::restore(ViewerState& state, int asked_panes) {
    asked_panes_ = asked_panes;
    if (file_.empty())
        return;
    const LoadedPreferences kept = claim_preferences(file_);
    stored_ = kept.preferences;
    take(kept, state);
    state.layout.restore(stored_);
    if (asked_panes == 0 && stored_.panes > 0)
        state.set_pane_count(stored_.panes);
}

/// Reports the note on the file, and takes over the scenes that other viewers have opened.
void ViewerMemory::take(const LoadedPreferences& kept, ViewerState& state) {
    if (!kept.note.empty() && kept.note != reported_note_)
        state.add_message(Message::Kind::note, kept.note);
    reported_note_ = kept.note;
    stored_.recent_scenes = kept.preferences.recent_scenes;
    state.scene_info.recent = current(state).recent_scenes; // and the scenes that this run has opened
    state.wishes.redraw = true;
}

Preferences ViewerMemory::current(const ViewerState& state) const {
    Preferences preferences{state.layout, 0, stored_.recent_scenes};
    if (state.layout.window_size.x == 0) // no frame has been drawn
        preferences.window = stored_.window;
    for (const std::string& scene : opened_)
        preferences.add_recent(scene);
    const int panes = static_cast<int>(state.panes.size());
    preferences.panes = panes == asked_panes_ && stored_.panes > 0 ? stored_.panes : panes;
    return preferences;
}

void ViewerMemory::add_scene(const std::filesystem::path& scene, ViewerState& state, Saver& saver) {
    std::error_code failed; // there is no current folder: the file's absolute path is unknown
    const std::filesystem::path full = std::filesystem::absolute(scene, failed);
    if (!scene.empty() && !failed)
        opened_.push_back(full);
    if (file_.empty())
        return;
    const Preferences preferences = current(state);
    state.scene_info.recent = preferences.recent_scenes;
    saver.save([this, &state, file = file_, preferences, opened = opened_] {
        return Saved("",
                     [this, &state, kept = store_preferences(file, preferences, opened)] { take(kept, state); });
    });
}

void ViewerMemory::store(const ViewerState& state) const {
    if (file_.empty())
        return;
    const LoadedPreferences kept = store_preferences(file_, current(state), opened_);
    if (!kept.note.empty() && kept.note != reported_note_) // messages are not shown at exit
        std::fprintf(stderr, "%s\n", kept.note.c_str());
}

void ViewerMemory::keep_thumbnail(const ViewerState& state, const SceneSource& shown, Saver& saver) {
    constexpr int min_spp = 16;
    constexpr double min_seconds = 5; // for a scene that renders slowly
    if (file_.empty() || opened_.empty() || shown.file.empty() || thumbnail_scene_ == state.scene_info.shown)
        return;
    const auto is_presentable = [](const PaneState& pane) {
        return pane.snapshot && !pane.snapshot->coarse() &&
               (pane.snapshot->spp >= min_spp || pane.snapshot->seconds >= min_seconds);
    };
    const auto pane = std::find_if(state.panes.rbegin(), state.panes.rend(), is_presentable);
    if (pane == state.panes.rend() || pane->snapshot->scene.lock() != state.scene)
        return;
    RgbImage scratch;
    const RgbImage& image = picture(*pane->snapshot, Buffer::reconstruction, scratch);
    if (image.empty())
        return;
    thumbnail_scene_ = state.scene_info.shown;
    saver.save([this, file = file_, scene = opened_.back(), image] {
        std::vector<float> luminances;
        for (const Rgb& pixel : image)
            luminances.push_back(luminance(pixel));
        try { // a failure, such as a full disk, is not reported
            store_thumbnail(file, scene, thumbnail_of(image, exposure_of(std::move(luminances)).value_or(0)));
        } catch (const std::exception&) {
        }
        return Saved("", [this] { ++thumbnails_stored_; });
    });
}

} // namespace tessera
