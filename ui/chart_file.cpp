#include "ui/chart_file.h"

#include <fmt/core.h>

namespace tessera {

std::string chart_csv(const ViewerState& state) {
    std::string text = "pane,method,norm,spp,seconds,relMSE\n";
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        const PaneSettings& settings = state.panes[i].settings;
        for (const ErrorPoint& p : state.charts[i].errors.points())
            text += fmt::format("{},{},{},{},{:.6g},{:.7g}\n", i + 1, short_name(settings.render.method),
                                has_gradients(settings.render.method) ? to_string(settings.reconstruction.norm)
                                                                      : "none",
                                p.spp, p.seconds, p.error);
    }
    const auto& histogram = state.charts[static_cast<std::size_t>(state.active_pane)].histogram;
    if (!histogram)
        return text;
    text += "\nluminance,pixels\n";
    for (int bin = 0; bin < Histogram::bin_count; ++bin)
        text +=
            fmt::format("{:.6g},{}\n", Histogram::low_end(bin), histogram->bins[static_cast<std::size_t>(bin)]);
    return text;
}

} // namespace tessera
