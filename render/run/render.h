#pragma once

#include "render/estimator/guiding_learner.h"
#include "render/estimator/reuse_policy.h"
#include "render/film/film.h"
#include "render/run/thread_pool.h"
#include "render/scene/camera.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <vector>

namespace tessera {

class Pass;
class Scene;

/// A render in progress: a film and the passes it has seen.
class Render {
public:
    /// Throws std::runtime_error for a size, OutOfMemory where its film cannot be had, std::invalid_argument for
    /// settings outside their limits.
    /// @param scene       may be null where no pass is to be made: for what is restored, or added up
    /// @param first_pass  from 0 on: passes are those of one that begins with 0, but for what it would have learnt
    ///                    in the passes before, and the numbers of those that go by it
    Render(std::shared_ptr<const Scene> scene, const Camera& camera, glm::ivec2 size,
           const RenderSettings& settings, int first_pass = 0);

    /// The most memory that a render takes on so many threads, and means of its passes.
    static std::uint64_t bytes(glm::ivec2 size, const RenderSettings& settings, int threads);

    /// Takes one more sample at every pixel. False: stopped on the way, within a block of pixels. The next call
    /// goes on with the blocks that are left, to the same bits; before that, nothing is to be asked of the
    /// picture. Throws OutOfMemory where the first has none for its threads.
    /// @param share  is told, from the pool's threads, which share of the pass is done, from 0 on, the pilot of
    /// the
    ///               first one included; null: nobody wants to know
    bool pass(ThreadPool& pool, std::stop_token stop = {}, std::atomic<float>* share = nullptr);

    int spp() const { return spp_; }
    double seconds() const { return seconds_; }         ///< wall time of all passes, those stopped among them
    double cpu_seconds() const { return cpu_seconds_; } ///< CPU time of all workers
    const Counters& counters() const { return counters_; }
    const RenderSettings& settings() const { return settings_; }
    const std::shared_ptr<const Scene>& scene() const { return scene_; }
    const Camera& camera() const { return camera_; }
    glm::ivec2 size() const { return size_; }
    /// Means of the passes so far.
    GradientImages images() const { return with_patch(film_.means(spp_)); }
    /// What images() returns, giving up all that the render has summed, reuse_maps() with it: no pass may follow.
    /// Times and counts stay.
    GradientImages take_images() { return with_patch(film_.take_means(spp_)); }
    ReuseMaps reuse_maps() const;
    /// What the newest pass knew of where tiles are to be cut.
    std::shared_ptr<const ReusePlan> newest_plan() const { return newest_plan_; }
    /// Adds the passes of another render of the same scene, view, size and settings, which are none of this one's:
    /// its pictures are then those of all of them. The bits depend on the order. No pass may follow.
    void add(const Render& other);
    /// All that the passes have changed, but for what guides their paths. A render of the same scene, view, size
    /// and settings, without path guiding, whose memory is filled with this goes on with the same bits.
    Memory memory();

private:
    class Share;
    class Workers;

    bool send_pilot(ThreadPool& pool, const std::stop_token& stop, Share& share);
    bool look_first(Workers& workers);
    bool find_mixed_pixels(Workers& workers);
    void learn_from_pass();
    GradientImages with_patch(GradientImages images) const;

    std::shared_ptr<const Scene> scene_;
    Camera camera_;
    glm::ivec2 size_;
    RenderSettings settings_;
    Film film_;
    std::vector<std::uint8_t> done_blocks_;      // of the pass under way: 1 for each that it has done
    std::vector<std::vector<FoundLight>> found_; // by each of these
    GuidingLearner guiding_;
    ReusePlan plan_, next_plan_;                   // what passes go by, and what they tell it
    std::shared_ptr<const ReusePlan> newest_plan_; // plan_ of the newest pass
    Counters counters_;
    int first_pass_;
    int spp_ = 0; // how many it has made
    double seconds_ = 0;
    double cpu_seconds_ = 0;
};

} // namespace tessera
