#pragma once

#include "render/session/session.h"
#include "ui/state/buffer.h"
#include "ui/state/companions.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

inline constexpr int most_panes = 4;
/// What a pane is compared with, in place of another's index: the picture that errors are measured against.
inline constexpr int the_reference = most_panes;

/// How a pane shows another pane's picture with its own.
struct Comparison {
    enum class Kind {
        off,
        wipe,       ///< its own to the left of a line, the other's to the right
        difference, ///< its own minus the other's, in +/- colours
    };
    Kind kind = Kind::off;
    int with = -1; ///< the other pane, or the_reference; one that is not there: the next

    bool operator==(const Comparison&) const = default;
};

/// What a user sets for one pane.
struct PaneSettings {
    RenderSettings render;
    ReconstructionSettings reconstruction;
    Buffer buffer = Buffer::reconstruction;
    Comparison comparison;

    bool operator==(const PaneSettings&) const = default;
};

/// What so many panes start with: PT, G-PT, PR and G-PR, or fewer of them.
std::vector<PaneSettings> default_panes(int count);

struct PaneState {
    PaneSettings settings;
    std::shared_ptr<const Snapshot> snapshot;               ///< the newest; null before the first
    std::uint64_t generation = 0;                           ///< of the request that is out
    glm::ivec2 canvas_size{0};                              ///< pixels of the place for its picture, as last drawn
    std::optional<ReconstructionUnderWay> reconstructing{}; ///< of its newest picture; empty: none is under way
    bool failed = false; ///< its render went wrong: nothing more will come of the request
    int slot = 0; ///< the session's pane that renders it: no other has it, and it keeps it wherever it is shown
};

/// What charts show of a pane.
struct PaneChart {
    /// Those that have points, in the order of their newest ones.
    std::vector<ErrorCurve> curves;
    std::uint64_t generation = 0;               ///< of the request whose errors the curves are
    std::shared_ptr<const Reference> reference; ///< that these errors are measured against
    std::uint64_t shift_generation = 0;         ///< of the request whose shifts these are
    PassHistory<ShiftPoint> shifts;             ///< without points where the method makes none
    std::uint64_t histogram_generation = 0;     ///< of the request whose histogram it is
    std::shared_ptr<const Histogram> histogram; ///< of the newest picture; null: none yet
};

} // namespace tessera
