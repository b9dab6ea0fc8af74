#include "recon/enumeration.h"
#include "ui/gl/theme.h"
#include "ui/panels/panels.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

namespace {

namespace fs = std::filesystem;

struct PurposeText {
    const char* title;
    const char* extension;
    const char* help;
};

const PurposeText& text_of(FilePurpose purpose) {
    static constexpr PurposeText texts[] = {
        {"Open a scene", ".xml", "Opens a Mitsuba scene (.xml)."},
        {"Open a reference", ".exr", "Opens the image to measure errors against (.exr)."},
        {"Load settings", ".json", "Loads settings or a camera that the viewer has saved (.json)."},
        {"Follow a folder", "/",
         "Follows an output folder of tessera bench, sweep or stability."}, // no file has this extension
        {"Save", "", "Writes the file in the background."},
    };
    return entry_of(texts, purpose);
}

std::string with_slash(const fs::path& folder) {
    const std::string text = folder.string();
    return text.empty() || text.back() == '/' ? text : text + "/";
}

} // namespace

void FileDialog::draw(glm::vec2 screen, Controls& controls, ViewerState& state) {
    if (!state.layout.choosing) {
        purpose_.reset();
        return;
    }
    const bool is_new = purpose_ != state.layout.choosing;
    if (is_new)
        begin(state);
    constexpr const char* id = "###choose a file";
    if (is_new)
        ImGui::OpenPopup(id);
    const float font = ImGui::GetFontSize();
    const glm::vec2 size = glm::min(screen, glm::vec2(font * 42, font * 32));
    ImGui::SetNextWindowPos({std::floor((screen.x - size.x) * 0.5f), std::floor((screen.y - size.y) * 0.5f)});
    ImGui::SetNextWindowSize({size.x, size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, font * 0.5f);
    const bool is_open = ImGui::BeginPopupModal(
        id, nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleVar();
    if (!is_open)
        return;
    heading(text_of(*purpose_).title);
    if (saves())
        draw_kind(controls, state);
    draw_path(controls);
    draw_list(controls, ImGui::GetContentRegionAvail().y - ImGui::GetFrameHeightWithSpacing());
    draw_buttons(controls, state);
    if (!chosen_.empty()) {
        if (saves()) {
            state.layout.save_folder = chosen_.parent_path().string();
            state.save(kind_, chosen_.string());
        } else {
            std::string* const wishes[] = {&state.wishes.open_scene, &state.wishes.open_reference,
                                           &state.wishes.open_settings, &state.wishes.follow_jobs};
            *wishes[static_cast<std::size_t>(*purpose_)] = chosen_.string();
        }
        state.layout.choosing.reset();
    }
    if (!state.layout.choosing)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

/// Starts in the folder of the present scene or in the current folder.
void FileDialog::begin(const ViewerState& state) {
    purpose_ = state.layout.choosing;
    chosen_.clear();
    folder_.clear();
    if (saves())
        return begin_saving(state);
    const fs::path& scene = state.scene_info.source.file;
    const bool beside_scene = purpose_ == FilePurpose::scene && !scene.empty();
    std::error_code ignored;
    set_text(with_slash(beside_scene ? fs::absolute(scene, ignored).parent_path() : fs::current_path(ignored)));
}

const char* FileDialog::extension() const {
    return saves() ? saved_endings(kind_).front() : text_of(*purpose_).extension;
}

void FileDialog::set_text(const std::string& text) {
    text_.fill(0);
    text.copy(text_.data(), text_.size() - 1);
    wants_focus_ = wants_cursor_last_ = true;
    read_text();
}

/// Lists the folder of the typed path.
void FileDialog::read_text() {
    const TypedPath typed = typed_path(text_.data());
    filter_ = saves() ? "" : typed.beginning; // a new file has another name than the listed ones
    if (typed.folder == folder_)
        return;
    folder_ = typed.folder;
    entries_ = list_folder(folder_, extension(), error_);
}

/// Callback of the text field: completes on Tab, and moves the cursor to the end of a text set by the program.
int FileDialog::edit(ImGuiInputTextCallbackData* data) {
    auto& self = *static_cast<FileDialog*>(data->UserData);
    if (data->EventFlag == ImGuiInputTextFlags_CallbackCompletion)
        return self.complete(*data);
    if (std::exchange(self.wants_cursor_last_, false))
        data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
    return 0;
}

int FileDialog::complete(ImGuiInputTextCallbackData& data) const {
    const TypedPath typed = typed_path(data.Buf);
    const std::string completed = common_beginning(beginning_with(entries_, typed.beginning));
    if (completed.size() < typed.beginning.size())
        return 0;
    const int begin = data.BufTextLen - static_cast<int>(typed.beginning.size());
    data.DeleteChars(begin, static_cast<int>(typed.beginning.size()));
    data.InsertChars(begin, completed.c_str());
    return 0;
}

void FileDialog::draw_path(Controls& controls) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    const std::string before = text_.data();
    if (std::exchange(wants_focus_, false)) {
        ImGui::SetWindowFocus(); // the list can have the focus, and Dear ImGui 1.90.1 then leaves it there
        ImGui::SetKeyboardFocusHere();
    }
    const bool entered =
        ImGui::InputText("##file.path", text_.data(), text_.size(),
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCompletion |
                             ImGuiInputTextFlags_CallbackAlways,
                         edit, this);
    controls.place("file.path", "Path of the file. Tab completes it, Enter opens the file.");
    if (before != text_.data())
        read_text();
    if (entered)
        enter();
}

void FileDialog::draw_list(Controls& controls, float height) {
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.5f));
    ImGui::BeginChild("list", {0, std::max(height, 1.0f)});
    if (folder_.has_parent_path() && folder_ != folder_.root_path())
        draw_entry(controls, {"..", true});
    const std::vector<FileEntry> shown = beginning_with(entries_, filter_); // a copy: a click changes entries_
    for (const FileEntry& entry : shown)
        draw_entry(controls, entry);
    if (!error_.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, colours::error);
        ImGui::TextUnformatted(error_.c_str());
        ImGui::PopStyleColor();
    } else if (shown.empty()) {
        const std::string file = wants_folder() ? "" : fmt::format(" and no {} file", extension());
        ImGui::TextDisabled("No folder%s%s", file.c_str(), filter_.empty() ? "" : " of that name");
    }
    ImGui::EndChild();
    ImGui::PopStyleColor();
}

void FileDialog::draw_entry(Controls& controls, const FileEntry& entry) {
    const fs::path path = (folder_ / entry.name).lexically_normal();
    const bool selected = !entry.is_folder && path == fs::path(text_.data());
    const std::string label = " " + entry.name + (entry.is_folder ? "/" : "");
    ImGui::PushStyleColor(ImGuiCol_Text, entry.is_folder ? colours::accent : colours::text);
    const bool clicked = ImGui::Selectable(
        label.c_str(), selected, ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups);
    ImGui::PopStyleColor();
    controls.place(("file/" + entry.name).c_str(), path.string().c_str()); // the list cuts off long names
    if (!clicked)
        return;
    if (entry.is_folder)
        return set_text(with_slash(path) + (saves() ? typed_path(text_.data()).beginning : ""));
    const std::string filter = filter_;
    set_text(path.string());
    filter_ = filter;                               // keeps the other entries in the list
    if (selected && ImGui::IsMouseDoubleClicked(0)) // not if the first click opened a folder at this place
        enter();
}

/// Chooses the typed file, or enters the typed folder.
void FileDialog::enter() {
    const fs::path path = typed_file(text_.data());
    std::error_code ignored;
    const bool ends_with_slash = typed_path(text_.data()).beginning.empty();
    if (fs::is_directory(path, ignored) && !(wants_folder() && ends_with_slash))
        set_text(with_slash(path));
    else if (can_take(path))
        chosen_ = path;
    else
        wants_focus_ = wants_cursor_last_ = true; // typing can continue
}

void FileDialog::draw_buttons(Controls& controls, ViewerState& state) {
    const TypedPath typed = typed_path(text_.data());
    const fs::path path = typed_file(text_.data());
    const bool is_file = can_take(path);
    const float width = ImGui::GetFontSize() * 6;
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, is_file ? 1.0f : 0.5f);
    const bool is_there = saves() && replaces(path);
    const char* const verb = wants_folder() ? "Follow" : !saves() ? "Open" : is_there ? "Replace" : "Save";
    if (controls.button("file.open", verb, text_of(*purpose_).help, width) && is_file)
        wants_folder() ? void(chosen_ = path) : enter(); // the folder's name may lack a slash
    ImGui::PopStyleVar();
    ImGui::SameLine();
    if (controls.button("file.cancel", "Cancel", "Closes this dialog without a change (Esc).", width))
        state.layout.choosing.reset();
    if (is_file && is_there) {
        ImGui::SameLine();
        ImGui::TextDisabled("The file exists and will be replaced");
    }
    if (!is_file && !typed.beginning.empty()) {
        ImGui::SameLine();
        if (saves())
            ImGui::TextDisabled("The name must end in %s, in an existing folder", extension());
        else
            ImGui::TextDisabled(wants_folder() ? "There is no such folder" : "There is no such file");
    }
}

} // namespace tessera
