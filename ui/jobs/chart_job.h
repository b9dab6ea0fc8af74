#pragma once

#include "ui/jobs/background_job.h"
#include "ui/state/viewer_state.h"

#include <array>
#include <functional>
#include <vector>

namespace tessera {

/// Gathers what charts show: measures the panes' pictures in the background, errors against the reference, once
/// there is one, and histograms while charts are on show; and notes how shifts end.
class ChartJob {
public:
    /// To be called every frame. `wake` is called from another thread when there is something new.
    void update(ViewerState& state, const std::function<void()>& wake);

private:
    /// A picture to measure, and what came of it.
    struct Measured {
        int slot;
        std::shared_ptr<const Snapshot> snapshot;
        std::shared_ptr<const void> source; ///< picture_source()
        std::shared_ptr<const Reference> reference;
        bool wants_histogram;
        std::optional<ErrorPoint> point{};
        std::optional<Histogram> histogram{};
    };
    /// What was measured last in a slot.
    struct Done {
        std::shared_ptr<const void> source;
        std::shared_ptr<const Reference> reference;
        bool histogram = false;
    };
    void start(const ViewerState& state, bool wants_histograms, const std::function<void()>& wake);
    void drop_histogram(const PaneState& pane, PaneChart& chart);
    static void note_shifts(const PaneState& pane, PaneChart& chart);
    static void measure(Measured& picture);
    static void add_point(std::vector<ErrorCurve>& curves, const Snapshot& snapshot, const ErrorPoint& point);
    void take(ViewerState& state, Measured& measured);

    BackgroundJob<std::vector<Measured>> job_;
    std::array<Done, most_panes> done_; // by slot
};

} // namespace tessera
