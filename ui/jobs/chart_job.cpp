#include "recon/metrics/sample_error.h"
#include "render/run/thread_pool.h"
#include "render/settings/settings_table.h"
#include "ui/jobs/jobs.h"
#include "ui/state/companions.h"

#include <algorithm>

namespace tessera {

namespace {

/// Returns the settings under which the error of a pane is estimated without a reference: raw samples.
ReconstructionSettings samples_alone() {
    ReconstructionSettings settings;
    settings.norm = Norm::none;
    return settings;
}

/// The picture on show at the end, if it is one: not the primal that stands in for a reconstruction under way.
std::shared_ptr<const void> final_source(const PaneState& pane) {
    const Snapshot* s = pane.snapshot.get();
    if (!s || s->coarse() || s->generation != pane.generation)
        return nullptr;
    std::shared_ptr<const void> source = picture_source(*s, Buffer::reconstruction);
    return source == s->reconstruction ? source : nullptr;
}

/// Whether the newest estimate has nearly as many samples: another one would tell nothing new, and takes time from
/// the render.
bool is_close(const PaneChart& chart, const Snapshot* s) {
    constexpr double least_step = 1.04;
    return s && chart.generation == s->generation && !chart.reference && !chart.curves.empty() &&
           s->spp < least_step * chart.curves.back().points().back().spp;
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
        // It is another picture's, or will be: passes go on while nobody looks.
        if (chart.histogram && !(wants_histograms && chart.histogram_generation == pane.generation)) {
            chart.histogram = nullptr;
            if (!job.running())
                job.cancel(); // asked again, it is to be measured again
        }
        const bool is_told =
            !wants_histograms && !state.companions.reference && is_close(chart, pane.snapshot.get());
        if (!job.running() && !is_told)
            ask(job, pane, state.companions.reference, wants_histograms, wake);
        state.charts.histograms_due |= wants_histograms && job.running() && !chart.histogram;
    }
}

void ChartJob::ask(Job& job, const PaneState& pane, const std::shared_ptr<const Reference>& reference,
                   bool wants_histogram, const std::function<void()>& wake) {
    const std::shared_ptr<const void> source = final_source(pane);
    if (!source)
        return;
    const Snapshot& s = *pane.snapshot;
    Request request{source, reference, wants_histogram, s.generation, s.settings.method, samples_alone()};
    if (reference)
        request.reconstruction = applied(s.reconstructed_with, has_gradients(s.settings.method));
    job.ask(
        request,
        [request, snapshot = pane.snapshot](std::stop_token) {
            work_in_background();
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
    const bool reconstructed = request.source == s.reconstruction;
    if (error)
        measured.point = ErrorPoint{reconstructed ? s.reconstruction_spp : s.spp,
                                    reconstructed ? s.reconstruction_seconds : s.seconds, error->relative_mse,
                                    error->standard_error, error->not_finite};
    return measured;
}

/// Adds the point to the line of pictures made in the same way, which becomes the last line.
void ChartJob::add_point(std::vector<ErrorCurve>& curves, const Request& request, const ErrorPoint& point) {
    const auto same = std::find_if(curves.begin(), curves.end(), [&](const ErrorCurve& c) {
        return c.method == request.method && c.reconstruction == request.reconstruction;
    });
    if (same != curves.end()) {
        std::rotate(same, same + 1, curves.end());
    } else {
        // A slider of alpha passes by many that nobody is after.
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
    if (!pane) { // it was taken away
        state.charts[slot] = {};
        return job.cancel();
    }
    if (!outcome)
        return;
    state.wishes.redraw = true;
    if (!outcome->result)
        return state.add_message(Message::Kind::error, "What charts show was not measured: " + outcome->error);
    const Request& request = outcome->request;
    if (pane->generation != request.generation)
        return; // the pane shows something else by now
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
