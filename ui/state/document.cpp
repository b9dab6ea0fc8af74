#include "ui/state/document.h"

#include "render/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include <glm/common.hpp>

namespace tessera {

namespace {

bool has_small_factors(int n) {
    for (int factor : {2, 3, 5}) {
        while (n % factor == 0)
            n /= factor;
    }
    return n == 1;
}

// The greatest such number up to n.
int smooth_below(int n) {
    while (n > 1 && !has_small_factors(n))
        --n;
    return n;
}

glm::ivec2 within_limits(glm::vec2 size) {
    const glm::ivec2 rounded(glm::round(glm::clamp(size, glm::vec2(1), glm::vec2(most_render_pixels_an_edge))));
    return glm::max(rounded, glm::ivec2(1));
}

glm::ivec2 fitting(glm::ivec2 film_size, glm::ivec2 pane_size, float scale) {
    const glm::vec2 film = glm::max(film_size, glm::ivec2(1));
    const glm::vec2 pane = glm::max(pane_size, glm::ivec2(1));
    const float fit = std::min(pane.x / film.x, pane.y / film.y) * scale;
    const int width = smooth_below(within_limits(glm::floor(film * fit)).x);
    const float height = static_cast<float>(width) * film.y / film.x;
    return within_limits({static_cast<float>(width), std::min(std::round(height), std::ceil(pane.y * scale))});
}

} // namespace

glm::ivec2 render_size(const SizeChoice& choice, glm::ivec2 film_size, glm::ivec2 pane_size) {
    const float scale = std::clamp(choice.scale, 0.01f, 2.0f);
    switch (choice.base) {
    case SizeChoice::Base::pane:
        return fitting(film_size, pane_size, scale);
    case SizeChoice::Base::scene:
        return within_limits(glm::vec2(film_size) * scale);
    case SizeChoice::Base::custom:
        return within_limits(glm::vec2(choice.custom) * scale);
    }
    return {1, 1};
}

namespace {
/// PT and PR above G-PT and G-PR; of fewer panes, the plainest beside what the program is about.
const std::array<Method, 4>& order_of_methods(int count) {
    static constexpr std::array table = {Method::pt, Method::pr, Method::gpt, Method::gpr},
                                few = {Method::pt, Method::gpr, Method::gpt, Method::pr};
    return count == most_panes ? table : few;
}

/// The settings of the active pane, with the first method that no pane has.
PaneSettings new_pane(const Document& document) {
    PaneSettings settings = document.active().settings;
    settings.comparison = {};
    for (const Method method : order_of_methods(0)) {
        if (std::none_of(document.panes.begin(), document.panes.end(),
                         [&](const PaneState& pane) { return pane.settings.render.method == method; })) {
            settings.render.method = method;
            break;
        }
    }
    return settings;
}

/// The least that no pane has.
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
    return pane.generation > 0 && !has_pass && !pane.failed && pane.pass_share > 0;
}

std::vector<PaneSettings> default_panes(int count) {
    std::vector<PaneSettings> panes(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < panes.size(); ++i)
        panes[i].render.method = count == 1 ? Method::gpr : order_of_methods(count)[i];
    return panes;
}

/// Lays panes of four different methods in their order for so many.
static void arrange(Document& document, int count) {
    std::vector<PaneState>& panes = document.panes;
    const auto place = [&](const PaneState& pane) {
        const auto& order = order_of_methods(count);
        return std::find(order.begin(), order.end(), pane.settings.render.method) - order.begin();
    };
    std::array<bool, most_panes> has{};
    for (const PaneState& pane : panes)
        has[static_cast<std::size_t>(place(pane))] = true;
    if (panes.size() != most_panes || std::count(has.begin(), has.end(), true) != most_panes)
        return;
    const std::vector<PaneState> before = panes;
    const int active = document.active().slot;
    std::sort(panes.begin(), panes.end(),
              [&](const PaneState& a, const PaneState& b) { return place(a) < place(b); });
    const auto index_of = [&](int slot) {
        return static_cast<int>(
            std::find_if(panes.begin(), panes.end(), [&](const PaneState& pane) { return pane.slot == slot; }) -
            panes.begin());
    };
    document.active_pane = index_of(active);
    for (PaneState& pane : panes) // what each is compared with moves as well
        if (int& with = pane.settings.comparison.with; with >= 0 && with < most_panes)
            with = index_of(before[static_cast<std::size_t>(with)].slot);
}

void Document::set_pane_count(int count) {
    const auto wanted = static_cast<std::size_t>(std::clamp(count, 1, most_panes));
    if (wanted < panes.size())
        arrange(*this, static_cast<int>(wanted));
    if (active_pane >= static_cast<int>(wanted)) {
        std::swap(panes[static_cast<std::size_t>(active_pane)], panes[wanted - 1]);
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

bool Document::shows_request(std::uint64_t generation) const {
    return std::any_of(panes.begin(), panes.end(),
                       [&](const PaneState& pane) { return pane.generation == generation; });
}

const PaneState* Document::pane_in(int slot) const {
    const auto found =
        std::find_if(panes.begin(), panes.end(), [&](const PaneState& p) { return p.slot == slot; });
    return found == panes.end() ? nullptr : &*found;
}

void Document::set_inspector(bool on) {
    inspector.active = on;
    slow_motion.active = slow_motion.active && !on;
}

void Document::set_slow_motion(bool on) {
    if (on && !slow_motion.active) {
        slow_motion.frames = true;
        slow_motion.held = false;
        slow_motion.sample.reset();
    }
    slow_motion.active = on;
    inspector.active = inspector.active && !on;
}

int Document::compared_with(int pane) const {
    const int count = static_cast<int>(panes.size()),
              with = panes[static_cast<std::size_t>(pane)].settings.comparison.with;
    if (with == the_reference || (count == 1 && companions.reference))
        return the_reference;
    return with >= 0 && with < count && with != pane ? with : (pane + 1) % count;
}

void Document::share_settings() {
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
