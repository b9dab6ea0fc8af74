// The dialog of files where one is to be saved: what of, and under which name.
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

/// "veach-ajar-gpr-dx": what it is of.
std::string stem_of(const ViewerState& state, SaveKind kind) {
    const fs::path& scene = state.scene_info.source.file;
    const bool has_folder_name = scene.stem() == "scene" && scene.has_parent_path(); // as most are called
    // The current folder may be gone.
    std::error_code ignored;
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

/// Begins where was saved last, with a name that nothing has.
void FileDialog::begin_saving(const ViewerState& state) {
    kind_ = state.layout.save_kind;
    std::error_code ignored; // a current folder that is gone is found out below
    const fs::path folder =
        state.layout.save_folder.empty() ? fs::current_path(ignored) : fs::path(state.layout.save_folder);
    folder_.clear(); // other files are listed
    const auto is_taken = [this](const fs::path& file) { return replaces(file); };
    set_text(free_name(folder / stem_of(state, kind_), extension(), is_taken).string());
}

/// Whether saving to that file replaces one: it itself, or what is written beside it.
bool FileDialog::replaces(const fs::path& path) const {
    std::error_code ignored;
    const auto is_there = [&](const char* ending) {
        return fs::exists(fs::path(path).replace_extension(ending), ignored);
    };
    return fs::exists(path, ignored) || std::ranges::any_of(saved_endings(kind_).subspan(1), is_there);
}

/// Another kind is called otherwise.
void FileDialog::draw_kind(Controls& controls, ViewerState& state) {
    static const std::vector<ChoiceItem> kinds = choice_items(words::saved);
    int kind = static_cast<int>(kind_);
    if (!controls.choice("file.kind", "What", kinds, kind, "What is saved."))
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
