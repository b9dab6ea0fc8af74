#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

namespace tessera {

/// `-D name=value` of the command line: replaces the <default> of that name.
using SceneVariables = std::map<std::string, std::string>;

/// Where a scene is from.
struct SceneSource {
    std::filesystem::path file;        ///< empty: the Cornell box inside the program
    SceneVariables variables;          ///< -D name=value
    std::filesystem::path camera = {}; ///< a file with the camera to take; empty: the scene's own
    bool strict = false;               ///< a file that is not there ends the load
};

/// The name to show for a scene: the path of its file, or that it is the built-in one.
std::string to_string(const SceneSource& source);

/// A name for files that are made of it: the folder's for "kitchen/scene.xml" and "kitchen/scene_v3.xml", else the
/// file's; with the values of its variables, if it was given any: "glossy-0.01". All but letters, digits, "." and
/// "-" is "_" in these.
std::string scene_name(const SceneSource& source);

/// How far the loading of a scene is, and whether it is still wanted. The threads that load write it, any may read
/// it.
class LoadProgress {
public:
    enum class Stage { xml, files, bvh };
    struct State {
        Stage stage = Stage::xml;
        int done = 0;
        int total = 0; ///< of the stage's steps; 0: it has none that can be counted
        bool operator==(const State&) const = default;
    };

    void begin(Stage stage, int total = 0);
    void step(); ///< one of the stage's steps is done
    State state() const;

    /// Asks the loader to end with an exception, at the next file or within the BVH.
    void give_up() { given_up_ = true; }
    bool given_up() const { return given_up_; }
    /// Throws std::runtime_error if the scene is wanted no more.
    void check_wanted() const;

private:
    mutable std::mutex mutex_;
    State state_;
    std::atomic<bool> given_up_ = false;
};

/// "scene file", "meshes and textures, 3 of 80", "BVH, 40 %".
std::string to_string(const LoadProgress::State& state);

} // namespace tessera
