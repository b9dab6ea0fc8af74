#pragma once

#include "render/load/scene_source.h"
#include "ui/jobs/save_queue.h"
#include "ui/state/viewer_state.h"
#include "ui/viewer/picture_area.h"
#include "ui/viewer/viewer_options.h"

#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include <glm/vec2.hpp>

namespace tessera {

/// Fulfils the state's wishes to save files, in the background and in their order. A message reports each
/// outcome: "Saved " with the file name, or the error.
class Saver {
public:
    /// @param write_exr  may be empty: a wish for an EXR file becomes an error message
    /// @param wake       called from another thread when a file is written or has failed
    Saver(PictureWriter write_exr, std::function<void()> wake)
        : write_exr_(std::move(write_exr)), wake_(std::move(wake)) {}

    void save(SaveQueue::Work write) { queue_.add(std::move(write), wake_); }
    bool running() const { return queue_.running(); }

    /// Starts to save camera, settings, EXR file and picture as wished, and reports the oldest outcome.
    /// @param source  source of the scene on show
    void fulfil(ViewerState& state, const PictureArea& pictures, const SceneSource& source);
    /// Starts to save the charts as wished, once the histograms are complete.
    void fulfil_charts(ViewerState& state);

    /// Writes all waiting files, waits for them, and prints errors to stderr, because messages are not shown at
    /// exit.
    void finish();

private:
    void save_camera(const ViewerState& state, const SceneSource& source, const std::string& file);
    void save_settings(const ViewerState& state, const std::string& file);
    void save_exr(ViewerState& state, const SceneSource& source, const std::string& file);
    void save_picture(ViewerState& state, const PictureArea& pictures, const std::string& file);
    static void report(const SaveQueue::Outcome& outcome, ViewerState& state);

    SaveQueue queue_;
    PictureWriter write_exr_;
    std::function<void()> wake_;
};

/// Saves the picture of the window some frames after the wish, so that the menu it came from is closed.
class PictureSaver {
public:
    /// To be called after each frame, while its framebuffer is bound for reading.
    /// @param pixels  size of the framebuffer
    /// @return        whether another frame is due
    bool after_frame(ViewerState& state, Saver& saver, glm::ivec2 pixels);

private:
    int age_ = 0; // frames since the wish
};

} // namespace tessera
