#pragma once

#include "render/session/session.h"
#include "ui/state/buffer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

inline constexpr int most_panes = 4;
/// Index of the reference, wherever a pane's index is expected.
inline constexpr int the_reference = most_panes;

/// How a pane compares its picture with another pane's.
struct Comparison {
    enum class Kind {
        off,
        wipe,       ///< its own picture to the left of a line, the other's to the right
        difference, ///< its own picture minus the other's, in signed colours
    };
    Kind kind = Kind::off;
    int with = -1; ///< the other pane, or the_reference; an index without a pane means the next pane

    bool operator==(const Comparison&) const = default;
};

/// The settings that a user chooses for one pane.
struct PaneSettings {
    RenderSettings render;
    ReconstructionSettings reconstruction;
    Buffer buffer = Buffer::reconstruction;
    Comparison comparison;

    bool operator==(const PaneSettings&) const = default;
};

/// Returns the reconstruction that the pane's method applies: without gradients, often raw samples.
Norm applied_norm(const PaneSettings& pane);

/// Returns the initial settings of 1 to 4 panes: G-PR alone, PT and G-PR, these with G-PT, or all four methods.
std::vector<PaneSettings> default_panes(int count);

struct PaneState {
    PaneSettings settings;
    std::shared_ptr<const Snapshot> snapshot; ///< the newest; null before the first
    std::uint64_t generation = 0;             ///< of the present request
    glm::ivec2 canvas_size{0};                ///< of its picture area, framebuffer pixels, as last drawn
    std::optional<RunningReconstruction> reconstructing{}; ///< the one under way; empty: none is
    bool failed = false;     ///< its render failed; the request gets no more snapshots
    std::string failure{};   ///< reason of the failure
    float pass_progress = 0; ///< fraction of the pass under way that is done, [0, 1]
    int slot = 0;            ///< the session's pane for it: unique, and constant when the layout changes
};

/// Whether the pane's first pass takes so long that its progress is shown.
bool is_in_long_first_pass(const PaneState& pane);

/// The panes, in the order of their layout, and how they share settings.
struct PaneSet {
    std::vector<PaneState> panes;          ///< 1, 2 or 4 (3 work as well); all of them render
    std::vector<PaneSettings> spare_panes; ///< settings of removed panes, the last removed one last
    int active_pane = 0;
    int preset = 0;     ///< index in presets(), whose values the panel marks differences from
    bool linked = true; ///< all panes share their settings, except method, buffer and comparison

    PaneState& active() { return panes[active_pane]; }
    const PaneState& active() const { return panes[active_pane]; }

    /// Adds panes, with the settings of removed ones or a method that no pane has, or removes the last panes; the
    /// active one stays. Four panes of four methods form a table: PT and PR above G-PT and G-PR.
    /// @param count  1 to most_panes
    void set_pane_count(int count);

    /// Returns the pane that the session's slot renders; null: none does.
    const PaneState* pane_in(int slot) const;

    /// Copies the active pane's settings to all panes if they are linked. Each keeps its method, buffer and
    /// comparison.
    void share_settings();

    /// Whether a pane shows the request of that generation.
    bool shows_request(std::uint64_t generation) const;
};

} // namespace tessera
