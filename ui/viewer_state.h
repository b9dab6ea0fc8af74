#pragma once

#include "render/scene/scene.h"
#include "ui/buffer.h"
#include "ui/camera_control.h"
#include "ui/image_view.h"
#include "ui/render_size.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tessera {

/// What a user sets for one pane.
struct PaneSettings {
    RenderSettings render;
    ReconstructionSettings reconstruction;
    Buffer buffer = Buffer::reconstruction;

    bool operator==(const PaneSettings&) const = default;
};

struct PaneState {
    PaneSettings settings;
    std::shared_ptr<const Snapshot> snapshot; ///< the newest; null before the first
    std::uint64_t generation = 0;             ///< of the request that is out
    glm::ivec2 canvas_size{0};                ///< pixels of the place for its picture, as last drawn
};

struct Message {
    enum class Kind { note, error };
    Kind kind;
    std::string text;
};

/// Everything that panels, actions and the mouse may change. They do no more than that: the viewer compares the
/// state with what it last asked of the session, and sends what differs.
struct ViewerState {
    std::shared_ptr<const Scene> scene; ///< null while the first is loading
    std::string scene_name;

    std::vector<PaneState> panes;
    int active_pane = 0;
    bool linked = true; ///< all panes share their settings, but for method and buffer

    CameraControl camera;
    ImageView view;
    SizeChoice size;
    float exposure = 0; ///< stops
    int spp_limit = 0;  ///< samples a pixel after which the panes rest; 0: none
    bool paused = false;

    bool show_panel = true;
    bool show_help = false;
    bool show_messages = false;
    std::vector<Message> messages;

    // Wishes, cleared by who fulfils them.
    bool restart = false;
    bool save_picture = false;
    bool quit = false;

    PaneState& active() { return panes[static_cast<std::size_t>(active_pane)]; }
    const PaneState& active() const { return panes[static_cast<std::size_t>(active_pane)]; }

    /// The size that all panes are to render, pixels.
    glm::ivec2 request_size() const;

    /// Adds a message; an error opens the list.
    void add_message(Message::Kind kind, std::string text);

    /// Gives the active pane's settings to all panes, if they are linked. Each keeps its method and buffer.
    void share_settings();
};

} // namespace tessera
