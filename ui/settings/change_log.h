#pragma once

#include "ui/gl/controls.h"
#include "ui/state/viewer_state.h"

#include <functional>
#include <map>
#include <string>

namespace tessera {

/// Tells what changed from frame to frame, a line each: "pane 0 method gpr". For scripts and tests that drive the
/// real window.
class ChangeLog {
public:
    using Sink = std::function<void(const std::string&)>;

    void write_state(const ViewerState& state, const Sink& sink);
    /// "control ID x0 y0 x1 y1", in screen units, for each control that is new or has moved.
    void write_controls(const Controls& controls, const Sink& sink);

private:
    std::map<std::string, std::string> values_;
    std::map<std::string, ControlRect, std::less<>> rects_;
};

} // namespace tessera
