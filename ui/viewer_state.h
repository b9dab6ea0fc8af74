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
    /// What it is about: a scene's messages go when another takes its place, a failed load's at the next load.
    enum class Origin { viewer, scene, failed_load };
    Kind kind;
    std::string text;
    Origin origin = Origin::viewer;
};

/// Everything that panels, actions and the mouse may change. They do no more than that: the viewer compares the
/// state with what it last asked of the session, and sends what differs.
struct ViewerState {
    std::shared_ptr<const Scene> scene; ///< null while the first is loading
    std::string scene_name;
    int scenes_shown = 0; ///< so far, reloaded ones counted again
    std::string loading;  ///< what of the next scene is being loaded; empty: none is

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
    bool show_statistics = false;
    bool show_help = false;
    bool show_messages = false;
    std::vector<Message> messages;
    bool scroll_to_newest = false; ///< the list is to show its end

    // Wishes, cleared by who fulfils them.
    bool restart = false;
    bool reload = false;
    bool save_camera = false;
    bool copy_camera = false;
    bool save_picture = false;
    bool quit = false;

    PaneState& active() { return panes[static_cast<std::size_t>(active_pane)]; }
    const PaneState& active() const { return panes[static_cast<std::size_t>(active_pane)]; }

    /// The size that all panes are to render, pixels.
    glm::ivec2 request_size() const;

    /// Adds a message; an error opens the list at its end.
    void add_message(Message::Kind kind, std::string text, Message::Origin origin = Message::Origin::viewer);

    /// Takes away the messages of that origin. Closes the list if that leaves no error of some.
    void drop_messages(Message::Origin origin);

    /// Gives the active pane's settings to all panes, if they are linked. Each keeps its method and buffer.
    void share_settings();
};

} // namespace tessera
