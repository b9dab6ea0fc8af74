#include "ui/state/pane_set.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace tessera {

namespace {

/// Returns the methods of `count` panes: all four in the order of the table, or for fewer panes the most different
/// methods first.
const std::array<Method, 4>& order_of_methods(int count) {
    static constexpr std::array table = {Method::pt, Method::pr, Method::gpt, Method::gpr},
                                few = {Method::pt, Method::gpr, Method::gpt, Method::pr};
    return count == most_panes ? table : few;
}

/// Returns the settings of the active pane, with the first method that no pane has.
PaneSettings new_pane(const PaneSet& set) {
    PaneSettings settings = set.active().settings;
    settings.comparison = {};
    for (const Method method : order_of_methods(0)) {
        if (std::none_of(set.panes.begin(), set.panes.end(),
                         [&](const PaneState& pane) { return pane.settings.render.method == method; })) {
            settings.render.method = method;
            break;
        }
    }
    return settings;
}

/// Returns the smallest slot that no pane has.
int free_slot(const std::vector<PaneState>& panes) {
    const auto is_taken = [&](int slot) {
        return std::any_of(panes.begin(), panes.end(), [&](const PaneState& p) { return p.slot == slot; });
    };
    int slot = 0;
    while (is_taken(slot))
        ++slot;
    return slot;
}

} // namespace

bool is_in_long_first_pass(const PaneState& pane) {
    const Snapshot* s = pane.snapshot.get();
    const bool has_pass = s && s->generation == pane.generation && !s->coarse();
    return pane.generation > 0 && !has_pass && !pane.failed && pane.pass_progress > 0;
}

Norm applied_norm(const PaneSettings& pane) {
    return applied(pane.reconstruction.norm, has_gradients(pane.render.method));
}

std::vector<PaneSettings> default_panes(int count) {
    std::vector<PaneSettings> panes(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < panes.size(); ++i)
        panes[i].render.method = count == 1 ? Method::gpr : order_of_methods(count)[i];
    return panes;
}

/// Sorts panes of four different methods into the order of a layout with `count` panes.
static void arrange(PaneSet& set, int count) {
    std::vector<PaneState>& panes = set.panes;
    const auto place = [&](const PaneState& pane) {
        const auto& order = order_of_methods(count);
        return std::find(order.begin(), order.end(), pane.settings.render.method) - order.begin();
    };
    std::array<bool, most_panes> has{};
    for (const PaneState& pane : panes)
        has[place(pane)] = true;
    if (panes.size() != most_panes || std::count(has.begin(), has.end(), true) != most_panes)
        return;
    const std::vector<PaneState> before = panes;
    const int active = set.active().slot;
    std::sort(panes.begin(), panes.end(),
              [&](const PaneState& a, const PaneState& b) { return place(a) < place(b); });
    const auto index_of = [&](int slot) {
        return static_cast<int>(
            std::find_if(panes.begin(), panes.end(), [&](const PaneState& pane) { return pane.slot == slot; }) -
            panes.begin());
    };
    set.active_pane = index_of(active);
    for (PaneState& pane : panes) // updates the indices of compared panes
        if (int& with = pane.settings.comparison.with; with >= 0 && with < most_panes)
            with = index_of(before[with].slot);
}

void PaneSet::set_pane_count(int count) {
    const auto wanted = static_cast<std::size_t>(std::clamp(count, 1, most_panes));
    if (wanted < panes.size())
        arrange(*this, static_cast<int>(wanted));
    if (active_pane >= static_cast<int>(wanted)) {
        std::swap(panes[active_pane], panes[wanted - 1]);
        active_pane = static_cast<int>(wanted) - 1;
    }
    while (panes.size() > wanted) {
        spare_panes.push_back(panes.back().settings);
        panes.pop_back();
    }
    while (panes.size() < wanted) {
        PaneState pane;
        pane.settings = spare_panes.empty() ? new_pane(*this) : spare_panes.back();
        pane.canvas_size = active().canvas_size;
        pane.slot = free_slot(panes);
        if (!spare_panes.empty())
            spare_panes.pop_back();
        panes.push_back(std::move(pane));
        arrange(*this, static_cast<int>(wanted));
    }
    share_settings();
}

bool PaneSet::shows_request(std::uint64_t generation) const {
    return std::any_of(panes.begin(), panes.end(),
                       [&](const PaneState& pane) { return pane.generation == generation; });
}

const PaneState* PaneSet::pane_in(int slot) const {
    const auto found =
        std::find_if(panes.begin(), panes.end(), [&](const PaneState& p) { return p.slot == slot; });
    return found == panes.end() ? nullptr : &*found;
}

void PaneSet::share_settings() {
    if (!linked)
        return;
    const PaneSettings shared = active().settings;
    for (PaneState& pane : panes) {
        const Method method = pane.settings.render.method;
        pane.settings.render = shared.render;
        pane.settings.render.method = method;
        pane.settings.reconstruction = shared.reconstruction;
    }
}

} // namespace tessera
