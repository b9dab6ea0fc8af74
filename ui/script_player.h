#pragma once

#include "ui/frame_times.h"
#include "ui/script.h"
#include "ui/viewer.h"

#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

/// Plays a script: sends its input where a window's would arrive, to the keyboard's bookkeeping and to Dear ImGui,
/// a frame at a time.
class ScriptPlayer {
public:
    /// What a script does beside the viewer.
    struct Outside {
        std::function<void(const std::string&)> print;
        /// Writes a picture of the frame that is drawn. Throws std::exception.
        std::function<void(const std::filesystem::path&)> screenshot;
    };

    ScriptPlayer(std::vector<ScriptStep> steps, std::string file, Viewer& viewer, Outside outside);

    /// Before a frame is begun: sends input. Throws ScriptError where a step cannot be done.
    /// @param last_frame_seconds  how long the last one took
    void before_frame(double last_frame_seconds);
    /// When it is drawn.
    void after_frame();

    bool done() const { return next_ == steps_.size() && actions_.empty(); }
    /// Whether the next frame is due at once; else one after something has changed will do.
    bool wants_frame() const;

private:
    /// Does its part before a frame; true: that was the last.
    using Action = std::function<bool()>;

    void start(const ScriptStep& step);
    void start_wait(const ScriptStep& step);
    void start_inspect(const ScriptStep& step);
    void start_pointer(const ScriptStep& step);
    void start_key(const ScriptStep& step);
    void start_frames(const ScriptStep& step);

    void add(const std::function<void()>& once);
    void add_wait(const std::function<bool()>& holds);
    void add_click(const std::function<glm::vec2()>& point);
    void add_drag(glm::vec2 from, glm::vec2 to, int frames);
    std::vector<glm::vec2> points(const ScriptStep& step, std::size_t count) const;
    glm::vec2 point_on(const std::string& control) const;
    bool have_samples(int spp) const;
    double number(const std::string& text) const;
    int whole(const std::string& text) const;
    void send_input() const;
    [[noreturn]] void fail(const std::string& what) const;

    std::vector<ScriptStep> steps_;
    std::string file_;
    Viewer& viewer_;
    Outside outside_;
    std::size_t next_ = 0;
    int line_ = 0; // of the step under way
    std::deque<Action> actions_;
    bool waiting_ = false; // for something that will wake the surface by itself
    std::optional<std::filesystem::path> picture_;
    double last_frame_ = 0;

    // Held, and sent again at every frame: a window's own mouse would take their place.
    std::optional<glm::vec2> mouse_;
    bool button_ = false;
    bool ctrl_ = false, shift_ = false;
};

} // namespace tessera
