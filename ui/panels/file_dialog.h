#pragma once

#include "ui/gl/controls.h"
#include "ui/state/file_names.h"
#include "ui/state/viewer_state.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

struct ImGuiInputTextCallbackData;

namespace tessera {

/// Chooses a file that is there: a path to be typed, which Tab completes, and the folder that it leads to, to be
/// clicked.
class FileDialog {
public:
    /// Draws it while state.layout.choosing says what for. What is chosen becomes a wish of the state.
    void draw(glm::vec2 screen, Controls& controls, ViewerState& state);

private:
    void begin(const ViewerState& state);
    void draw_path(Controls& controls);
    void draw_list(Controls& controls, float height);
    void draw_entry(Controls& controls, const FileEntry& entry);
    void draw_buttons(Controls& controls, ViewerState& state);
    void set_text(const std::string& text);
    void read_text();
    void enter();
    static int edit(ImGuiInputTextCallbackData* data);
    int complete(ImGuiInputTextCallbackData& data) const;

    std::optional<FilePurpose> purpose_; // of what is on show
    std::array<char, 4096> text_{};
    bool wants_focus_ = false, wants_cursor_last_ = false; // the text, which was put there
    std::filesystem::path folder_;                         // that is listed
    std::vector<FileEntry> entries_;                       // of the folder
    std::string filter_;                                   // the beginning that was typed, not clicked
    std::string error_;                                    // why there is nothing to choose
    std::filesystem::path chosen_;                         // empty: nothing yet
};

} // namespace tessera
