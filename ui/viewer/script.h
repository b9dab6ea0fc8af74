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

#include <glm/vec2.hpp>

namespace tessera {

/// One line of a script.
struct ScriptStep {
    std::string word; ///< name of the step, such as "wait"
    std::vector<std::string> arguments;
    int line = 0; ///< line number in the file, from 1
};

/// An error in a line of a script: "steps.txt:3: unknown step jump".
class ScriptError : public std::runtime_error {
public:
    ScriptError(const std::string& file, int line, const std::string& what)
        : std::runtime_error(file + ":" + std::to_string(line) + ": " + what) {}
};

/// Parses a script with one step per line. Spaces separate words, "double quotes" group them, and # begins a
/// comment. Throws ScriptError for an unknown step or a wrong number of arguments. `file` names the script in
/// messages.
std::vector<ScriptStep> parse_script(std::istream& text, const std::string& file);

/// Reads and parses a script file; "-" is standard input. Throws ScriptError also if the file cannot be read.
std::vector<ScriptStep> read_script(const std::filesystem::path& file);

/// Returns one line of help for each step, for the command line's --help.
std::string script_help();

/// Frame times, each from the first reading of input to the buffer swap.
struct FrameTimes {
    std::string label;
    std::vector<double> seconds; ///< time of each frame
    double period = 0;           ///< seconds from the first frame to the last, idle time included
    std::vector<double> behind;  ///< seconds from each camera change to its first picture; empty: no change

    /// Returns "frames dragging: 120, median 12.3 ms, 99th percentile 20.1 ms", and if the camera moved "; 40
    /// pictures, 11.2 a second, behind the camera by a median of 70.1 ms".
    std::string text() const;
};

/// Returns the smallest value that at least `fraction` of the values do not exceed. Returns 0 without values.
double quantile(std::vector<double> values, double fraction);

/// Plays a script frame by frame. Sends its input to the viewer's keyboard and to Dear ImGui, as a window does.
class ScriptPlayer {
public:
    /// Effects of a script outside the viewer.
    struct Outside {
        std::function<void(const std::string&)> print;
        /// Saves a picture of the current frame. Throws std::exception.
        std::function<void(const std::filesystem::path&)> screenshot;
    };

    ScriptPlayer(std::vector<ScriptStep> steps, std::string file, Viewer& viewer, Outside outside);

    /// Sends the input of the next frame. To be called before each frame. Throws ScriptError if a step fails.
    /// @param last_frame_seconds  time that the previous frame took
    void before_frame(double last_frame_seconds);
    /// Takes a screenshot if a step asks for one. To be called after each frame.
    void after_frame();

    bool done() const { return next_ == steps_.size() && actions_.empty(); }
    /// Whether the next frame is due at once. Otherwise the next frame can wait for a change.
    bool wants_frame() const;

private:
    /// Work before one frame. Returns whether the action is complete.
    using Action = std::function<bool()>;

    void start(const ScriptStep& step);
    void start_wait(const ScriptStep& step);
    void start_inspect(const ScriptStep& step);
    void start_pointer(const ScriptStep& step);
    void start_key(const ScriptStep& step);
    void start_frames(const ScriptStep& step);

    void add(const std::function<void()>& once);
    void add_wait(const std::function<bool()>& condition);
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
    int line_ = 0; // line number of the current step
    std::deque<Action> actions_;
    bool waiting_ = false;                            // for an event that wakes the surface
    std::optional<std::filesystem::path> screenshot_; // to save after this frame
    double last_frame_ = 0;

    // Mouse and modifiers, sent at every frame because the window's own mouse would replace them.
    std::optional<glm::vec2> mouse_;
    bool button_ = false;
    bool ctrl_ = false, shift_ = false;
};

} // namespace tessera
