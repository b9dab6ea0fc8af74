#pragma once

#include "render/estimator/pass.h"
#include "render/estimator/reuse_roulette.h"
#include "render/estimator/sampling_set.h"
#include "render/estimator/worker.h"

#include <algorithm>
#include <cstdint>

namespace tessera {

/// Looks up the paths that the pixels of a set see from its current position, and sets all sums to 0.
void collect(const Pass& pass, const BaseBlock& block, SamplingSet& set);

/// Decides by Russian roulette whether base path k of worker.set is reused. Counts the result.
ReuseDecision decide_on_reuse(int k, const ReuseRoulette& roulette, Worker& worker);

/// Estimates the radiance of all pixels of worker.set from the base paths of all of them, theory (9). All pixels
/// must be in worker.base. A set with several positions reuses the base paths whose turn is the current position.
/// @param kind  a path is reused with the probability q of this kind of ReuseRoulette, and weighs 1/q [Bauszat
///              2017, 3.3]
/// @param watch is called as watch(k, decision) after path k; worker.reuse then holds the shifts of this path
template <class Watch>
void reuse_paths(const Pass& pass, RouletteKind kind, Worker& worker, Watch&& watch) {
    SamplingSet& set = worker.set;
    collect(pass, worker.base, set);
    const ReuseRoulette roulette(kind, pass.settings, worker.reuse, set.base);
    worker.reuse.begin(set.paths, set.counts);
    const std::uint64_t rays = worker.counters.offset_work();
    for (int k = 0; k < set.size(); ++k) {
        if (set.positions > 1 && pass.turn(set.pixels[k]) != set.position)
            continue;
        const ReuseDecision decision = decide_on_reuse(k, roulette, worker);
        worker.reuse.share(k, decision.scale, set.radiance, set.arriving.is_kept() ? &set.arriving : nullptr);
        set.count(worker.reuse.outcomes(), k);
        watch(k, decision);
    }
    const int offsets = set.size() * (set.size() - 1);
    set.offset_rays =
        static_cast<float>(worker.counters.offset_work() - rays) / static_cast<float>(std::max(offsets, 1));
}

/// Calls reuse_paths() without an observer.
void reuse_paths(const Pass& pass, RouletteKind kind, Worker& worker);

} // namespace tessera
