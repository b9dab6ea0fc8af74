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
    struct Request {
        std::uint64_t generation = 0; // of the picture's request
        SampleChoice sample;          // as it was chosen
        int pass = 0;
        bool operator==(const Request&) const = default;
    };
    struct Found {
        std::shared_ptr<const Inspection> inspection;
        float scene_radius = 0;
    };
    void take(ViewerState& state);
    void drop_what_is_gone(ViewerState& state);
    bool has_asked(const PassOrigin& origin, const SampleChoice& sample) const;
    std::shared_ptr<const PassOrigin> origin_of(const ViewerState& state, const SampleChoice& sample) const;
    int pass_of(const ViewerState& state, const PassOrigin& origin, const SampleChoice& sample) const;
    void ask(const std::shared_ptr<const PassOrigin>& origin, const Request& request,
             const std::function<void()>& wake);

    BackgroundJob<Request, Found> job_;
};

/// Lets the slow motion go on, and finds its tiles out in the background.
class SlowMotionJob {
public:
    /// To be called every frame, with the seconds since the last. `wake` is called from another thread when there
    /// is something new.
    void update(ViewerState& state, float seconds, const std::function<void()>& wake);

private:
    struct Request {
        std::uint64_t generation = 0; // of the picture's request
        SampleChoice sample;
        bool operator==(const Request&) const = default;
    };
    static void choose(ViewerState& state);
    void ask(ViewerState& state, const std::function<void()>& wake);

    BackgroundJob<Request, std::shared_ptr<const TileInspection>> job_;
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
        Identity scene;
        Camera camera;
        glm::ivec2 size{0};
        bool operator==(const View&) const = default;
    };
    static std::shared_ptr<const Surroundings> find(const Scene& scene, const View& view, std::stop_token stop);

    BackgroundJob<View, std::shared_ptr<const Surroundings>> job_;
};

} // namespace tessera
