#pragma once

#include "ui/viewer/viewer.h"

#include <deque>
#include <filesystem>
#include <functional>
#include <istream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tessera {

/// One line of a script: a word that says what to do, and what it needs.
struct ScriptStep {
    std::string word;
    std::vector<std::string> arguments;
    int line = 0; ///< in the file, from 1
};

/// Something is wrong with a line of a script: "steps.txt:3: no step is called jump".
class ScriptError : public std::runtime_error {
public:
    ScriptError(const std::string& file, int line, const std::string& what)
        : std::runtime_error(file + ":" + std::to_string(line) + ": " + what) {}
};

/// A line a step; words are divided by spaces, "double quotes" keep them together, and # begins a comment. Throws
/// ScriptError where a step is unknown or has the wrong number of arguments. `file` is for messages.
std::vector<ScriptStep> parse_script(std::istream& text, const std::string& file);

/// Throws ScriptError also where the file cannot be read.
std::vector<ScriptStep> read_script(const std::filesystem::path& file);

/// The steps that there are, a line each, for the help of the command line.
std::string script_help();

/// How long frames took, from the first reading of input to the picture handed over.
struct FrameTimes {
    std::string label;
    std::vector<double> seconds; ///< a frame
    double period = 0;           ///< seconds of all of them, with what lay between
    std::vector<double> behind;  ///< seconds from a camera to the first picture of it; empty: it did not move

    /// "frames dragging: 120, median 12.3 ms, 99th percentile 20.1 ms", and where the camera moved "; 40 pictures,
    /// 11.2 a second, behind the camera by a median of 70.1 ms".
    std::string text() const;
};

/// The value that a share of the values does not exceed. 0 without any.
double quantile(std::vector<double> values, double share);

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

    /// To be called before a frame is begun: sends input. Throws ScriptError where a step cannot be done.
    /// @param last_frame_seconds  how long the last one took
    void before_frame(double last_frame_seconds);
    /// To be called when the frame is drawn.
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
