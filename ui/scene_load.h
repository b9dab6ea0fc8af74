#pragma once

#include "render/scene/scene.h"

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tessera {

/// Makes a scene, on a thread other than the UI's. Appends to `notes` what the user should know of it. Throws
/// std::exception, whose what() is shown.
using SceneLoader = std::function<std::shared_ptr<const Scene>(std::vector<std::string>& notes)>;

/// How a load ended.
struct SceneLoadResult {
    std::shared_ptr<const Scene> scene; ///< null: it failed
    std::string name;
    std::vector<std::string> notes;
    std::string error;
    double seconds = 0; ///< wall time
};

/// One scene on its way, loaded in the background. Its end waits for the loader.
class SceneLoad {
public:
    /// Not while one is running. `on_done` is called from the loading thread, once poll() has a result.
    void start(std::string name, SceneLoader loader, std::function<void()> on_done);

    bool running() const { return result_.valid(); }
    const std::string& name() const { return name_; }

    /// The result, once; never waits.
    std::optional<SceneLoadResult> poll();

private:
    std::string name_;
    std::future<SceneLoadResult> result_;
    std::jthread thread_;
};

} // namespace tessera
