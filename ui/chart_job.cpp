#include "ui/chart_job.h"

#include "recon/metrics.h"
#include "render/session/thread_priority.h"

#include <cmath>

namespace tessera {

namespace {

/// The picture on show at the end, if it is one: not the primal that stands in for a reconstruction under way.
std::shared_ptr<const void> final_source(const PaneState& pane) {
    const Snapshot* s = pane.snapshot.get();
    if (!s || s->coarse || s->generation != pane.generation)
        return nullptr;
    std::shared_ptr<const void> source = picture_source(*s, Buffer::reconstruction);
    return has_gradients(s->settings.method) && source != s->reconstruction ? nullptr : source;
}

} // namespace

void ChartJob::update(ViewerState& state, const std::function<void()>& wake) {
    if (auto outcome = job_.poll(); outcome && outcome->result)
        for (Measured& measured : *outcome->result)
            take(state, measured);
    for (std::size_t i = 0; i < state.panes.size(); ++i)
        note_shifts(state.panes[i], state.charts[i]);
    for (std::size_t i = state.panes.size(); i < state.charts.size(); ++i) {
        state.charts[i] = {}; // the pane is gone
        done_[i] = {};
    }
    if (job_.running())
        return;
    const bool wants_histograms = state.show_charts || state.large_charts || state.save_charts;
    std::vector<Measured> work;
    for (std::size_t i = 0; i < state.panes.size(); ++i) {
        const auto& reference = state.companions.reference;
        std::shared_ptr<const void> source = final_source(state.panes[i]);
        Done& done = done_[i];
        const bool wants_error = reference && (source != done.source || reference != done.reference);
        const bool wants_histogram = wants_histograms && (source != done.source || !done.histogram);
        if (!source || !(wants_error || wants_histogram))
            continue;
        done = {source, reference, wants_histograms};
        work.push_back({i, state.panes[i].snapshot, std::move(source), reference, wants_histograms});
    }
    if (work.empty())
        return;
    job_.start(
        [work = std::move(work)](std::stop_token) mutable {
            work_in_background();
            for (Measured& picture : work)
                measure(picture);
            return std::move(work);
        },
        wake);
}

void ChartJob::note_shifts(const PaneState& pane, PaneChart& chart) {
    if (chart.shift_generation != pane.generation)
        chart.shifts.clear();
    chart.shift_generation = pane.generation;
    const Snapshot* s = pane.snapshot.get();
    if (!s || s->coarse || s->generation != pane.generation || s->counters.shift_attempts() == 0)
        return;
    const auto& points = chart.shifts.points();
    if (!points.empty() && points.back().spp == s->spp)
        return;
    ShiftPoint point{s->spp, s->seconds, {}};
    const auto all = static_cast<double>(s->counters.shift_attempts());
    for (std::size_t i = 0; i < point.shares.size(); ++i)
        point.shares[i] = static_cast<double>(s->counters.shifts[i]) / all;
    chart.shifts.add(point);
}

void ChartJob::measure(Measured& m) {
    const Snapshot& s = *m.snapshot;
    RgbImage scratch;
    const RgbImage& image = picture(s, Buffer::reconstruction, scratch);
    if (m.wants_histogram)
        m.histogram = histogram_of(image);
    if (!m.reference || m.reference->image.width() != image.width() ||
        m.reference->image.height() != image.height())
        return;
    const double error = measure_error(image, m.reference->image).relative_mse;
    const bool reconstructed = m.source == s.reconstruction;
    if (std::isfinite(error))
        m.point = ErrorPoint{reconstructed ? s.reconstruction_spp : s.spp,
                             reconstructed ? s.reconstruction_seconds : s.seconds, error};
}

void ChartJob::take(ViewerState& state, Measured& measured) {
    if (measured.pane >= state.panes.size())
        return; // it has been taken away
    PaneChart& chart = state.charts[measured.pane];
    if (chart.generation != measured.snapshot->generation || chart.reference != measured.reference)
        chart.errors.clear();
    chart.generation = measured.snapshot->generation;
    chart.reference = measured.reference;
    if (measured.point)
        chart.errors.add(*measured.point);
    if (measured.histogram)
        chart.histogram = std::make_shared<const Histogram>(*measured.histogram);
}

} // namespace tessera
