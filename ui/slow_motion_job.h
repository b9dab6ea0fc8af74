#pragma once

#include "ui/background_job.h"
#include "ui/viewer_state.h"

#include <functional>

namespace tessera {

/// Lets the slow motion go on, and finds its tiles out in the background.
class SlowMotionJob {
public:
    /// To be called every frame, with the seconds since the last. `wake` is called from another thread when there
    /// is something new.
    void update(ViewerState& state, float seconds, const std::function<void()>& wake);

private:
    struct Asked {
        std::uint64_t generation = 0;
        SampleChoice sample;
        bool operator==(const Asked&) const = default;
    };
    static void choose(ViewerState& state);
    void ask(ViewerState& state, const std::function<void()>& wake);

    BackgroundJob<std::shared_ptr<const TileInspection>> job_;
    Asked asked_; // last
};

} // namespace tessera
