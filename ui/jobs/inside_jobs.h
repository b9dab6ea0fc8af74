#pragma once

#include "ui/jobs/background_job.h"
#include "ui/state/viewer_state.h"

#include <functional>

namespace tessera {

/// Finds out in the background about the sample that the inspector is to show, and puts it into the state.
class InspectionJob {
public:
    /// To be called every frame. `wake` is called from another thread when there is something new.
    void update(ViewerState& state, const std::function<void()>& wake);

    /// Whether what is to be shown is still being found out.
    bool running() const { return job_.running(); }

private:
    struct Asked {
        std::uint64_t generation = 0; ///< of its request
        SampleChoice sample;          ///< as it was chosen
        int pass = 0;
        bool is_of(const PassOrigin& origin, const SampleChoice& choice) const {
            return generation == origin.generation && sample == choice;
        }
        bool operator==(const Asked&) const = default;
    };
    struct Found {
        std::shared_ptr<const Inspection> inspection;
        float scene_radius = 0;
    };
    void take(ViewerState& state);
    void drop_what_is_gone(ViewerState& state);
    void give_up();
    std::shared_ptr<const PassOrigin> origin_of(const ViewerState& state, const SampleChoice& sample) const;
    int pass_of(const ViewerState& state, const PassOrigin& origin, const SampleChoice& sample) const;
    void start(const std::shared_ptr<const PassOrigin>& origin, const Asked& wanted,
               const std::function<void()>& wake);

    BackgroundJob<Found> job_;
    Asked asked_; // last
};

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

/// Finds out in the background what lies around the paths that are looked at.
class SurroundingsJob {
public:
    /// To be called every frame. `wake` is called from another thread when there is something new.
    void update(ViewerState& state, const std::function<void()>& wake);

    /// Whether they are still being found out.
    bool running() const { return job_.running(); }

private:
    struct View {
        std::weak_ptr<const Scene> scene; // not kept alive by what was found in it
        Camera camera;
        glm::ivec2 size{0};
        bool operator==(const View& other) const {
            return scene.lock() == other.scene.lock() && camera == other.camera && size == other.size;
        }
    };
    static std::shared_ptr<const Surroundings> find(const Scene& scene, const View& view, std::stop_token stop);

    BackgroundJob<std::shared_ptr<const Surroundings>> job_;
    View asked_; // last
};

} // namespace tessera
