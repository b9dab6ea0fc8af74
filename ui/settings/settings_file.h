#pragma once

#include "render/session/session.h"
#include "render/settings/setting.h"
#include "ui/gl/controls.h"
#include "ui/gl/tone.h"
#include "ui/state/viewer_state.h"
#include "ui/state/words.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tessera {

class JsonFields;

/// What a user has set, as JSON: the panes with all their settings, camera, size, tone, pace, ranges, where the
/// pictures lie, what the path inspector and the slow motion show (add_inspection), and where the view in
/// space looks.
std::string settings_json(const ViewerState& state);

/// Sets what such a text holds; what it does not mention stays. A camera file (camera_json in
/// render/scene/camera.h) sets the camera alone. Throws LoadError with `name`, line and column, and has then
/// changed nothing.
void apply_settings_json(ViewerState& state, const std::string& json, const std::string& name);

/// Sets what a file holds, as apply_settings_json does. Throws also where it cannot be read.
void apply_settings_file(ViewerState& state, const std::filesystem::path& file);

/// The buffer of that id. Throws std::invalid_argument where there is none.
Buffer buffer_named(const std::string& id);

/// Sets a part of the state by its name from a word or number: a render setting of the active pane (of all, when
/// linked), its method, buffer or comparison, or something of the viewer. Throws std::invalid_argument that says
/// what there is or may be.
void set_by_name(ViewerState& state, const std::string& name, const std::string& value);

/// The path inspector and the slow motion as fields of a settings file, "inspector" and "slow_motion": whether
/// they are on, how they show things, and the pixel that is looked at, of a given pass or the newest there is. The
/// shift chosen from its table is of the render that was, and not in it; nor is a pixel of an earlier picture.
void add_inspection(nlohmann::ordered_json& json, const ViewerState& state);

/// Sets what such fields say, once the panes are those of the file; what they do not mention stays.
void read_inspection(const JsonFields& fields, ViewerState& state);

// Rows of the table of settings (render/settings/settings_table.h) for what is the viewer's own. What they are
// bound to must outlive them.

/// How the panes share the cores, and when they rest.
std::vector<Setting> settings_of(Pace& pace);

/// Tone curve, exposure and that of differences, in this order.
std::vector<Setting> settings_of(Tone& tone);

/// How the pane shows another one's picture.
Setting comparison_setting(Comparison::Kind& kind);

/// What the number of rendered pixels follows: the pane, the scene, or a size of its own.
Setting size_base_setting(SizeChoice::Base& base);
/// The size where it is one of its own; the panes hold no more pixels than its limits allow.
Setting custom_size_setting(glm::ivec2& size);

/// What linked panes have in common: all of the render but its method, and the reconstruction.
std::vector<Setting> shared_settings_of(PaneSettings& pane);

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
