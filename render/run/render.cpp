#include "render/run/render.h"

#include "render/estimator/basis.h"
#include "render/estimator/methods.h"
#include "render/estimator/pass.h"
#include "render/estimator/pilot.h"
#include "render/estimator/pre_pass.h"
#include "render/estimator/worker.h"
#include "render/io/available_memory.h"
#include "render/io/files.h"
#include "render/settings/settings_table.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

FilmBuffers buffers_of(const RenderSettings& s) {
    return {has_gradients(s.method),
            is_demodulated(s),
            s.method != Method::pt,
            reuses_paths(s.method) && s.adapt_tile,
            s.edge_rays,
            component_count(s),
            measures_reuse_gain(s) || has_positions(s)};
}

std::uint64_t bytes_of_threads(int threads, const RenderSettings& settings) {
    return static_cast<std::uint64_t>(threads) * Worker::bytes(settings);
}

/// Returns the size. Throws std::runtime_error if it is invalid, OutOfMemory if the film does not fit.
glm::ivec2 checked(glm::ivec2 size, const RenderSettings& settings) {
    check_image_size(size.x, size.y);
    require_memory(Film::bytes(size.x, size.y, buffers_of(settings)),
                   fmt::format("{}x{} pixels of {}", size.x, size.y, short_name(settings.method)));
    return size;
}

} // namespace

Render::Render(std::shared_ptr<const Scene> scene, const Camera& camera, glm::ivec2 size,
               const RenderSettings& settings, int first_pass)
    : scene_(std::move(scene)), camera_(camera), size_(checked(size, settings)), settings_(settings),
      film_(size.x, size.y, buffers_of(settings)), learned_(size, settings_), next_learned_(learned_),
      newest_learned_(std::make_shared<const LearnedReuse>(learned_)), first_pass_(first_pass) {
    check(settings);
    done_blocks_.resize(most_blocks(size, settings));
    found_.resize(done_blocks_.size());
}

std::uint64_t Render::bytes(glm::ivec2 size, const RenderSettings& settings, int threads) {
    // take_images() frees each group of sums after use. Only the means of the last group come on top of all sums.
    const std::size_t a_pixel =
        sizeof(Rgb) + sizeof(float) + BrightestSamples::bytes_a_pixel + HalfDifferences::bytes_a_pixel +
        FeatureImages::bytes_a_pixel +
        static_cast<std::size_t>(buffers_of(settings).components) * BasisComponent::bytes_a_pixel;
    const std::uint64_t means = a_pixel * static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
    const bool learns = settings.path_guiding != Guiding::off;
    const std::uint64_t found = learns ? GuidingLearner::bytes_of_found(size.x * size.y) : 0;
    const std::uint64_t learnt = learns ? GuidingLearner::bytes_of_learnt() : 0;
    const bool pre_pass = has_positions(settings); // its feature samples are freed before the first pass
    const std::uint64_t first = pre_pass ? PixelFeatures::bytes(size.x, size.y) : 0;
    const std::uint64_t mixed =
        pre_pass ? static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y) : 0;
    return Film::bytes(size.x, size.y, buffers_of(settings)) + learnt + mixed +
           std::max(means, bytes_of_threads(threads, settings) + std::max(found, first));
}

/// Sets the edge of the squares of pixels with correlated noise to that of a tile. Split tiles have smaller
/// squares.
GradientImages Render::with_patch(GradientImages images) const {
    if (reuses_paths(settings_.method))
        images.patch = static_cast<float>(settings_.tile);
    return images;
}

/// Progress of a pass: finished cells of its pilot pass, if it has one, and finished blocks.
class Render::Progress {
public:
    Progress(std::atomic<float>* result, std::size_t total) : result_(result), total_(static_cast<float>(total)) {
        if (result_)
            *result_ = 0;
    }
    void set_total(std::size_t total) { total_ = static_cast<float>(total); } ///< not concurrently with add()
    void add(std::ptrdiff_t count) {
        const float fraction = static_cast<float>(done_ += count) / total_;
        if (!result_)
            return;
        // Threads can get here in another order than that of their counts.
        for (float last = *result_; last < fraction && !result_->compare_exchange_weak(last, fraction);)
            ;
    }

private:
    std::atomic<float>* result_;
    float total_;
    std::atomic<std::ptrdiff_t> done_ = 0;
};

/// One worker per thread of the pool.
class Render::Workers {
public:
    Workers(const Render& render, ThreadPool& pool, std::stop_token stop) : pool_(pool), stop_(std::move(stop)) {
        for (int i = 0; i < pool.size(); ++i)
            all_.push_back(std::make_unique<Worker>(*render.scene_, render.camera_, render.size_, render.settings_,
                                                    render.learned_.guiding()));
    }

    /// Calls `work(i, worker)` for all i below count. Returns false if it was stopped.
    template <class Work>
    bool for_each(std::size_t count, const Work& work) {
        pool_.parallel_for(
            static_cast<int>(count),
            [&](int i, int w) {
                Worker& worker = *all_[w];
                const double before = thread_cpu_seconds();
                work(i, worker);
                worker.cpu_seconds += thread_cpu_seconds() - before;
            },
            stop_);
        return !stop_.stop_requested();
    }

    const std::vector<std::unique_ptr<Worker>>& all() const { return all_; }

private:
    ThreadPool& pool_;
    std::stop_token stop_;
    std::vector<std::unique_ptr<Worker>> all_;
};

/// Pre-pass: finds the edges of directly visible emitters, and the projections s^l of theory (30). Returns false
/// if it was stopped; its results are then incomplete.
bool Render::pre_pass(Workers& workers) {
    const Pass pass(*scene_, camera_, size_, settings_, learned_, 0);
    const std::vector<PixelRect> blocks = blocks_of(pass);
    const int views = very_direct_views(pass);
    for (int view = 0; view < views; ++view) {
        RgbImage lamps(size_.x + 2, size_.y + 2);
        if (!workers.for_each(blocks.size(), [&](int i, Worker& worker) {
                show_very_direct(pass, view, blocks[i], worker.tracer, lamps);
            }))
            return false;
        film_.find_lamp_edges(lamps);
    }
    return !is_expanded(settings_) || workers.for_each(blocks.size(), [&](int i, Worker& worker) {
        find_projections(pass, blocks[i], worker.tracer, film_);
    });
}

/// Finds the mixed pixels from the first feature samples of each pixel. These do not depend on later samples, so a
/// render that continues from a checkpoint finds the same pixels. Returns false if it was stopped.
bool Render::find_mixed_pixels(Workers& workers) {
    const Pass pass(*scene_, camera_, size_, settings_, learned_, 0);
    const std::vector<PixelRect> blocks = blocks_of(pass);
    PixelFeatures first(size_.x, size_.y, is_demodulated(settings_));
    if (!workers.for_each(blocks.size(),
                          [&](int i, Worker& worker) { take_feature_samples(pass, blocks[i], worker, first); }))
        return false;
    film_.take_features(first);
    learned_.set_mixed(std::make_shared<const Image<std::uint8_t>>(first.mixed()));
    next_learned_.set_mixed(learned_.mixed());
    return true;
}

/// Pilot pass: measures the gain of path reuse. Its samples are not part of the picture, and its counters are not
/// part of the render's.
bool Render::send_pilot(ThreadPool& pool, const std::stop_token& stop, Progress& progress) {
    if (!learned_.wants_pilot())
        return true;
    LearnedReuse learned(size_, settings_); // not learned_: a stopped first call may have taught it
    const Pilot pilot(*scene_, camera_, size_, settings_, learned);
    Workers workers(*this, pool, stop);
    std::vector<CellStatistics> found(static_cast<std::size_t>(learned.cell_count()));
    if (!workers.for_each(found.size(), [&](int i, Worker& worker) {
            found[i] = pilot.explore(learned.cell(i), worker);
            progress.add(1);
        }))
        return false;
    learned.learn(found);
    learned_ = next_learned_ = learned;
    for (const auto& worker : workers.all())
        cpu_seconds_ += worker->cpu_seconds;
    return true;
}

bool Render::pass(ThreadPool& pool, std::stop_token stop, std::atomic<float>* progress) {
    const auto start = std::chrono::steady_clock::now();
    const auto done_before = std::ranges::count(done_blocks_, 1);
    if (spp_ == 0)
        require_memory(bytes_of_threads(pool.size(), settings_), fmt::format("{} threads", pool.size()));
    const bool is_begun = spp_ > 0 || done_before > 0;
    const bool has_pilot = !is_begun && learned_.wants_pilot();
    const std::size_t cells = has_pilot ? static_cast<std::size_t>(learned_.cell_count()) : 0;
    Progress tracker(progress, cells + done_blocks_.size());
    tracker.add(done_before);
    if (!is_begun && !send_pilot(pool, stop, tracker))
        return false;
    const Pass pass(*scene_, camera_, size_, settings_, learned_, first_pass_ + spp_);
    const std::vector<PixelRect> blocks = blocks_of(pass);
    tracker.set_total(cells + blocks.size());
    Workers workers(*this, pool, stop);
    if (!is_begun && !pre_pass(workers))
        return false;
    if (has_positions(settings_) && (!is_begun || !learned_.mixed())) {
        Workers uncounted(*this, pool, stop); // a restored render has counted these samples
        if (!find_mixed_pixels(is_begun ? uncounted : workers))
            return false;
    }
    workers.for_each(blocks.size(), [&](int i, Worker& worker) {
        std::uint8_t& is_done = done_blocks_[i];
        if (is_done)
            return; // finished in an earlier, stopped call
        render_block(pass, blocks[i], worker, film_);
        found_[i] = worker.found;
        is_done = 1;
        tracker.add(1);
    });
    const auto done = std::ranges::count(done_blocks_, 1);
    if (done == done_before)
        return false; // the next call repeats the pre-pass, if there was one
    for (const auto& worker : workers.all()) {
        counters_ += worker->counters;
        cpu_seconds_ += worker->cpu_seconds;
    }
    const bool is_whole = std::cmp_equal(done, blocks.size());
    if (is_whole)
        learn_from_pass();
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return is_whole;
}

/// Learns from the finished pass, in the calling thread. The state that passes use changes after 1, 2, 4, 8, ...
/// passes only, so that all passes with the same state have random numbers of one net (Pass::random).
void Render::learn_from_pass() {
    const double before = thread_cpu_seconds();
    std::ranges::fill(done_blocks_, std::uint8_t{0});
    newest_learned_ = std::make_shared<const LearnedReuse>(learned_);
    guiding_.learn(found_);
    for (std::vector<FoundLight>& found : found_)
        found = {};
    next_learned_.learn(film_.path_luminance());
    film_.finish(first_pass_ + spp_);
    ++spp_;
    if (std::has_single_bit(unsigned(spp_))) {
        next_learned_.set_guiding(guiding_.make_guiding(settings_.path_guiding));
        film_.request_features(first_pass_ + 2 * spp_);
        learned_.take(next_learned_, first_pass_ + spp_);
    }
    cpu_seconds_ += thread_cpu_seconds() - before;
}

ReuseMaps Render::reuse_maps() const {
    ReuseMaps maps = film_.reuse_maps(spp_);
    if (maps.empty() || spp_ == 0 || !reuses_paths(settings_.method))
        return maps;
    maps.reuse_set_size = reuse_set_sizes(Pass(*scene_, camera_, size_, settings_, learned_, first_pass_ + spp_));
    maps.gain = Image<float>(size_.x, size_.y);
    for (int i = 0; i < learned_.cell_count(); ++i)
        for_each_square(learned_.cell(i), 1, [&](PixelRect p) { maps.gain(p.x0, p.y0) = learned_.gain(i); });
    return maps;
}

void Render::add(const Render& other) {
    film_.add(other.film_);
    counters_ += other.counters_;
    spp_ += other.spp_;
    seconds_ += other.seconds_;
    cpu_seconds_ += other.cpu_seconds_;
}

Memory Render::memory() {
    Memory memory = film_.memory();
    append(memory, learned_.memory());
    append(memory, next_learned_.memory());
    append(memory, {std::as_writable_bytes(std::span(done_blocks_))});
    append(memory, {memory_of(counters_), memory_of(spp_), memory_of(seconds_), memory_of(cpu_seconds_)});
    return memory;
}

} // namespace tessera
