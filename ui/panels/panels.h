#pragma once

#include "render/load/scene_source.h"
#include "render/session/snapshot.h"
#include "ui/gl/controls.h"
#include "ui/gl/gl.h"
#include "ui/gl/image_view.h"
#include "ui/jobs/background_job.h"
#include "ui/jobs/followed_folder.h"
#include "ui/jobs/scene_load.h"
#include "ui/state/file_names.h"
#include "ui/state/viewer_state.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <imgui.h>

struct ImGuiInputTextCallbackData;

namespace tessera {

// Windows around the pictures. Each function draws into the current Dear ImGui frame, and changes only the state.

/// Draws the menu bar. Returns its height, screen units.
float draw_menu_bar(Controls& controls, ViewerState& state);

/// Draws the settings of the active pane, or of all panes if linked, and those of display, size and camera.
void draw_settings_panel(const ScreenRect& where, Controls& controls, ViewerState& state);

/// Draws the edge between `pictures` and the panels to their right, which the mouse can drag.
void draw_panel_edge(const ScreenRect& pictures, Controls& controls, ViewerState& state);

/// Draws the counters of the active pane's render.
void draw_statistics_panel(const ScreenRect& where, Controls& controls, const ViewerState& state);

/// Draws the reason why there is no scene, and buttons to open one, over the pictures.
void draw_no_scene(const ScreenRect& where, Controls& controls, ViewerState& state);

/// Draws the dialog that renders a reference, or the progress of that render, over everything.
void draw_reference_dialog(glm::vec2 screen, Controls& controls, ViewerState& state);

/// Draws the dialog that chooses a sample for the path inspector, over everything.
void draw_sample_dialog(glm::vec2 screen, Controls& controls, ViewerState& state);

/// Draws the messages, newest last, over the pictures. The pictures' size does not depend on them.
void draw_message_panel(const ScreenRect& where, Controls& controls, ViewerState& state);

/// Help page over everything: all actions by menu, and all gestures, filtered by typed words.
class HelpPage {
public:
    void draw(glm::vec2 screen, Controls& controls, ViewerState& state);

private:
    std::array<char, 128> text_{};
};

/// Draws the progress of a scene's load and a button to cancel it, over the pictures.
/// @param what     name of the scene
/// @param seconds  since the start of the load
void draw_loading(const ScreenRect& where, Controls& controls, ViewerState& state, const std::string& what,
                  const LoadProgress::State& progress, double seconds);

/// Draws the toast over the lower edge of the pictures until its time is over.
void draw_toast(const ScreenRect& where, Controls& controls, ViewerState& state);

/// Page over the pictures with the jobs of the followed folder and charts of its results.
class JobsPanel {
public:
    /// Draws the page. To be called only while state.layout.show_jobs.
    void draw(const ScreenRect& where, Controls& controls, ViewerState& state, const FolderFollower::View& view);

private:
    void draw_charts(Controls& controls, const FollowedFolder& seen, glm::vec2 room);
    void draw_list(Controls& controls, const FollowedFolder& seen);

    std::filesystem::path folder_; // the displayed folder
    int chart_ = 0;                // index of the displayed chart
    bool only_claimed_ = false;
};

/// Page over the pictures with scenes to open and an area to drop files.
class Gallery {
public:
    struct Sources {
        const GalleryMaker& maker;                ///< may be empty: only recent scenes are listed
        const std::filesystem::path& preferences; ///< file in whose folder thumbnails lie; empty: no thumbnails
        int thumbnails_stored;                    ///< number so far; thumbnails are read again when it changes
        const std::function<void()>& wake;        ///< called from another thread when entries are ready
    };
    /// Draws the page. To be called only while state.layout.show_gallery.
    void draw(const ScreenRect& where, Controls& controls, ViewerState& state, const Sources& sources);

private:
    /// Entries with the textures of their pictures.
    struct Shelf {
        std::vector<GalleryEntry> entries;
        std::vector<GlTexture> textures; // one per entry, uploaded when first drawn
        void fill(std::vector<GalleryEntry> with);
    };
    struct RecentRequest {
        std::vector<std::string> scenes;
        int thumbnails_stored;
        bool operator==(const RecentRequest&) const = default;
    };
    void take_entries(ViewerState& state, const Sources& sources);
    static void draw_card(const std::string& id, const GalleryEntry& entry, GlTexture& texture, Controls& controls,
                          ViewerState& state);
    static void draw_cards(const std::string& prefix, Shelf& shelf, Controls& controls, ViewerState& state);

    BackgroundJob<int, GalleryContents> job_;
    BackgroundJob<RecentRequest, std::vector<GalleryEntry>> recent_job_;
    Shelf scenes_, recent_;
};

/// List of all commands over everything, filtered by typed words.
class CommandPalette {
public:
    /// Draws the list while state.layout.show_palette, and runs the chosen command.
    void draw(glm::vec2 screen, Controls& controls, ViewerState& state);

private:
    void draw_list(Controls& controls, ViewerState& state);

    std::array<char, 128> text_{};
    int chosen_ = 0, seen_ = 0; // indices in the filtered list: the chosen entry, and the one scrolled to
    bool was_shown_ = false;
};

/// A displayed number of a render's counters.
struct Statistic {
    std::string id; ///< "rays.camera"
    std::string label;
    std::string value;
    std::optional<double> share; ///< fraction of the group's total, [0, 1]
    std::string help;
};

struct StatisticGroup {
    std::string title;
    std::vector<Statistic> statistics;
};

/// Returns the snapshot's counters in groups. Reuse and shifts have a group only if they occurred.
std::vector<StatisticGroup> statistics(const Snapshot& snapshot);

/// Returns "9999", "12.3 k", "4.56 M" or "7.89 G".
std::string count_text(std::uint64_t count);

/// Returns the endings of the files that a save of this kind writes: ".png", or ".csv", ".svg", ".png". The
/// chosen file has the first; the others are written beside it.
std::span<const char* const> saved_endings(SaveKind kind);

/// Dialog that chooses a file or folder: a typed path with completion, and a list of the path's folder.
class FileDialog {
public:
    /// Draws the dialog while state.layout.choosing is set. The chosen file becomes a request in state.wishes.
    void draw(glm::vec2 screen, Controls& controls, ViewerState& state);

private:
    void begin(const ViewerState& state);
    void begin_saving(const ViewerState& state);
    void draw_kind(Controls& controls, ViewerState& state);
    const char* extension() const;
    bool can_take(const std::filesystem::path& path) const;
    bool replaces(const std::filesystem::path& path) const;
    void draw_path(Controls& controls);
    void draw_list(Controls& controls, float height);
    void draw_entry(Controls& controls, const FileEntry& entry);
    void draw_buttons(Controls& controls, ViewerState& state);
    void set_text(const std::string& text);
    void read_text();
    void enter();
    bool saves() const { return purpose_ == FilePurpose::save; }
    bool wants_folder() const { return purpose_ == FilePurpose::jobs; }
    static int edit(ImGuiInputTextCallbackData* data);
    int complete(ImGuiInputTextCallbackData& data) const;

    std::optional<FilePurpose> purpose_;                   // of the open dialog; empty: it is closed
    SaveKind kind_ = SaveKind::picture;                    // to save
    std::array<char, 4096> text_{};                        // the typed path
    bool wants_focus_ = false, wants_cursor_last_ = false; // requests for the text field in the next frame
    std::filesystem::path folder_;                         // the listed folder
    std::vector<FileEntry> entries_;                       // its entries
    std::string filter_;                                   // typed beginning of the listed names
    std::string error_;                                    // reason why the folder cannot be read
    std::filesystem::path chosen_;                         // the chosen file; empty: none
};

} // namespace tessera
