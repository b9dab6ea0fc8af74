#pragma once

#include "recon/image.h"
#include "render/load/scene_source.h"
#include "ui/jobs/background_job.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

class Scene;

/// A note to the user on a loaded scene.
struct SceneNote {
    std::string text;
    bool is_error = false; ///< something that the scene needs is missing
};
using SceneNotes = std::vector<SceneNote>;

/// Loads a scene, on a thread other than the UI's. Appends notes to the user, reports to `progress`, and throws
/// once `progress` is cancelled. Throws std::exception, whose what() is shown.
using SceneLoader = std::function<std::shared_ptr<const Scene>(SceneNotes& notes, LoadProgress& progress)>;

/// The origin of a scene, from which it can be loaded repeatedly.
struct SceneOrigin {
    std::string name;   ///< display name
    SceneSource source; ///< its `camera` is empty, because the viewer sets the camera
    SceneLoader loader;
};

/// Whether both are the same scene. Different paths of one file count as the same.
bool is_same_scene(const SceneOrigin& a, const SceneOrigin& b);

/// Makes the origin of a scene file.
using SceneOpener = std::function<SceneOrigin(const std::filesystem::path&)>;

/// A table of errors in a tooltip. Each row has one cell per column.
struct ErrorTable {
    struct Cell {
        std::string text;
        bool is_worse = false; ///< drawn in the warning colour
    };
    std::vector<std::string> columns;
    std::vector<std::vector<Cell>> rows; ///< empty: no table
};

/// A scene of the gallery.
struct GalleryEntry {
    std::string title;
    std::string help;           ///< tooltip: the special feature of the scene
    std::string verdict;        ///< short judgement of G-PR on this scene; empty: unknown
    bool is_worse = false;      ///< whether the verdict is negative
    std::filesystem::path file; ///< empty: the scene that is built into the program
    RgbImage picture{};         ///< thumbnail, sRGB; empty: none
    ErrorTable errors{};        ///< below the tooltip's text
};

struct GalleryContents {
    std::vector<GalleryEntry> entries;
    std::string problem; ///< reason for missing entries; empty: none is missing
};

/// Collects the gallery's scenes, on a thread other than the UI's.
using GalleryMaker = std::function<GalleryContents()>;

/// Result of a load.
struct SceneLoadResult {
    std::shared_ptr<const Scene> scene; ///< null: the load failed
    SceneOrigin origin;
    SceneNotes notes;
    std::string error; ///< reason of the failure
};

/// Loads one scene at a time in the background. The destructor cancels the load and waits for the loader.
class SceneLoad {
public:
    /// Starts a load, and cancels the one under way. `on_done` is called from the loading thread once take() has
    /// a result.
    void start(SceneOrigin origin, std::function<void()> on_done);

    /// Cancels the load under way. take() returns no result of it.
    void cancel() { job_.cancel(); }

    bool running() const { return job_.running(); }
    const SceneOrigin& origin() const {
        return job_.asked()->origin;
    } ///< only while running, as progress() and seconds()
    LoadProgress::State progress() const { return job_.asked()->progress->state(); }
    double seconds() const; ///< time since the start

    /// Returns the result once, and empty before and after. Never waits.
    std::optional<SceneLoadResult> take();

private:
    using Clock = std::chrono::steady_clock;
    struct Load {
        SceneOrigin origin;
        std::shared_ptr<LoadProgress> progress; // shared with the loader, which may run on after cancel()
        Clock::time_point start;
    };

    BackgroundJob<Load, SceneLoadResult> job_;
};

} // namespace tessera
