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

/// Collects the data of the charts. Measures in the background the errors of the panes' pictures against the
/// reference; without one, estimates the errors of the raw samples (recon/metrics/sample_error.h). Measures
/// histograms while charts are on show, and records the outcomes of shifts.
class ChartJob {
public:
    /// To be called every frame. `wake` is called from another thread when a measurement is complete.
    void update(ViewerState& state, const std::function<void()>& wake);

private:
    /// A picture to measure.
    struct Request {
        std::shared_ptr<const void> source;         // picture_source()
        std::shared_ptr<const Reference> reference; // null: the error of raw samples is estimated
        bool wants_histogram = false;
        std::uint64_t generation = 0; // of the pane's request
        Method method = Method::gpr;
        ReconstructionSettings reconstruction; // as applied(); Norm::none for an estimate
        bool operator==(const Request&) const = default;
    };
    struct Measured {
        std::optional<ErrorPoint> point;
        std::shared_ptr<const Histogram> histogram; // null: not requested
    };
    using Job = BackgroundJob<Request, Measured>;
    static void add_shifts(const PaneState& pane, PaneChart& chart);
    static void ask(Job& job, const PaneState& pane, const std::shared_ptr<const Reference>& reference,
                    bool wants_histogram, const std::function<void()>& wake);
    static Measured measure(const Snapshot& snapshot, const Request& request);
    static void add_point(std::vector<ErrorCurve>& curves, const Request& request, const ErrorPoint& point);
    void take(ViewerState& state, std::size_t slot);

    std::array<Job, most_panes> jobs_; // index: slot
};

/// Computes in the background the data that some buffers need beside a snapshot: reads the requested reference,
/// and traces first hits while a pane shows a buffer of them. Reports a reference of another scene or camera.
class CompanionJobs {
public:
    /// To be called every frame. `wake` is called from other threads when a result or progress is available.
    void update(ViewerState& state, const std::function<void()>& wake);

private:
    /// A reference file that is read.
    struct Reading {
        std::string file;
        std::shared_ptr<std::atomic<float>> fraction; // fraction read so far, [0, 1]; written by the work
    };
    /// A comparison of a reference's checksums with a scene.
    struct Check {
        Identity reference, scene;
        bool operator==(const Check&) const = default;
    };
    /// Parameters of first hits.
    struct View {
        Identity scene;
        Camera camera;
        glm::ivec2 size{0};
        bool with_footprints = false;
        int divisor = 1; // of width and height; more than 1 for a preview
        bool operator==(const View&) const = default;
    };
    static View view_of(const ViewerState& state);
    static bool is_current(const std::optional<View>& view, const ViewerState& state);
    void take_first_hits(ViewerState& state);
    void read_reference(std::string file, const std::function<void()>& wake);
    void update_reference(ViewerState& state, const std::function<void()>& wake);
    void check_reference(ViewerState& state, const std::function<void()>& wake);
    void update_first_hits(ViewerState& state, const std::function<void()>& wake);

    BackgroundJob<Reading, std::shared_ptr<const Reference>> reference_;
    BackgroundJob<Check, std::string> check_; // result: names of the parts that differ; empty: none
    BackgroundJob<View, std::shared_ptr<const FirstHits>> first_hits_;
    std::optional<View> first_hits_view_; // parameters of the state's first hits
};

/// Traces the path inspector's sample again in the background, and puts the result into the state.
class InspectionJob {
public:
    /// To be called every frame. `wake` is called from another thread when a result is available.
    void update(ViewerState& state, const std::function<void()>& wake);

    /// Whether an inspection is under way.
    bool running() const { return job_.running(); }

private:
    struct Request {
        std::uint64_t generation = 0; // of the picture's request
        SampleChoice sample;          // as chosen; its pixel may lie outside the picture
        int pass = 0;
        bool operator==(const Request&) const = default;
    };
    struct Found {
        std::shared_ptr<const Inspection> inspection;
        float scene_radius = 0;
    };
    void take(ViewerState& state);
    void drop_stale_sample(ViewerState& state);
    bool has_asked(const PassOrigin& origin, const SampleChoice& sample) const;
    std::shared_ptr<const PassOrigin> origin_of(const ViewerState& state, const SampleChoice& sample) const;
    int pass_of(const ViewerState& state, const PassOrigin& origin, const SampleChoice& sample) const;
    void ask(const std::shared_ptr<const PassOrigin>& origin, const Request& request,
             const std::function<void()>& wake);

    BackgroundJob<Request, Found> job_;
};

/// Advances the slow motion, and traces its tiles again in the background.
class SlowMotionJob {
public:
    /// To be called every frame, with the seconds since the last one. `wake` is called from another thread when a
    /// tile is available.
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

/// Traces in the background the surroundings of inspected paths: first hits and light positions.
class SurroundingsJob {
public:
    /// To be called every frame. `wake` is called from another thread when a result is available.
    void update(ViewerState& state, const std::function<void()>& wake);

    /// Whether the trace is under way.
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

/// Renders references in the background, bit-identical to those of `tessera reference`, on threads of lower
/// priority than the panes'. Cancellation and the destructor stop the pass under way and leave a checkpoint.
class ReferenceJob {
public:
    /// Starts and stops reference renders as wished, and updates their progress. To be called every frame. A
    /// complete reference becomes the state's if the panes show its scene, camera and size. `threads` as in
    /// ThreadPool; `wake` is called from another thread when there is progress.
    void update(ViewerState& state, int threads, const std::function<void()>& wake);

private:
    /// Counters of one of the two halves.
    struct HalfCounters {
        RenderSettings settings;
        Counters counters;
    };
    /// Result of a reference render.
    struct MakingResult {
        std::optional<FloorFreeError> error; ///< empty: the render was cancelled
        int spp = 0;
        std::vector<HalfCounters> halves;
    };
    class Watch;
    /// Subject and output file of a reference render.
    struct MakingRequest {
        std::filesystem::path file;
        std::shared_ptr<const Scene> scene;
        Camera camera;
        glm::ivec2 size{0};
        std::shared_ptr<Watch> watch;
    };
    using Job = BackgroundJob<MakingRequest, MakingResult>;
    void start(ViewerState& state, int threads, const std::function<void()>& wake);
    static void take(ViewerState& state, const Job::Outcome& outcome);

    Job job_;
};

} // namespace tessera
