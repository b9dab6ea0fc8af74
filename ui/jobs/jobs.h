#pragma once

#include "ui/jobs/background_job.h"
#include "ui/state/viewer_state.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tessera {

/// Gathers what charts show: measures the panes' pictures in the background, errors against the reference or,
/// until there is one, those of the samples by their own variance, and histograms while charts are on show; and
/// notes how shifts end.
class ChartJob {
public:
    /// To be called every frame. `wake` is called from another thread when there is something new.
    void update(ViewerState& state, const std::function<void()>& wake);

private:
    /// A picture to measure.
    struct Request {
        std::shared_ptr<const void> source;         // picture_source()
        std::shared_ptr<const Reference> reference; // null: the samples' error is estimated
        bool wants_histogram = false;
        std::uint64_t generation = 0; // of the pane's request
        Method method = Method::gpr;
        ReconstructionSettings reconstruction; // as applied(); of samples none
        bool operator==(const Request&) const = default;
    };
    struct Measured {
        std::optional<ErrorPoint> point;
        std::shared_ptr<const Histogram> histogram; // null where none was wanted
    };
    using Job = BackgroundJob<Request, Measured>;
    static void add_shifts(const PaneState& pane, PaneChart& chart);
    static void ask(Job& job, const PaneState& pane, const std::shared_ptr<const Reference>& reference,
                    bool wants_histogram, const std::function<void()>& wake);
    static Measured measure(const Snapshot& snapshot, const Request& request);
    static void add_point(std::vector<ErrorCurve>& curves, const Request& request, const ErrorPoint& point);
    void take(ViewerState& state, std::size_t slot);

    std::array<Job, most_panes> jobs_; // by slot
};

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
        bool with_footprints = false;
        int divisor = 1; // of the size
        bool operator==(const View&) const = default;
    };
    static View view_of(const ViewerState& state);
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

/// Makes references in the background, as `tessera reference` does and to the same bits, on threads that give way
/// to those of the panes. Its end, like a cancellation, stops the pass under way and leaves a checkpoint.
class ReferenceJob {
public:
    /// To be called every frame: fulfils the wishes to make a reference, and tells how far it is. What is
    /// complete becomes the reference of the state if its scene, camera and size are still what the panes show.
    /// `threads` as in ThreadPool; `wake` is called from another thread when there is something new.
    void update(ViewerState& state, int threads, const std::function<void()>& wake);

private:
    /// What one of its renders has counted.
    struct Counted {
        RenderSettings settings;
        Counters counters;
    };
    /// What has become of it.
    struct Made {
        std::optional<FloorFreeError> error; ///< of a complete one; empty: it was cancelled
        int spp = 0;
        std::vector<Counted> halves;
    };
    class Watch;
    /// What it is made of, and where it goes.
    struct Order {
        std::filesystem::path file;
        std::shared_ptr<const Scene> scene;
        Camera camera;
        glm::ivec2 size{0};
        std::shared_ptr<Watch> watch;
    };
    using Job = BackgroundJob<Order, Made>;
    void start(ViewerState& state, int threads, const std::function<void()>& wake);
    static void take(ViewerState& state, const Job::Outcome& outcome);

    Job job_;
};

} // namespace tessera
