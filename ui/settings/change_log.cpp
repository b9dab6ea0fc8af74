#include "render/inspect/inspection.h"
#include "render/settings/settings_table.h"
#include "ui/settings/settings_file.h"
#include "ui/state/words.h"

#include <cstdio>
#include <filesystem>
#include <utility>

#include <glm/vec3.hpp>

namespace tessera {

namespace {

using Values = std::map<std::string, std::string>;

std::string text(double number) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", number);
    return buffer;
}

std::string text(bool on) {
    return on ? "on" : "off";
}

void describe(const std::string& prefix, const PaneState& pane, Values& values) {
    PaneSettings settings = pane.settings;
    values[prefix + "method"] = short_name(settings.render.method);
    values[prefix + "buffer"] = short_name(pane.settings.buffer);
    for (const Setting& setting : shared_settings_of(settings))
        values[prefix + std::string(setting.id)] = setting.text();
    values[prefix + "comparison"] = word(words::comparisons, pane.settings.comparison.kind);
    values[prefix + "generation"] = std::to_string(pane.generation);
    values[prefix + "shows"] =
        pane.snapshot ? std::to_string(pane.snapshot->generation) + (pane.snapshot->coarse() ? " coarsely" : "")
                      : "nothing";
    values[prefix + "spp"] = std::to_string(pane.snapshot ? pane.snapshot->spp : 0);
}

Values describe(const ViewerState& state) {
    Values values;
    for (std::size_t i = 0; i < state.panes.size(); ++i)
        describe("pane " + std::to_string(i) + " ", state.panes[i], values);
    const glm::vec3 p = state.camera.position(), f = state.camera.forward();
    char camera[160];
    std::snprintf(camera, sizeof camera, "%.5g %.5g %.5g toward %.5g %.5g %.5g", static_cast<double>(p.x),
                  static_cast<double>(p.y), static_cast<double>(p.z), static_cast<double>(f.x),
                  static_cast<double>(f.y), static_cast<double>(f.z));
    values["camera"] = camera;
    const glm::ivec2 size = state.request_size();
    values["size"] = std::to_string(size.x) + "x" + std::to_string(size.y);
    values["exposure"] = text(static_cast<double>(state.display.tone.exposure));
    values["difference exposure"] = text(static_cast<double>(state.display.tone.difference_exposure));
    values["tone"] = word(words::tones, state.display.tone.curve);
    values["panes"] = std::to_string(state.panes.size());
    values["active"] = std::to_string(state.active_pane);
    values["alone"] = text(state.layout.alone);
    values["wipe"] = text(static_cast<double>(state.layout.wipe));
    values["flicker"] = text(state.layout.flicker);
    values["theme"] = word(words::themes, state.layout.theme);
    values["ui scale"] = text(static_cast<double>(state.layout.ui_scale()));
    values["magnifier"] = text(state.display.magnifier);
    values["charts"] = text(state.layout.show_charts);
    values["tiles"] = text(state.display.show_tiles);
    values["inspector"] = text(state.inspector.active);
    if (const auto& sample = state.inspector.sample) {
        const PaneState* pane = state.pane_in(sample->slot);
        values["inspected"] = "pane " + (pane ? std::to_string(pane - state.panes.data()) : "none") + " pixel " +
                              std::to_string(sample->pixel.x) + " " + std::to_string(sample->pixel.y) +
                              (sample->pass ? " pass " + std::to_string(*sample->pass) : "");
    }
    if (const auto& found = state.inspector.inspection)
        values["inspection"] = std::string(short_name(found->method)) + " pixel " +
                               std::to_string(found->pixel.x) + " " + std::to_string(found->pixel.y) + " pass " +
                               std::to_string(found->pass) + (found->is_invalid ? " refused" : "");
    const auto& reference = state.companions.reference;
    values["reference"] = reference ? std::filesystem::path(reference->name).filename().string() : "none";
    values["slow motion"] = text(state.slow_motion.active);
    if (state.slow_motion.active && state.slow_motion.tile)
        values["slow motion at"] = "tile " + std::to_string(state.slow_motion.tile->tile.x0) + " " +
                                   std::to_string(state.slow_motion.tile->tile.y0) + " path " +
                                   std::to_string(state.slow_motion.current);
    values["spp limit"] = std::to_string(state.rendering.pace.spp_limit);
    values["seconds limit"] = text(state.rendering.pace.seconds_limit);
    values["equal"] = word(words::shares, state.rendering.pace.equal);
    values["zoom"] = text(static_cast<double>(state.display.view.zoom()));
    values["linked"] = text(state.linked);
    values["paused"] = text(state.rendering.paused);
    values["help"] = text(state.layout.show_help);
    values["panel"] = text(state.layout.show_panel);
    values["statistics"] = text(state.layout.show_statistics);
    values["scene"] = state.scene_info.name;
    values["scenes shown"] = std::to_string(state.scene_info.shown);
    values["loading"] = state.scene_info.loading;
    values["messages"] = std::to_string(state.messages.size());
    return values;
}

} // namespace

void ChangeLog::write_state(const ViewerState& state, const Sink& sink) {
    Values now = describe(state);
    for (const auto& [name, value] : now) {
        const auto before = values_.find(name);
        if (before == values_.end() || before->second != value)
            sink(name + " " + value);
    }
    values_ = std::move(now);
}

void ChangeLog::write_controls(const Controls& controls, const Sink& sink) {
    for (const auto& [id, rect] : controls.rects()) {
        const auto before = rects_.find(id);
        if (before != rects_.end() && before->second == rect)
            continue;
        char line[64];
        std::snprintf(line, sizeof line, " %.0f %.0f %.0f %.0f", static_cast<double>(rect.min.x),
                      static_cast<double>(rect.min.y), static_cast<double>(rect.max.x),
                      static_cast<double>(rect.max.y));
        sink("control " + id + line);
    }
    rects_ = controls.rects();
}

} // namespace tessera
