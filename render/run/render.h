#pragma once

#include "render/estimator/guiding_learner.h"
#include "render/estimator/learned_reuse.h"
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

/// A render in progress: a film and the state from which the next pass continues.
class Render {
public:
    /// Throws std::runtime_error for an invalid size, OutOfMemory if the film does not fit, std::invalid_argument
    /// for settings outside their limits.
    /// @param scene       may be null if no pass follows, as for restored sums
    /// @param first_pass  index of the first pass, >= 0, on which random numbers depend. The render learns from
    /// its
    ///                    own passes only, not from those before it.
    Render(std::shared_ptr<const Scene> scene, const Camera& camera, glm::ivec2 size,
           const RenderSettings& settings, int first_pass = 0);

    /// Returns an upper bound on the memory of a render with so many threads, including the means.
    static std::uint64_t bytes(glm::ivec2 size, const RenderSettings& settings, int threads);

    /// Takes one more sample at every pixel. Returns false if it was stopped. The next call then continues with
    /// the remaining blocks, to the same bits; until then the sums of the picture are incomplete. The first call
    /// throws OutOfMemory if the memory for the pool's threads is missing.
    /// @param progress  receives the finished fraction of the pass, in [0, 1], including the pilot pass, from the
    ///                  pool's threads; may be null
    bool pass(ThreadPool& pool, std::stop_token stop = {}, std::atomic<float>* progress = nullptr);

    int spp() const { return spp_; }
    double seconds() const { return seconds_; }         ///< wall time of all passes, including stopped ones
    double cpu_seconds() const { return cpu_seconds_; } ///< CPU time of all workers
    const Counters& counters() const { return counters_; }
    const RenderSettings& settings() const { return settings_; }
    const std::shared_ptr<const Scene>& scene() const { return scene_; }
    const Camera& camera() const { return camera_; }
    glm::ivec2 size() const { return size_; }
    /// Returns means over the passes so far.
    GradientImages images() const { return with_patch(film_.means(spp_)); }
    /// Returns images() and frees all sums, including those of reuse_maps() and coverage(). No pass may follow.
    /// Times and counters remain.
    GradientImages take_images() { return with_patch(film_.take_means(spp_)); }
    ReuseMaps reuse_maps() const;
    /// Returns alpha: the fraction of each pixel that sees anything, in [0, 1].
    Image<float> coverage() const { return film_.coverage(spp_); }
    /// Returns the state that the newest pass used.
    std::shared_ptr<const LearnedReuse> newest_learned() const { return newest_learned_; }
    /// Adds the passes of another render of the same scene, view, size and settings. The two renders must have no
    /// pass in common. The bits depend on the order. No pass may follow.
    void add(const Render& other);
    /// Returns all memory that passes change, except that of path guiding. Another render of the same scene, view,
    /// size and settings, without path guiding, continues from a copy of this memory with the same bits.
    Memory memory();

private:
    class Progress;
    class Workers;

    bool send_pilot(ThreadPool& pool, const std::stop_token& stop, Progress& progress);
    bool pre_pass(Workers& workers);
    bool find_mixed_pixels(Workers& workers);
    void learn_from_pass();
    GradientImages with_patch(GradientImages images) const;

    std::shared_ptr<const Scene> scene_;
    Camera camera_;
    glm::ivec2 size_;
    RenderSettings settings_;
    Film film_;
    std::vector<std::uint8_t> done_blocks_;      // of the current pass: 1 for each finished block
    std::vector<std::vector<FoundLight>> found_; // by block
    GuidingLearner guiding_;
    LearnedReuse learned_, next_learned_;                // used by the current passes, and learned from them
    std::shared_ptr<const LearnedReuse> newest_learned_; // learned_ of the newest pass
    Counters counters_;
    int first_pass_;
    int spp_ = 0; // finished passes
    double seconds_ = 0;
    double cpu_seconds_ = 0;
};

} // namespace tessera
