#pragma once

#include "render/scene/camera.h"

#include <atomic>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace tessera {

/// Variables by name, from `-D name=value` on the command line. Each overrides the <default> of that name.
using SceneVariables = std::map<std::string, std::string>;

/// Origin of a scene.
struct SceneSource {
    std::filesystem::path file;        ///< empty: the built-in Cornell box
    SceneVariables variables;          ///< -D name=value
    std::filesystem::path camera = {}; ///< file whose camera replaces the scene's; empty: none
    bool strict = false;               ///< whether a missing or damaged mesh, texture or transform ends loading
    std::string sensor = {};           ///< number, from 0, or id of the sensor; empty: the first
    /// Replaces the sensor's crop window; its film of size 0 stands for the sensor's film. Without a window: the
    /// whole film is rendered. Empty: the sensor's crop window is used.
    std::optional<CropWindow> crop = {};
};

/// Returns the path of a scene's file, or words for the built-in scene.
std::string to_string(const SceneSource& source);

/// Returns a name for output files: the folder's for "kitchen/scene.xml" and "kitchen/scene_v3.xml", otherwise
/// the file's stem. The values of variables are appended ("glossy-0.01"); in them, all characters but letters,
/// digits, "." and "-" become "_".
std::string scene_name(const SceneSource& source);

/// Progress of loading a scene, and its cancellation. Thread-safe.
class LoadProgress {
public:
    enum class Stage { xml, files, bvh };
    struct State {
        Stage stage = Stage::xml;
        int done = 0;
        int total = 0; ///< steps of the stage; 0: the stage has no countable steps
        bool operator==(const State&) const = default;
    };

    void begin(Stage stage, int total = 0);
    void step(); ///< counts one finished step of the stage
    State state() const;

    /// Makes the loader end with an exception at the next file or within the BVH.
    void give_up() { given_up_ = true; }
    bool given_up() const { return given_up_; }
    /// Throws std::runtime_error after give_up().
    void throw_if_cancelled() const;

private:
    mutable std::mutex mutex_;
    State state_;
    std::atomic<bool> given_up_ = false;
};

/// Describes a state: "scene file", "meshes and textures, 3 of 80", "BVH, 40 %".
std::string to_string(const LoadProgress::State& state);

} // namespace tessera
