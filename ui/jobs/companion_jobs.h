#pragma once

#include "ui/jobs/background_job.h"
#include "ui/state/viewer_state.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace tessera {

/// Makes in the background what some buffers need beside a snapshot, and puts it into the state: the reference
/// that is wished for, and the first hits of what the panes show, once one of them wants to see any. Says so where
/// the reference knows that it shows something else than the panes.
class CompanionJobs {
public:
    /// To be called every frame. `wake` is called from other threads when there is something new.
    void update(ViewerState& state, const std::function<void()>& wake);

private:
    /// A reference that is read.
    struct Reading {
        std::string file;
        std::shared_ptr<std::atomic<float>> share; // how far, told by the work
    };
    /// What a reference is compared with.
    struct Check {
        Identity reference, scene;
        bool operator==(const Check&) const = default;
    };
    /// What first hits depend on, and how large they are.
    struct View {
        Identity scene;
        Camera camera;
        glm::ivec2 size{0};
        int divisor = 1; // of the size
        bool operator==(const View&) const = default;
    };
    static bool is_of(const std::optional<View>& view, const ViewerState& state);
    void take_first_hits(ViewerState& state);
    void read_reference(std::string file, const std::function<void()>& wake);
    void update_reference(ViewerState& state, const std::function<void()>& wake);
    void check_reference(ViewerState& state, const std::function<void()>& wake);
    void update_first_hits(ViewerState& state, const std::function<void()>& wake);

    BackgroundJob<Reading, std::shared_ptr<const Reference>> reference_;
    BackgroundJob<Check, std::string> check_; // the result: in what it differs
    BackgroundJob<View, std::shared_ptr<const FirstHits>> first_hits_;
    std::optional<View> hit_; // what the first hits of the state are of
};

} // namespace tessera
