// The part of FileDialog that is specific to saving.
#include "recon/enumeration.h"
#include "ui/panels/panels.h"
#include "ui/state/words.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include <imgui.h>

namespace tessera {

namespace {

namespace fs = std::filesystem;

/// Returns a default name without extension: "veach-ajar-gpr-dx".
std::string stem_of(const ViewerState& state, SaveKind kind) {
    const fs::path& scene = state.scene_info.source.file;
    const bool has_folder_name =
        scene.stem() == "scene" && scene.has_parent_path(); // many scenes are FOLDER/scene.xml
    std::error_code ignored;                                // the current folder may be deleted
    std::string stem = scene.empty()     ? "cornell-box"
                       : has_folder_name ? fs::absolute(scene, ignored).parent_path().filename().string()
                                         : scene.stem().string();
    const PaneSettings& pane = state.active().settings;
    if (kind == SaveKind::picture || kind == SaveKind::exr)
        stem += "-" + std::string(short_name(pane.render.method));
    if (kind == SaveKind::picture && pane.buffer != Buffer::reconstruction)
        stem += "-" + std::string(short_name(pane.buffer));
    if (kind != SaveKind::picture && kind != SaveKind::exr)
        stem += "-" + std::string(entry_of(words::saved, kind).id);
    return stem;
}

} // namespace

std::span<const char* const> saved_endings(SaveKind kind) {
    static constexpr const char* png[] = {".png"};
    static constexpr const char* exr[] = {".exr"};
    static constexpr const char* charts[] = {".csv", ".svg", ".png"};
    static constexpr const char* json[] = {".json"};
    static constexpr std::span<const char* const> endings[] = {png, exr, png, charts, json, json};
    return entry_of(endings, kind);
}

/// Starts in the folder of the last save, with an unused file name.
void FileDialog::begin_saving(const ViewerState& state) {
    kind_ = state.layout.save_kind;
    std::error_code ignored; // a deleted current folder causes an error later
    const fs::path folder =
        state.layout.save_folder.empty() ? fs::current_path(ignored) : fs::path(state.layout.save_folder);
    folder_.clear(); // lists the files with another extension
    const auto is_taken = [this](const fs::path& file) { return replaces(file); };
    set_text(unused_name(folder / stem_of(state, kind_), extension(), is_taken).string());
}

/// Whether saving to this path replaces a file: the path itself, or one with another ending of the same kind.
bool FileDialog::replaces(const fs::path& path) const {
    std::error_code ignored;
    const auto exists = [&](const char* ending) {
        return fs::exists(fs::path(path).replace_extension(ending), ignored);
    };
    return fs::exists(path, ignored) || std::ranges::any_of(saved_endings(kind_).subspan(1), exists);
}

/// Draws the choice of what to save. Another kind gets another file name.
void FileDialog::draw_kind(Controls& controls, ViewerState& state) {
    static const std::vector<ChoiceItem> kinds = choice_items(words::saved);
    int kind = static_cast<int>(kind_);
    if (!controls.choice("file.kind", "What", kinds, kind, "Content of the file."))
        return;
    state.layout.save_kind = static_cast<SaveKind>(kind);
    state.layout.save_folder = typed_path(text_.data()).folder.string();
    begin_saving(state);
}

bool FileDialog::can_take(const fs::path& path) const {
    std::error_code ignored;
    if (saves())
        return has_extension(path, extension()) && fs::is_directory(path.parent_path(), ignored) &&
               !fs::is_directory(path, ignored);
    return wants_folder() ? fs::is_directory(path, ignored) : fs::is_regular_file(path, ignored);
}

} // namespace tessera
