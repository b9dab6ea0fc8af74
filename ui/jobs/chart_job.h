#pragma once

#include "ui/jobs/background_job.h"
#include "ui/state/viewer_state.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace tessera {

/// Gathers what charts show: measures the panes' pictures in the background, errors against the reference, once
/// there is one, and histograms while charts are on show; and notes how shifts end.
class ChartJob {
public:
    /// To be called every frame. `wake` is called from another thread when there is something new.
    void update(ViewerState& state, const std::function<void()>& wake);

private:
    /// A picture to measure.
    struct Request {
        std::shared_ptr<const void> source;         // picture_source()
        std::shared_ptr<const Reference> reference; // null: it has no error
        bool wants_histogram = false;
        std::uint64_t generation = 0; // of the pane's request
        Method method = Method::gpr;
        ReconstructionSettings reconstruction; // Norm::none where the method has no gradients
        bool operator==(const Request&) const = default;
    };
    struct Measured {
        std::optional<ErrorPoint> point;
        std::shared_ptr<const Histogram> histogram; // null where none was wanted
    };
    using Job = BackgroundJob<Request, Measured>;
    static void note_shifts(const PaneState& pane, PaneChart& chart);
    static void ask(Job& job, const PaneState& pane, const std::shared_ptr<const Reference>& reference,
                    bool wants_histogram, const std::function<void()>& wake);
    static Measured measure(const Snapshot& snapshot, const Request& request);
    static void add_point(std::vector<ErrorCurve>& curves, const Request& request, const ErrorPoint& point);
    void take(ViewerState& state, std::size_t slot);

    std::array<Job, most_panes> jobs_; // by slot
};

} // namespace tessera
