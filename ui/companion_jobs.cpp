#include "ui/companion_jobs.h"

#include "render/load/exr.h"
#include "render/session/thread_priority.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace tessera {

namespace {

std::shared_ptr<const Reference> load_reference(const std::filesystem::path& file) {
    const ExrFile exr = read_exr(file);
    auto reference = std::make_shared<Reference>();
    reference->name = file.string();
    reference->image = require_layer(exr, "", file);
    double sum = 0;
    for (const Rgb& pixel : reference->image)
        sum += is_finite(pixel) ? static_cast<double>(luminance(pixel)) : 0;
    reference->mean =
        static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(reference->image.size(), 1)));
    return reference;
}

bool wants_first_hits(const ViewerState& state) {
    return std::any_of(state.panes.begin(), state.panes.end(), [](const PaneState& pane) {
        return family(pane.settings.buffer) == BufferFamily::first_hit;
    });
}

} // namespace

void CompanionJobs::update(ViewerState& state, const std::function<void()>& wake) {
    update_reference(state, wake);
    update_first_hits(state, wake);
}

void CompanionJobs::update_reference(ViewerState& state, const std::function<void()>& wake) {
    if (const std::string file = std::exchange(state.reference_file, {}); !file.empty())
        reference_.start([file](std::stop_token) { return load_reference(file); }, wake);
    const auto outcome = reference_.poll();
    if (!outcome)
        return;
    if (!outcome->result) {
        state.add_message(Message::Kind::error, outcome->error);
        return;
    }
    state.companions.reference = *outcome->result;
    state.add_message(Message::Kind::note, "The reference is now " + state.companions.reference->name);
}

/// A trace is not given up when the camera moves on: a picture somewhat late is better than none.
void CompanionJobs::update_first_hits(ViewerState& state, const std::function<void()>& wake) {
    if (const auto outcome = first_hits_.poll(); outcome && outcome->result)
        state.companions.first_hits = *outcome->result;
    const View view{state.scene, state.camera.camera(), state.request_size()};
    if (!state.scene || first_hits_.running() || view == traced_ || !wants_first_hits(state))
        return;
    traced_ = view;
    first_hits_.start(
        [view](std::stop_token stop) {
            work_in_background();
            return std::make_shared<const FirstHits>(trace_first_hits(*view.scene, view.camera, view.size, stop));
        },
        wake);
}

} // namespace tessera
