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

/// What the user should know of a scene that was loaded.
struct SceneNote {
    std::string text;
    bool is_error = false; ///< something that the scene needs is missing
};
using SceneNotes = std::vector<SceneNote>;

/// Makes a scene, on a thread other than the UI's. Appends to `notes` what the user should know of it, tells
/// `progress` how far it is, and ends with an exception once that says to give up. Throws std::exception, whose
/// what() is shown.
using SceneLoader = std::function<std::shared_ptr<const Scene>(SceneNotes& notes, LoadProgress& progress)>;

/// A scene to load, and to load again.
struct SceneOrigin {
    std::string name;   ///< to show
    SceneSource source; ///< without a camera: that is the viewer's
    SceneLoader loader;
};

/// Whether both are one scene, whatever way its file is named.
bool is_same_scene(const SceneOrigin& a, const SceneOrigin& b);

/// Makes the origin of a scene file.
using SceneOpener = std::function<SceneOrigin(const std::filesystem::path&)>;

/// A scene to begin with.
struct GalleryEntry {
    std::string title;
    std::string help;           ///< what is special about it
    std::string verdict;        ///< in short: how G-PR does there; empty: it is not known
    bool is_worse = false;      ///< the verdict is not good
    std::filesystem::path file; ///< empty: the one within the program
    RgbImage picture{};         ///< small, in sRGB; empty: none
};

struct GalleryContents {
    std::vector<GalleryEntry> entries;
    std::string problem; ///< why some are missing; empty: none is
};

/// Finds them, on a thread other than the UI's.
using GalleryMaker = std::function<GalleryContents()>;

/// How a load ended.
struct SceneLoadResult {
    std::shared_ptr<const Scene> scene; ///< null: it failed
    SceneOrigin origin;
    SceneNotes notes;
    std::string error;
};

/// One scene on its way, loaded in the background. Its end gives the scene up and waits for the loader.
class SceneLoad {
public:
    /// A load under way is given up, as by cancel(). `on_done` is called from the loading thread once take() has a
    /// result.
    void start(SceneOrigin origin, std::function<void()> on_done);

    /// Gives up what is under way: nothing more is heard of it.
    void cancel() { job_.cancel(); }

    bool running() const { return job_.running(); }
    const SceneOrigin& origin() const { return job_.asked()->origin; } ///< only while running, as the next two
    LoadProgress::State progress() const { return job_.asked()->progress->state(); }
    double seconds() const; ///< since its start

    /// The result, once; never waits.
    std::optional<SceneLoadResult> take();

private:
    using Clock = std::chrono::steady_clock;
    struct Load {
        SceneOrigin origin;
        std::shared_ptr<LoadProgress> progress; // told by the work, which may outlast this
        Clock::time_point start;
    };

    BackgroundJob<Load, SceneLoadResult> job_;
};

} // namespace tessera
