#pragma once

#include "ui/state/layout.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

/// What the viewer remembers from one run to the next.
struct Preferences : LastingLayout {
    int panes = 0;                          ///< how many; 0: not known
    std::vector<std::string> recent_scenes; ///< files, in full, the newest first

    bool operator==(const Preferences&) const = default;

    static constexpr std::size_t most_recent = 8;
    void add_recent(const std::filesystem::path& scene); ///< in full
};

/// Where they are kept: $XDG_CONFIG_HOME/tessera/viewer.json, or below ~/.config. Empty: there is no such place.
std::filesystem::path preferences_file();

/// A file that is not there leaves everything as it is by itself; so does one that is broken or cannot be read,
/// and `note` then says so.
Preferences read_preferences(const std::filesystem::path& file, std::string& note);

/// Makes the folder. Writes to a temporary name and renames it. Throws std::exception that names the file.
void write_preferences(const std::filesystem::path& file, const Preferences& preferences);

/// Preferences and the file that they are kept in, which other viewers write, too, and users.
struct KeptPreferences {
    Preferences preferences;
    std::string note;            ///< what the user is to be told of the file; empty: nothing
    bool can_be_replaced = true; ///< the file: nothing is lost with it
};

/// Reads them, as read_preferences does, and makes the file one that can be replaced: a broken one gets the first
/// free name of "viewer.json.broken", "viewer.json.broken-2", ... One that cannot be read cannot be replaced.
KeptPreferences claim_preferences(const std::filesystem::path& file);

/// Claims the file, and replaces it if it can be, and can be written: what is remembered is no reason to fail.
/// @param opened  scenes, the last one last: put before those that the file has, which are kept
/// @return        the preferences with these scenes
KeptPreferences store_preferences(const std::filesystem::path& file, Preferences preferences,
                                  const std::vector<std::string>& opened);

} // namespace tessera
