// The session's second thread: pictures from primal and gradients, the newest snapshot first.
#include "render/session/session_pane.h"
#include "render/session/thread_priority.h"

#include <utility>

#include <fmt/core.h>

namespace tessera {

void Session::reconstruct_loop(std::stop_token stop) {
    work_in_background();
    std::size_t turn = 0; // panes in turn, so that none starves
    while (!stop.stop_requested()) {
        Pane* pane = nullptr;
        std::shared_ptr<const Snapshot> snapshot;
        ReconstructionSettings settings;
        std::stop_token solve_stop;
        {
            std::unique_lock lock(mutex_);
            const auto find = [&] {
                for (std::size_t i = 0; i < panes_.size() && !pane; ++i) {
                    Pane* candidate = panes_[(turn + i) % panes_.size()].get();
                    if (candidate->needs_reconstruction())
                        pane = candidate;
                }
                return pane != nullptr;
            };
            if (!reconstruct_wake_.wait(lock, stop, find))
                return;
            ++turn;
            snapshot = pane->latest;
            settings = pane->reconstruction;
            solve_stop = pane->solve_stop.get_token();
            pane->solving_spp = snapshot->spp;
            pane->solving_since = std::chrono::steady_clock::now();
            pane->solving_share = 0;
        }
        reconstruct_snapshot(*pane, *snapshot, settings, solve_stop);
    }
}

void Session::reconstruct_snapshot(Pane& pane, const Snapshot& snapshot, const ReconstructionSettings& settings,
                                   std::stop_token stop) {
    auto result = std::make_shared<Reconstruction>();
    std::shared_ptr<const GradientImages> reconstructed = snapshot.images; // and then the one before
    std::shared_ptr<const Snapshot> latest;
    std::string failure;
    try {
        *result = pane.solver_for(snapshot, settings)
                      .reconstruct(*snapshot.images, settings, serial_for, {stop, &pane.solving_share});
    } catch (const std::exception& error) {
        failure = fmt::format("reconstruction of pass {}: {}", snapshot.spp, error.what());
    }
    {
        const std::lock_guard lock(mutex_);
        pane.solving_spp = 0;
        // A newer picture of another size or request has no use for this one.
        if (stop.stop_requested() || pane.latest->generation != snapshot.generation ||
            pane.latest->divisor != snapshot.divisor)
            return;
        std::swap(pane.reconstructed, reconstructed);
        pane.reconstructed_with = settings;
        if (!failure.empty()) {
            messages_.push_back(std::move(failure));
        } else {
            // The render may have gone on meanwhile: the newest snapshot gets this picture, labelled with its
            // pass.
            auto updated = std::make_shared<Snapshot>(*pane.latest);
            updated->reconstruction = std::move(result);
            updated->reconstructed_with = settings;
            updated->reconstruction_spp = snapshot.spp;
            updated->reconstruction_seconds = snapshot.seconds;
            latest = std::exchange(pane.latest, std::move(updated));
        }
    }
    tell();
}

} // namespace tessera
