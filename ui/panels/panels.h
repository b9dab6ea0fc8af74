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

/// The windows around the pictures. Each is drawn into the current Dear ImGui frame and changes the state only.

/// The menus of all actions, across the top; returns its height, screen units.
float draw_menu_bar(Controls& controls, ViewerState& state);

/// Draws the settings of the active pane (of all, when linked), of the picture and its size.
void draw_settings_panel(const ScreenRect& where, Controls& controls, ViewerState& state);

/// The edge between `pictures` and the panels to their right, which the mouse can drag.
void draw_panel_edge(const ScreenRect& pictures, Controls& controls, ViewerState& state);

/// What the render on show in the active pane has counted.
void draw_statistics_panel(const ScreenRect& where, Controls& controls, const ViewerState& state);

/// Why there is no scene, and what can be done about it; over the pictures.
void draw_no_scene(const ScreenRect& where, Controls& controls, ViewerState& state);

/// What a reference is to be made of, or how far its making is; over everything.
void draw_reference_dialog(glm::vec2 screen, Controls& controls, ViewerState& state);

/// Which sample the path inspector is to open; over everything.
void draw_sample_dialog(glm::vec2 screen, Controls& controls, ViewerState& state);

/// The messages, newest last; over the pictures, whose size must not depend on them.
void draw_message_panel(const ScreenRect& where, Controls& controls, ViewerState& state);

/// All actions by menu, and all gestures, to be found by words; over everything.
class HelpPage {
public:
    void draw(glm::vec2 screen, Controls& controls, ViewerState& state);

private:
    std::array<char, 128> text_{};
};

/// What is being loaded and how far that is, over the pictures, and a button to give it up.
void draw_loading(const ScreenRect& where, Controls& controls, ViewerState& state, const std::string& what,
                  const LoadProgress::State& progress, double seconds);

/// What was said last, over the lower edge of the pictures, until its time is over.
void draw_toast(const ScreenRect& where, Controls& controls, ViewerState& state);

/// The jobs of a folder that is followed, how many are done, and curves of what is; over the pictures.
class JobsPanel {
public:
    /// Draws it while state.layout.show_jobs.
    void draw(const ScreenRect& where, Controls& controls, ViewerState& state, const FolderFollower::View& view);

private:
    void draw_charts(Controls& controls, const FollowedFolder& seen, glm::vec2 room);
    void draw_list(Controls& controls, const FollowedFolder& seen);

    std::filesystem::path folder_; // that is on show
    int chart_ = 0;                // of its charts
    bool only_claimed_ = false;
};

/// Scenes with pictures, to be clicked, and where files can be dropped; over the pictures.
class Gallery {
public:
    struct Sources {
        const GalleryMaker& maker;                ///< may be empty: there are recent scenes alone
        const std::filesystem::path& preferences; ///< beside which thumbnails lie; empty: there are none
        int thumbnails_stored;                    ///< so far: each time they are read anew
        const std::function<void()>& wake;        ///< called from another thread once pictures are there
    };
    /// Draws it while state.layout.show_gallery.
    void draw(const ScreenRect& where, Controls& controls, ViewerState& state, const Sources& sources);

private:
    /// Scenes with their pictures here and on the graphics side.
    struct Shelf {
        std::vector<GalleryEntry> entries;
        std::vector<GlTexture> textures; // of the entries
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

/// The list of all commands, to be found by words; over everything.
class CommandPalette {
public:
    /// Draws it while state.layout.show_palette. What is chosen is done.
    void draw(glm::vec2 screen, Controls& controls, ViewerState& state);

private:
    void draw_list(Controls& controls, ViewerState& state);

    std::array<char, 128> text_{};
    int chosen_ = 0, seen_ = 0; // of what was found; where the list was scrolled to
    bool was_shown_ = false;
};

/// One number of a render's counters, ready to be shown.
struct Statistic {
    std::string id; ///< "rays.camera"
    std::string label;
    std::string value;           ///< may be empty where the share says all
    std::optional<double> share; ///< of the group's whole, in [0, 1]
    std::string help;
};

struct StatisticGroup {
    std::string title;
    std::vector<Statistic> statistics;
};

/// What the snapshot's counters say, in groups. What its method does not do, or what did not happen, has no group.
std::vector<StatisticGroup> statistics(const Snapshot& snapshot);

/// "9999", "12.3 k", "4.56 M", "7.89 G".
std::string count_text(std::uint64_t count);

/// The endings of what is written of that kind: ".png", or ".csv", ".svg", ".png". The first is that of the file
/// that is chosen; the others follow from it.
std::span<const char* const> saved_endings(SaveKind kind);

/// Chooses a file: a path to be typed, which Tab completes, and the folder that it leads to, to be
/// clicked.
class FileDialog {
public:
    /// Draws it while state.layout.choosing says what for. What is chosen becomes a wish of the state.
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

    std::optional<FilePurpose> purpose_; // of what is on show
    SaveKind kind_ = SaveKind::picture;  // that is to be saved
    std::array<char, 4096> text_{};
    bool wants_focus_ = false, wants_cursor_last_ = false; // the text, which was put there
    std::filesystem::path folder_;                         // that is listed
    std::vector<FileEntry> entries_;                       // of the folder
    std::string filter_;                                   // the beginning that was typed, not clicked
    std::string error_;                                    // why there is nothing to choose
    std::filesystem::path chosen_;                         // empty: nothing yet
};

} // namespace tessera
