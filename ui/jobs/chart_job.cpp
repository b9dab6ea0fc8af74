#include "ui/jobs/chart_job.h"

#include "render/run/thread_pool.h"
#include "ui/state/companions.h"

#include <algorithm>

namespace tessera {

namespace {

/// The picture on show at the end, if it is one: not the primal that stands in for a reconstruction under way.
std::shared_ptr<const void> final_source(const PaneState& pane) {
    const Snapshot* s = pane.snapshot.get();
    if (!s || s->coarse() || s->generation != pane.generation)
        return nullptr;
    std::shared_ptr<const void> source = picture_source(*s, Buffer::reconstruction);
    return has_gradients(s->settings.method) && source != s->reconstruction ? nullptr : source;
}

} // namespace

void ChartJob::update(ViewerState& state, const std::function<void()>& wake) {
    if (auto outcome = job_.poll()) {
        state.redraw = true;
        if (!outcome->result)
            state.add_message(Message::Kind::error, "What charts show was not measured: " + outcome->error);
        else
            for (Measured& measured : *outcome->result)
                take(state, measured);
    }
    for (std::size_t slot = 0; slot < state.charts.size(); ++slot) {
        if (state.pane_in(static_cast<int>(slot)))
            continue;
        state.charts[slot] = {}; // the pane is gone
        done_[slot] = {};
    }
    for (const PaneState& pane : state.panes)
        note_shifts(pane, state.chart_of(pane));
    const bool wants_histograms = state.show_charts || state.large_charts || state.save_charts;
    for (const PaneState& pane : state.panes)
        if (PaneChart& chart = state.chart_of(pane);
            !wants_histograms || (chart.histogram && chart.histogram_generation != pane.generation))
            drop_histogram(pane, chart);
    if (!job_.running())
        start(state, wants_histograms, wake);
    state.histograms_due = wants_histograms && job_.running() &&
                           std::any_of(state.panes.begin(), state.panes.end(), [&](const PaneState& pane) {
                               return final_source(pane) && !state.chart_of(pane).histogram;
                           });
}

/// It is another picture's, or will be: passes go on while nobody looks.
void ChartJob::drop_histogram(const PaneState& pane, PaneChart& chart) {
    chart.histogram = nullptr;
    done_[static_cast<std::size_t>(pane.slot)].histogram = false;
}

void ChartJob::start(const ViewerState& state, bool wants_histograms, const std::function<void()>& wake) {
    std::vector<Measured> work;
    for (const PaneState& pane : state.panes) {
        const auto& reference = state.companions.reference;
        std::shared_ptr<const void> source = final_source(pane);
        Done& done = done_[static_cast<std::size_t>(pane.slot)];
        const bool wants_error = reference && (source != done.source || reference != done.reference);
        const bool wants_histogram = wants_histograms && (source != done.source || !done.histogram);
        if (!source || !(wants_error || wants_histogram))
            continue;
        done = {source, reference, wants_histograms};
        work.push_back({pane.slot, pane.snapshot, std::move(source), reference, wants_histograms});
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
    if (!s || s->coarse() || s->generation != pane.generation || s->counters.shift_attempts() == 0)
        return;
    const auto& points = chart.shifts.points();
    if (!points.empty() && points.back().spp == s->spp)
        return;
    ShiftPoint point{s->spp, s->seconds, {}, s->settings.method};
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
    const auto error = m.reference ? error_to(*m.reference, image) : std::nullopt;
    const bool reconstructed = m.source == s.reconstruction;
    if (error)
        m.point = ErrorPoint{reconstructed ? s.reconstruction_spp : s.spp,
                             reconstructed ? s.reconstruction_seconds : s.seconds, error->relative_mse,
                             error->standard_error, error->not_finite};
}

/// To the line of those made in the same way, which becomes the last.
void ChartJob::add_point(std::vector<ErrorCurve>& curves, const Snapshot& s, const ErrorPoint& point) {
    ErrorCurve curve{s.settings.method, s.reconstructed_with, {}};
    if (!has_gradients(curve.method))
        curve.reconstruction = {Norm::none};
    const auto same = std::find_if(curves.begin(), curves.end(), [&](const ErrorCurve& c) {
        return c.method == curve.method && c.reconstruction == curve.reconstruction;
    });
    if (same != curves.end()) {
        std::rotate(same, same + 1, curves.end());
    } else {
        // A slider of alpha passes by many that nobody is after.
        if (!curves.empty() && curves.back().points().size() == 1 &&
            curves.back().reconstruction.norm == curve.reconstruction.norm)
            curves.pop_back();
        curves.push_back(std::move(curve));
    }
    curves.back().history.add(point);
}

void ChartJob::take(ViewerState& state, Measured& measured) {
    const PaneState* pane = state.pane_in(measured.slot);
    if (!pane || pane->generation != measured.snapshot->generation)
        return; // it has been taken away, or shows something else
    PaneChart& chart = state.chart_of(*pane);
    if (chart.generation != measured.snapshot->generation || chart.reference != measured.reference)
        chart.curves.clear();
    chart.generation = measured.snapshot->generation;
    chart.reference = measured.reference;
    if (measured.point)
        add_point(chart.curves, *measured.snapshot, *measured.point);
    if (measured.histogram) {
        chart.histogram = std::make_shared<const Histogram>(*measured.histogram);
        chart.histogram_generation = pane->generation;
    }
}

} // namespace tessera
