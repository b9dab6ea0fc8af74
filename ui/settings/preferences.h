#pragma once

#include "ui/state/layout.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

/// Settings that the viewer stores for the next run.
struct Preferences : StoredLayout {
    int panes = 0;                          ///< number of panes; 0: unknown
    std::vector<std::string> recent_scenes; ///< absolute file names, the newest first

    bool operator==(const Preferences&) const = default;

    static constexpr std::size_t most_recent = 8;
    void add_recent(const std::filesystem::path& scene); ///< takes an absolute path
};

/// Returns $XDG_CONFIG_HOME/tessera/viewer.json or ~/.config/tessera/viewer.json. Empty: neither variable is set.
std::filesystem::path preferences_file();

/// Returns the preferences in the file, or the defaults if there is no file. For a broken or unreadable file,
/// returns the defaults and puts the reason into `note`.
Preferences read_preferences(const std::filesystem::path& file, std::string& note);

/// Writes the preferences atomically, to a temporary name first, and creates the folder. Throws std::exception
/// that names the file.
void write_preferences(const std::filesystem::path& file, const Preferences& preferences);

/// Preferences and the state of their file, which other viewers and users also write.
struct LoadedPreferences {
    Preferences preferences;
    std::string note;            ///< message to the user about the file; empty: none
    bool can_be_replaced = true; ///< whether the file can be overwritten without loss
};

/// Reads the preferences as read_preferences does, and renames a broken file to the first free name of
/// "viewer.json.broken", "viewer.json.broken-2", ..., so that it can be replaced. An unreadable file cannot be
/// replaced.
LoadedPreferences claim_preferences(const std::filesystem::path& file);

/// Claims the file, and replaces it if possible. A failure to write is ignored.
/// @param opened  scenes of this run, the newest last; they are added to the recent scenes in the file
/// @return        the preferences with these scenes
LoadedPreferences store_preferences(const std::filesystem::path& file, Preferences preferences,
                                    const std::vector<std::string>& opened);

} // namespace tessera
