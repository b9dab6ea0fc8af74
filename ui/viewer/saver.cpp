#include "ui/viewer/saver.h"

#include "render/io/files.h"
#include "render/io/plain_images.h"
#include "render/scene/camera.h"
#include "ui/charts/charts.h"
#include "ui/gl/gl.h"
#include "ui/settings/settings_file.h"
#include "ui/state/buffer.h"
#include "ui/state/file_names.h"

#include <cstdio>
#include <memory>
#include <optional>

namespace tessera {

namespace {

constexpr const char* no_picture_yet = "There is no picture to save yet: the pane shows a preview, or nothing.";
constexpr int frames_until_menu_closed = 3;

/// Returns the chosen file. If it is empty, returns a dated name with this ending in the folder of the last save.
std::filesystem::path file_to_save(const ViewerState& state, const std::string& chosen,
                                   const std::string& ending) {
    return chosen.empty() ? dated_file(ending, state.layout.save_folder) : std::filesystem::path(chosen);
}

} // namespace

void Saver::fulfil(ViewerState& state, const PictureArea& pictures, const SceneSource& source) {
    // take() clears a wish even if there is nothing to save.
    SaveWishes& wishes = state.wishes.saves;
    if (const auto file = wishes.take(SaveKind::camera))
        save_camera(state, source, *file);
    if (const auto file = wishes.take(SaveKind::settings))
        save_settings(state, *file);
    if (const auto file = wishes.take(SaveKind::exr))
        save_exr(state, source, *file);
    if (const auto file = wishes.take(SaveKind::picture))
        save_picture(state, pictures, *file);
    if (const auto outcome = queue_.take())
        report(*outcome, state);
}

void Saver::finish() {
    for (const SaveQueue::Outcome& outcome : queue_.finish())
        if (!outcome.result)
            std::fprintf(stderr, "%s\n", outcome.error.c_str());
}

void Saver::report(const SaveQueue::Outcome& outcome, ViewerState& state) {
    if (!outcome.result)
        return state.add_message(Message::Kind::error, outcome.error);
    if (!outcome.result->what.empty())
        state.tell("Saved " + outcome.result->what);
    if (outcome.result->then)
        outcome.result->then();
}

void Saver::save_camera(const ViewerState& state, const SceneSource& source, const std::string& file) {
    if (!state.scene)
        return;
    save([file, scene = source.file, folder = state.layout.save_folder, camera = state.camera.camera()] {
        if (file.empty())
            return "the camera to " + store_camera(scene, camera, folder).string();
        write_camera(file, camera);
        return "the camera to " + file;
    });
}

void Saver::save_settings(const ViewerState& state, const std::string& file) {
    save([file = file_to_save(state, file, "-settings.json"), text = settings_json(state)] {
        write_text(file, text);
        return "the settings to " + file.string();
    });
}

void Saver::save_exr(ViewerState& state, const SceneSource& source, const std::string& file) {
    const PaneState& pane = state.active();
    if (!write_exr_)
        return state.add_message(Message::Kind::error, "EXR files cannot be written here.");
    if (!pane.snapshot || pane.snapshot->coarse())
        return state.add_message(Message::Kind::error, no_picture_yet);
    save([write = write_exr_,
          file = file_to_save(state, file, "-" + std::string(short_name(pane.snapshot->settings.method)) + ".exr"),
          picture = SavedPicture{pane.snapshot, pane.settings.reconstruction, source, pane.snapshot->scene.lock(),
                                 state.companions.reference}] {
        write(file, picture);
        return file.string();
    });
}

void Saver::save_picture(ViewerState& state, const PictureArea& pictures, const std::string& file) {
    const PaneSettings& pane = state.active().settings;
    ScreenPixels picture = pictures.active_picture(state);
    if (picture.rgb.empty()) {
        const std::string why = missing_text(sides_of(state, state.active_pane).left, state);
        return state.add_message(Message::Kind::error, why.empty() ? no_picture_yet : why);
    }
    const std::string name =
        std::string(short_name(pane.render.method)) + "-" + std::string(short_name(pane.buffer));
    save([file = file_to_save(state, file, "-" + name + ".png"), picture = std::move(picture)] {
        write_png(file, picture.size, picture.rgb);
        return file.string();
    });
}

void Saver::fulfil_charts(ViewerState& state) {
    if (state.charts.histograms_due) // a new frame follows when they are complete
        return;
    const std::optional<std::string> chosen = state.wishes.saves.take(SaveKind::charts);
    if (!chosen)
        return;
    save([file = file_to_save(state, *chosen, "-charts.csv"), csv = chart_csv(state), svg = chart_svg(state),
          picture = chart_picture(state)] {
        const auto with_ending = [&](const char* ending) {
            return std::filesystem::path(file).replace_extension(ending);
        };
        write_text(file, csv);
        write_text(with_ending(".svg"), svg);
        write_png(with_ending(".png"), picture.size, picture.rgb);
        return "the charts to " + file.string() + ", .svg and .png";
    });
}

bool PictureSaver::after_frame(ViewerState& state, Saver& saver, glm::ivec2 pixels) {
    age_ = state.wishes.saves.has(SaveKind::window) ? age_ + 1 : 0;
    if (age_ == frames_until_menu_closed) {
        const std::string chosen = *state.wishes.saves.take(SaveKind::window);
        saver.save([file = file_to_save(state, chosen, ".png"), screen = read_screen(pixels)] {
            write_png(file, screen.size, screen.rgb);
            return file.string();
        });
    }
    return age_ > 0;
}

} // namespace tessera
