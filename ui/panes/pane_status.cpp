#include "ui/gl/controls.h"
#include "ui/gl/theme.h"
#include "ui/gl/tone.h"
#include "ui/panes/pane_parts.h"
#include "ui/state/inspected.h"
#include "ui/state/pane_labels.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <glm/vec2.hpp>
#include <imgui.h>

namespace tessera {

namespace {

// Minimum lead of a pane that waits. Panes that take turns differ by less.
constexpr double least_wait = 2; // seconds
constexpr double least_wait_spp = 3;

bool is_done(const Snapshot& snapshot, const Pace& pace) {
    return (pace.spp_limit > 0 && snapshot.spp >= pace.spp_limit) ||
           (pace.seconds_limit > 0 && snapshot.seconds >= pace.seconds_limit);
}

/// Returns the pane's snapshot of the present request; null: there is none, or only a preview.
const Snapshot* snapshot_of_request(const PaneState& pane) {
    const Snapshot* s = pane.snapshot.get();
    return s && s->generation == pane.generation && !s->coarse() ? s : nullptr;
}

/// Whether the pane renders no further passes.
bool is_at_rest(const PaneState& pane, const Pace& pace) {
    const Snapshot* s = snapshot_of_request(pane);
    return pane.failed || (s && is_done(*s, pace));
}

/// Returns "reconstruction of pass 11, 14 steps in 0.021 s".
std::string reconstruction_text(const Snapshot& snapshot) {
    const Reconstruction& made = *snapshot.reconstruction;
    char text[96];
    std::snprintf(text, sizeof text, "reconstruction of pass %d, %d step%s in %.2g s", snapshot.reconstruction_spp,
                  made.iterations, made.iterations == 1 ? "" : "s", made.seconds);
    return text;
}

/// Returns "relMSE 0.0123", measured for the newest picture, or without a reference "estimated relMSE 0.0123".
/// Empty: there is no error yet.
std::string error_text(const ViewerState& state, const PaneState& pane) {
    const PaneChart& chart = state.charts.of(pane);
    if (chart.curves.empty() || chart.generation != pane.generation ||
        chart.reference != state.companions.reference)
        return "";
    return fmt::format("{} {:.3g}", chart.reference ? "relMSE" : "estimated relMSE",
                       chart.curves.back().points().back().error);
}

/// Returns "reconstructing pass 12, 40 %, 1.3 s (Esc ends it)"; without a percentage before the first step.
std::string under_way_text(const RunningReconstruction& now) {
    char share[16] = "", text[96];
    if (now.share > 0)
        std::snprintf(share, sizeof share, " %.0f %%,", 100.0 * static_cast<double>(now.share));
    std::snprintf(text, sizeof text, "reconstructing pass %d,%s %.1f s (Esc ends it)", now.spp, share,
                  now.seconds);
    return text;
}

/// An item of the status line.
struct StatusItem {
    const char* label; ///< in the tooltip; empty: `text` needs none
    std::string text;
};

/// Returns the pane's state for the status line; empty: it renders.
std::string activity_text(const ViewerState& state, int index, bool is_answered) {
    const PaneState& pane = state.panes[index];
    if (pane.failed)
        return "failed: see the messages (F2)";
    if (state.rendering.paused)
        return "paused";
    if (is_in_long_first_pass(pane))
        return fmt::format("{} {} %", is_answered ? "first pass" : "preview",
                           static_cast<int>(100 * pane.pass_progress));
    if (!is_answered)
        return "starting";
    if (is_done(*pane.snapshot, state.rendering.pace))
        return "done";
    return waiting_text(state, index);
}

/// Returns the items of the status line in order. The state comes first, because a narrow pane cuts off the end.
std::vector<StatusItem> status_items(const ViewerState& state, int index) {
    const PaneState& pane = state.panes[index];
    std::vector<StatusItem> items{{"Method", pane_label(state, index)}};
    const auto add = [&](const char* label, std::string text) {
        if (!text.empty())
            items.push_back({label, std::move(text)});
    };
    const bool reconstructs_long = state.reconstructs_long(pane);
    const bool is_answered = pane.snapshot && pane.snapshot->generation == pane.generation;
    if (!state.scene) {
        add("State", state.scene_info.loading.empty() ? "no scene" : "waiting for the scene");
        return items;
    }
    add("State", activity_text(state, index, is_answered));
    if (!is_answered)
        return items;
    if (reconstructs_long)
        add("Reconstruction", under_way_text(*pane.reconstructing));
    const Snapshot& snapshot = *pane.snapshot;
    const double rate =
        snapshot.seconds > 0 ? static_cast<double>(snapshot.counters.all_rays()) / snapshot.seconds : 0;
    add("Samples per pixel", fmt::format("{} spp", snapshot.spp));
    add("Wall time of this pane's passes", fmt::format("{:.2f} s", snapshot.seconds));
    add("Rays per second", fmt::format("{:.1f} Mrays/s", rate * 1e-6));
    add("Error", error_text(state, pane));
    if (snapshot.coarse())
        add("Picture", "preview");
    else if (!reconstructs_long && snapshot.reconstruction &&
             applied(snapshot.reconstructed_with.norm, has_gradients(snapshot.settings.method)) != Norm::none)
        add("Reconstruction (pass, solver steps, wall time)", reconstruction_text(snapshot));
    if (const double redistributed =
            snapshot.reconstruction && !snapshot.coarse() ? snapshot.reconstruction->redistributed : 0;
        redistributed > 0)
        add("", fmt::format("fireflies: {:.3g} % redistributed", 100 * redistributed));
    if (snapshot.counters.invalid_samples > 0)
        add("NaN or infinite", fmt::format("{} invalid samples", snapshot.counters.invalid_samples));
    return items;
}

} // namespace

std::string status_text(const ViewerState& state, int pane) {
    std::string line;
    for (const StatusItem& item : status_items(state, pane))
        line += (line.empty() ? "" : "   ") + item.text;
    return line;
}

std::string status_help(const ViewerState& state, int pane) {
    std::string lines;
    for (const StatusItem& item : status_items(state, pane))
        lines +=
            fmt::format("{}{}{}{}", lines.empty() ? "" : "\n", item.label, *item.label ? ": " : "", item.text);
    return lines;
}

std::string waiting_text(const ViewerState& state, int pane) {
    if (state.rendering.paused)
        return "";
    const bool by_time = state.rendering.pace.equal == Pace::Equal::time;
    const auto had = [&](const PaneState& p) {
        const Snapshot* s = snapshot_of_request(p);
        return !s ? 0.0 : by_time ? s->seconds : s->spp;
    };
    const auto last =
        std::min_element(state.panes.begin(), state.panes.end(), [&](const PaneState& a, const PaneState& b) {
            return std::pair(is_at_rest(a, state.rendering.pace), had(a)) <
                   std::pair(is_at_rest(b, state.rendering.pace), had(b));
        });
    const double own = had(state.panes[pane]);
    if (is_at_rest(*last, state.rendering.pace) || own - had(*last) < (by_time ? least_wait : least_wait_spp))
        return "";
    return fmt::format("equal {}: waiting for pane {} ({} of {} {})", by_time ? "time" : "samples",
                       last - state.panes.begin() + 1, static_cast<int>(had(*last)), static_cast<int>(own),
                       by_time ? "s" : "spp");
}

std::string value_text(const Rgb& value, ColourMap map, const BufferInfo& about) {
    char text[128];
    if (map == ColourMap::false_colour)
        std::snprintf(text, sizeof text, "%.4g %s", static_cast<double>(value.r * about.unit_scale), about.unit);
    else if (map == ColourMap::direction)
        std::snprintf(text, sizeof text, "%+.3f %+.3f %+.3f", static_cast<double>(value.x),
                      static_cast<double>(value.y), static_cast<double>(value.z));
    else
        std::snprintf(text, sizeof text, "%.4g %.4g %.4g  Y %.4g", static_cast<double>(value.r),
                      static_cast<double>(value.g), static_cast<double>(value.b),
                      static_cast<double>(luminance(value)));
    return text;
}

std::string cursor_text(const ViewerState& state, const PaneImages& images, int pane) {
    if (!state.layout.cursor)
        return "";
    const glm::vec2 place = state.layout.cursor->place;
    const Showing showing = showing_at(state, pane, state.layout.cursor->share);
    const std::optional<Rgb> value = value_at(showing, images, place);
    if (!value)
        return "";
    const PaneImage& image = images[showing.pane];
    const glm::vec2 size = image.coarse() ? glm::vec2(state.request_size())
                                          : glm::vec2(image.pixels().width(), image.pixels().height());
    char where[48];
    std::snprintf(where, sizeof where, "(%d, %d)  ", static_cast<int>(place.x * size.x),
                  static_cast<int>(place.y * size.y));
    const ReuseCounts* outcomes = showing.subtrahend < 0 ? image.outcomes_at(place) : nullptr;
    return where + (outcomes ? outcome_shares(*outcomes)
                             : value_text(*value, colour_map(showing, state), info(image.buffer())));
}

std::string cursor_help(const Showing& showing, const ViewerState& state) {
    const BufferInfo& about = info(buffer_of(showing.pane, state));
    std::string numbers = "its red, green and blue, and its luminance (Y)";
    if (colour_map(showing, state) == ColourMap::false_colour)
        numbers = "its value" + (*about.unit ? " in " + std::string(about.unit) : "");
    else if (colour_map(showing, state) == ColourMap::direction)
        numbers = "its x, y and z";
    else if (colour_map(showing, state) == ColourMap::own)
        numbers = "the percentages of outcomes of the shifts to it, the largest first";
    return "Pixel under the mouse, counted from the top left, and " + numbers + ".\n\n" +
           (showing.subtrahend >= 0 ? label_of(showing, state) + ": difference of their values.\n\n" : "") +
           about.label + ": " + about.help;
}

void draw_status(const std::string& id, int pane, const ViewerState& state, const PaneImages& images,
                 Controls& controls) {
    const std::string status = status_text(state, pane);
    const std::string cursor = cursor_text(state, images, pane);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float room = std::max(ImGui::GetContentRegionAvail().x, 1.0f), height = ImGui::GetTextLineHeight();
    ImGui::PushFont(mono_font());
    const float width = cursor.empty() ? 0 : ImGui::CalcTextSize(cursor.c_str()).x;
    ImGui::PopFont();

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float left = std::max(at.x + room - width, at.x); // of the cursor text
    list.PushClipRect(at, {cursor.empty() ? at.x + room : left - height * 0.5f, at.y + height * 1.3f}, true);
    list.AddText(at, colours::dim_text, status.c_str());
    list.PopClipRect();
    if (!cursor.empty())
        list.AddText(mono_font(), ImGui::GetFontSize(), {left, at.y}, colours::text, cursor.c_str());

    ImGui::Dummy({room, height});
    controls.place((id + ".status").c_str(), status_help(state, pane).c_str());
    if (cursor.empty())
        return;
    ImGui::SetCursorScreenPos({left, at.y});
    ImGui::Dummy({std::min(width, room), height});
    const Showing showing = showing_at(state, pane, state.layout.cursor->share);
    controls.place((id + ".value").c_str(), cursor_help(showing, state).c_str());
}

} // namespace tessera
