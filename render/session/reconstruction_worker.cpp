#include "render/session/reconstruction_worker.h"

#include "render/io/available_memory.h"
#include "render/run/checked_reconstruction.h"
#include "render/run/thread_pool.h"

#include <chrono>
#include <exception>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace tessera {

/// Returns the next pane in turn that needs a reconstruction, or null. Needs the lock.
SessionPane* ReconstructionWorker::next_pane() {
    const std::size_t count = shared_.panes.size();
    for (std::size_t i = 0; i < count; ++i) {
        SessionPane* pane = shared_.panes[(turn_ + i) % count].get();
        if (pane->needs_reconstruction(shared_.pace, shared_.paused)) {
            ++turn_;
            return pane;
        }
    }
    return nullptr;
}

void ReconstructionWorker::loop(std::stop_token stop) {
    lower_priority();
    while (!stop.stop_requested()) {
        SessionPane* pane = nullptr;
        {
            std::unique_lock lock(shared_.mutex);
            if (!shared_.reconstruct_wake.wait(lock, stop, [&] { return (pane = next_pane()) != nullptr; }))
                return;
        }
        if (const Task task = begin(*pane); task.snapshot)
            reconstruct(*pane, task);
    }
}

/// Begins a task for the pane's newest snapshot. Returns an empty task if the pane has changed in between.
ReconstructionWorker::Task ReconstructionWorker::begin(SessionPane& pane) {
    const ReconstructionSettings settings = shared_.possible_reconstruction(pane);
    const std::lock_guard lock(shared_.mutex);
    PaneReconstruction& own = pane.reconstruction;
    if (!pane.needs_reconstruction(shared_.pace, shared_.paused) || !(own.settings == settings))
        return {};
    Task task{pane.latest, settings, pane.rests(shared_.pace, shared_.paused), own.stop.get_token()};
    own.spp = task.snapshot->spp;
    own.since = std::chrono::steady_clock::now();
    own.share = 0;
    if (task.cold)
        own.renewed = task.snapshot->images;
    return task;
}

void ReconstructionWorker::reconstruct(SessionPane& pane, const Task& task) {
    PaneReconstruction& own = pane.reconstruction;
    auto result = std::make_shared<Reconstruction>();
    // These two become the previous ones, which are freed without the lock.
    std::shared_ptr<const GradientImages> made_from = task.snapshot->images;
    std::shared_ptr<const Snapshot> latest;
    std::string failure;
    try {
        *result =
            reconstruct_checked(pane.solver.solver_for(*task.snapshot, task.settings, task.cold),
                                *task.snapshot->images, task.settings, serial_for, 1, {task.stop, &own.share});
    } catch (const std::exception& error) {
        failure = fmt::format("pass {} cannot be reconstructed: {}", task.snapshot->spp, message_of(error));
    }
    {
        const std::lock_guard lock(shared_.mutex);
        own.spp = 0;
        // A newer snapshot of another size or request cannot use this result.
        if (task.stop.stop_requested() || pane.latest->generation != task.snapshot->generation ||
            pane.latest->divisor != task.snapshot->divisor)
            return;
        std::swap(own.made_from, made_from);
        own.made_with = task.settings;
        if (!failure.empty()) {
            shared_.messages.push_back(std::move(failure));
        } else {
            // The render may have continued. Its newest snapshot gets this picture and the number of its pass.
            auto updated = std::make_shared<Snapshot>(*pane.latest);
            updated->reconstruction = std::move(result);
            updated->reconstructed_with = task.settings;
            updated->reconstruction_spp = task.snapshot->spp;
            updated->reconstruction_seconds = task.snapshot->seconds;
            latest = std::exchange(pane.latest, std::move(updated));
        }
    }
    shared_.tell();
}

} // namespace tessera
