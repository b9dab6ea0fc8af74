#include "recon/metrics/sample_error.h"
#include "render/run/thread_pool.h"
#include "render/settings/settings_table.h"
#include "ui/jobs/jobs.h"
#include "ui/state/companions.h"

#include <algorithm>

namespace tessera {

namespace {

/// Returns the settings of raw samples, for which the error is estimated if there is no reference.
ReconstructionSettings raw_samples() {
    ReconstructionSettings settings;
    settings.norm = Norm::none;
    return settings;
}

/// Returns the identity of the pane's picture. Null: the pane shows a preview, an old request, or the primal
/// image because its reconstruction is not complete.
std::shared_ptr<const void> complete_picture(const PaneState& pane) {
    const Snapshot* s = pane.snapshot.get();
    if (!s || s->coarse() || s->generation != pane.generation)
        return nullptr;
    std::shared_ptr<const void> source = picture_source(*s, Buffer::reconstruction);
    return source == s->reconstruction ? source : nullptr;
}

/// Whether the newest estimate has nearly as many samples. Another estimate would take time from the render for
/// little information.
bool has_close_estimate(const PaneChart& chart, const Snapshot* s) {
    constexpr double min_ratio = 1.04; // of samples, as in PassHistory
    return s && chart.generation == s->generation && !chart.reference && !chart.curves.empty() &&
           s->spp < min_ratio * chart.curves.back().points().back().spp;
}

} // namespace

void ChartJob::update(ViewerState& state, const std::function<void()>& wake) {
    for (std::size_t slot = 0; slot < jobs_.size(); ++slot)
        take(state, slot);
    const bool wants_histograms = state.layout.shows_charts() || state.wishes.saves.has(SaveKind::charts);
    state.charts.histograms_due = false;
    for (const PaneState& pane : state.panes) {
        Job& job = jobs_[pane.slot];
        PaneChart& chart = state.charts.of(pane);
        add_shifts(pane, chart);
        // Drops a histogram of another request, and one that nobody looks at, because it would become outdated.
        if (chart.histogram && !(wants_histograms && chart.histogram_generation == pane.generation)) {
            chart.histogram = nullptr;
            if (!job.running())
                job.cancel(); // so that an equal request measures the histogram again
        }
        const bool is_up_to_date =
            !wants_histograms && !state.companions.reference && has_close_estimate(chart, pane.snapshot.get());
        if (!job.running() && !is_up_to_date)
            ask(job, pane, state.companions.reference, wants_histograms, wake);
        state.charts.histograms_due |= wants_histograms && job.running() && !chart.histogram;
    }
}

void ChartJob::ask(Job& job, const PaneState& pane, const std::shared_ptr<const Reference>& reference,
                   bool wants_histogram, const std::function<void()>& wake) {
    const std::shared_ptr<const void> source = complete_picture(pane);
    if (!source)
        return;
    const Snapshot& s = *pane.snapshot;
    Request request{source, reference, wants_histogram, s.generation, s.settings.method, raw_samples()};
    if (reference)
        request.reconstruction = applied(s.reconstructed_with, has_gradients(s.settings.method));
    job.ask(
        request,
        [request, snapshot = pane.snapshot](std::stop_token) {
            lower_priority();
            return measure(*snapshot, request);
        },
        wake);
}

void ChartJob::add_shifts(const PaneState& pane, PaneChart& chart) {
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

ChartJob::Measured ChartJob::measure(const Snapshot& s, const Request& request) {
    Measured measured;
    RgbImage scratch;
    const RgbImage& image = picture(s, Buffer::reconstruction, scratch);
    if (request.wants_histogram)
        measured.histogram = std::make_shared<const Histogram>(histogram_of(image));
    if (!request.reference) {
        if (const auto error = estimate_sample_error(*s.images, image))
            measured.point = ErrorPoint{s.spp, s.seconds, error->relative_mse, error->standard_error, 0};
        return measured;
    }
    const auto error = error_to(*request.reference, image);
    const bool is_reconstructed = request.source == s.reconstruction;
    if (error)
        measured.point = ErrorPoint{is_reconstructed ? s.reconstruction_spp : s.spp,
                                    is_reconstructed ? s.reconstruction_seconds : s.seconds, error->relative_mse,
                                    error->standard_error, error->not_finite};
    return measured;
}

/// Adds the point to the curve of its method and reconstruction, and moves that curve to the end.
void ChartJob::add_point(std::vector<ErrorCurve>& curves, const Request& request, const ErrorPoint& point) {
    const auto curve = std::find_if(curves.begin(), curves.end(), [&](const ErrorCurve& c) {
        return c.method == request.method && c.reconstruction == request.reconstruction;
    });
    if (curve != curves.end()) {
        std::rotate(curve, curve + 1, curves.end());
    } else {
        // A curve of one point is replaced if only alpha differs, because dragging its slider makes many of them.
        if (!curves.empty() && curves.back().points().size() == 1 &&
            curves.back().reconstruction.norm == request.reconstruction.norm)
            curves.pop_back();
        curves.push_back({request.method, request.reconstruction, {}});
    }
    curves.back().history.add(point);
}

void ChartJob::take(ViewerState& state, std::size_t slot) {
    Job& job = jobs_[slot];
    const auto outcome = job.take();
    const PaneState* pane = state.pane_in(static_cast<int>(slot));
    if (!pane) { // the pane has been closed
        state.charts[slot] = {};
        return job.cancel();
    }
    if (!outcome)
        return;
    state.wishes.redraw = true;
    if (!outcome->result)
        return state.add_message(Message::Kind::error,
                                 "The data of the charts could not be measured: " + outcome->error);
    const Request& request = outcome->request;
    if (pane->generation != request.generation)
        return; // the pane shows another request
    PaneChart& chart = state.charts.of(*pane);
    if (chart.generation != request.generation || chart.reference != request.reference)
        chart.curves.clear();
    chart.generation = request.generation;
    chart.reference = request.reference;
    if (outcome->result->point)
        add_point(chart.curves, request, *outcome->result->point);
    if (outcome->result->histogram) {
        chart.histogram = outcome->result->histogram;
        chart.histogram_generation = request.generation;
    }
}

} // namespace tessera
