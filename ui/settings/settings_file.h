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

/// Returns the user's settings as JSON: the panes, camera, bookmarks, size, tone, pace, ranges, the view of the
/// pictures, path inspector and slow motion (add_inspection), and the direction of the view in space.
std::string settings_json(const ViewerState& state);

/// Applies the settings in the text; missing fields change nothing. A camera file (camera_json in
/// render/scene/camera.h) sets the camera only. Throws LoadError with `name`, line and column, and then changes
/// nothing.
void apply_settings_json(ViewerState& state, const std::string& json, const std::string& name);

/// Applies a settings file, as apply_settings_json does. Throws std::exception also if it cannot be read.
void apply_settings_file(ViewerState& state, const std::filesystem::path& file);

/// Returns the buffer with this id. Throws std::invalid_argument if there is none.
Buffer buffer_named(const std::string& id);

/// Sets one setting by name: a render setting of the active pane (of all panes if they are linked), its method,
/// buffer or comparison, or a setting of the viewer. Throws std::invalid_argument that lists the valid names or
/// values.
void set_by_name(ViewerState& state, const std::string& name, const std::string& value);

/// Adds the fields "inspector" and "slow_motion" of a settings file: their switches, display settings, and
/// sample. The chosen shift is omitted, because it belongs to one render. A sample of an older render is omitted
/// too.
void add_inspection(nlohmann::ordered_json& json, const ViewerState& state);

/// Applies these fields; missing ones change nothing. The panes of the file must be set already.
void read_inspection(const JsonFields& fields, ViewerState& state);

// Settings of the viewer itself, like those in render/settings/settings_table.h. The referenced values must
// outlive them.

/// Returns the settings of the pace: the equal measure, and the limits of samples and time.
std::vector<Setting> settings_of(Pace& pace);

/// Returns tone curve, exposure and difference exposure, in this order.
std::vector<Setting> settings_of(Tone& tone);

/// Returns the kind of a pane's comparison.
Setting comparison_setting(Comparison::Kind& kind);

/// Returns the base of the rendered size: the pane, the scene, or a custom size.
Setting size_base_setting(SizeChoice::Base& base);
/// Returns the custom size, with an edge of at most most_render_pixels_an_edge.
Setting custom_size_setting(glm::ivec2& size);

/// Returns the settings that linked panes share: reconstruction, seed, and render settings except the method.
std::vector<Setting> shared_settings_of(PaneSettings& pane);

/// Logs one line for each change between frames, such as "pane 0 method gpr". For scripts and tests that drive
/// the real window.
class ChangeLog {
public:
    using Sink = std::function<void(const std::string&)>;

    void write_state(const ViewerState& state, const Sink& sink);
    /// Logs "control ID x0 y0 x1 y1", in screen units, for each control that is new or has moved.
    void write_controls(const Controls& controls, const Sink& sink);

private:
    std::map<std::string, std::string> values_;
    std::map<std::string, ControlRect, std::less<>> rects_;
};

} // namespace tessera
