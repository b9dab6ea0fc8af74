#include "render/inspect/inspection.h"
#include "ui/gl/controls.h"
#include "ui/gl/theme.h"
#include "ui/inside/inside.h"
#include "ui/state/words.h"

#include <algorithm>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera {

namespace {

/// Returns the number of other base paths of a set from which a pixel receives radiance.
long count_arrived(const InspectedSet& set, glm::ivec2 pixel) {
    const std::vector<const InspectedShift*> arriving = set.to(pixel);
    return std::count_if(arriving.begin(), arriving.end(),
                         [](const InspectedShift* s) { return s->from != s->to && !is_black(s->value); });
}

std::string reuse_text(const ReuseDecision& own) {
    return std::string(", its own path ") + (own.is_dark() ? "is dark"
                                             : own.survives()
                                                 ? "is reused x " + short_text(own.scale)
                                                 : "is not reused (q = " + short_text(own.survival) + ")");
}

std::string sets_text(const Inspection& i) {
    long arrived = 0, others = 0;
    for (const InspectedSet& set : i.sets) {
        arrived += count_arrived(set, i.pixel);
        others += set.size() - 1;
    }
    const std::string value = "pixel value " + short_text(i.shared_radiance());
    const std::string set_count = std::to_string(i.sets.size());
    if (others == 0)
        return "no path reuse; " + value + (i.sets.size() > 1 ? " (mean of " + set_count + " own paths)" : "");
    const std::string text = std::to_string(arrived) + " of " + std::to_string(others) +
                             (arrived == 1 ? " neighbour paths contributes; " : " neighbour paths contribute; ") +
                             value;
    if (i.sets.size() > 1)
        return text + " (mean of " + set_count + " sets)";
    return text + reuse_text(i.sets[0].base(i.sets[0].index_of(i.pixel)).reuse);
}

std::string headline(const Inspection& i) {
    std::string line = std::string(paper_name(i.method)) + "   pixel (" + short_text(i.pixel) + ")   pass " +
                       std::to_string(i.pass) + "   own path " + short_text(i.radiance);
    if (!is_black(i.very_direct))
        line += " and directly visible emission " + short_text(i.very_direct);
    if (!i.sets.empty() && i.method != Method::pt)
        line += "   |   " + sets_text(i);
    return line + (i.is_invalid ? "   INVALID SAMPLE: not finite" : "");
}

/// Returns the text that is shown while there is no inspection.
const char* waiting_text(const Inspector& inspector) {
    return !inspector.sample        ? "click on a pixel"
           : inspector.sample->pass ? "replaying the earlier passes ..."
                                    : "waiting for the first whole pass";
}

/// @param is_elsewhere  no pane shows the request of the inspection
void draw_top_row(Controls& controls, Inspector& inspector, bool is_elsewhere) {
    static const std::vector<ChoiceItem> directions = choice_items(words::directions);
    int direction = static_cast<int>(inspector.direction);
    const std::string& shown = directions[static_cast<std::size_t>(direction)].label;
    if (controls.bare_choice("inspector.direction", shown.c_str(), directions, direction,
                             ImGui::GetFontSize() * 13, "Which shifts are drawn and listed.")) {
        inspector.direction = static_cast<Inspector::Direction>(direction);
        inspector.chosen = -1;
    }
    ImGui::SameLine();
    bool follows = inspector.follows;
    if (ImGui::Checkbox("follow", &follows))
        inspector.follow(follows);
    controls.place(
        "inspector.follow",
        inspector.sample && inspector.sample->pass
            ? "The inspector shows this sample of a given pass. Check this to follow the newest pass of its "
              "pixel in the pane."
            : "Always shows the newest pass. Otherwise, shows the pass that was the newest "
              "when the pixel was chosen.");
    ImGui::SameLine();
    if (controls.button("inspector.close", "Close", "Ends the path inspector (I)."))
        inspector.active = false;
    ImGui::SameLine();
    if (inspector.inspection)
        ImGui::TextUnformatted(
            ((is_elsewhere ? "of another picture:   " : "") + headline(*inspector.inspection)).c_str());
    else
        ImGui::TextDisabled("%s", waiting_text(inspector));
}

} // namespace

void draw_inspector_panel(const ScreenRect& where, Controls& controls, ViewerState& state) {
    Inspector& inspector = state.inspector;
    ImGui::SetNextWindowPos({where.min.x, where.min.y});
    ImGui::SetNextWindowSize({where.size().x, where.size().y});
    if (ImGui::Begin("Path inspector", nullptr, overlay_flags | ImGuiWindowFlags_NoScrollWithMouse)) {
        draw_top_row(controls, inspector, !state.shows_request(inspector.generation));
        if (inspector.inspection) {
            const ImVec2 room = ImGui::GetContentRegionAvail();
            const float gap = ImGui::GetStyle().ItemSpacing.x;
            const float space = std::min(room.y * 1.5f, room.x * 0.3f), rest = room.x - space - 2 * gap;
            draw_vertex_table(inspector, rest * 0.52f, controls);
            ImGui::SameLine();
            draw_shift_table(inspector, rest * 0.48f, controls);
            ImGui::SameLine();
            const SpaceSubject subject{inspector.inspection->path, shown_shifts(inspector), inspector.shown_row(),
                                       inspector.scene_radius};
            draw_space_view({space, room.y}, subject, state.space, controls);
        }
    }
    ImGui::End();
}

} // namespace tessera
