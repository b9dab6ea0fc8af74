#include "render/estimator/set_reuse.h"

#include "render/sampling/pass_numbers.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tessera {

namespace {

/// Computes g of theory (20) for a set with several positions: every position that has paths counts for the same
/// number of samples.
void balance_turns(const Pass& pass, SamplingSet& set) {
    std::array<int, edge_positions> turns{};
    for (glm::ivec2 p : set.pixels)
        ++turns[pass.turn(p)];
    const auto taken = static_cast<float>(std::ranges::count_if(turns, [](int n) { return n > 0; }));
    for (std::size_t i = 0; i < set.pixels.size(); ++i)
        set.counts[i] =
            static_cast<float>(set.size()) / (taken * static_cast<float>(turns[pass.turn(set.pixels[i])]));
}

} // namespace

void collect(const Pass& pass, const BaseBlock& block, SamplingSet& set) {
    set.paths.clear();
    set.base.clear();
    set.albedo.clear();
    for (glm::ivec2 p : set.pixels) {
        set.paths.push_back(&block.seen(p.x, p.y));
        set.base.push_back(&block.at(p.x, p.y));
        set.albedo.push_back(pass.albedo_of(*set.paths.back()));
    }
    set.counts.assign(set.pixels.size(), 1);
    if (set.positions > 1)
        balance_turns(pass, set);
    set.radiance.assign(set.pixels.size(), Rgb(0));
    set.reuse.assign(set.pixels.size(), {});
    set.arriving.reset(is_expanded(pass.settings) ? pass.settings.basis : Basis::none, set.albedo);
}

ReuseDecision decide_on_reuse(int k, const ReuseRoulette& roulette, Worker& worker) {
    const BasePath& path = *worker.set.paths[k];
    ReuseDecision decision;
    if (is_black(worker.reuse.shared_light(path))) {
        ++worker.counters.dark_paths;
        return decision;
    }
    decision.survival = roulette.survival(path);
    if (path.random.draw(0, Draw::reuse_survival) < decision.survival)
        decision.scale = 1 / decision.survival;
    ++(decision.survives() ? worker.counters.reused_paths : worker.counters.skipped_paths);
    worker.set.count(decision, k);
    return decision;
}

void reuse_paths(const Pass& pass, RouletteKind kind, Worker& worker) {
    reuse_paths(pass, kind, worker, [](int, const ReuseDecision&) {});
}

} // namespace tessera
