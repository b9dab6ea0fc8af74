#pragma once

#include "ui/theme.h"
#include "ui/window_place.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

/// What the viewer remembers from one run to the next.
struct Preferences {
    WindowPlace window;
    int panes = 0; ///< how many; 0: not known
    Theme theme = Theme::dark;
    float text_factor = 1;  ///< as of ViewerState
    float panel_width = 20; ///< likewise
    bool show_panel = true;
    bool show_statistics = false;
    bool show_charts = false;
    std::vector<std::string> recent_scenes; ///< files, in full, the newest first

    bool operator==(const Preferences&) const = default;

    static constexpr std::size_t most_recent = 8;
    void add_recent(const std::filesystem::path& scene); ///< in full
};

/// Where they are kept: $XDG_CONFIG_HOME/tessera/viewer.json, or below ~/.config. Empty: there is no such place.
std::filesystem::path preferences_file();

/// A file that is not there leaves everything as it is by itself; so does one that is broken, and `note` then says
/// so.
Preferences read_preferences(const std::filesystem::path& file, std::string& note);

/// Makes the folder. Writes to a temporary name and renames it. Throws std::exception that names the file.
void write_preferences(const std::filesystem::path& file, const Preferences& preferences);

} // namespace tessera
