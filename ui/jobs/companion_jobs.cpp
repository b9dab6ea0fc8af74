#include "render/io/picture_file.h"
#include "render/run/first_hits.h"
#include "render/run/reference_image.h"
#include "render/run/thread_pool.h"
#include "render/scene/scene.h"
#include "ui/jobs/jobs.h"
#include "ui/state/companions.h"
#include "ui/state/file_names.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/core.h>

namespace tessera {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds wake_interval(100); // shortest time between two progress reports

/// Reads the picture of a file of any format, and the halves of a reference.
std::shared_ptr<const Reference> load_reference(const std::filesystem::path& file, const ReadProgress& watch) {
    if (!is_exr_file(file))
        return make_reference(file.string(), read_picture(file, {}, watch).image, {}, {});
    ExrFile exr = read_exr(file, watch, {"", half_names[0], half_names[1]});
    std::array<RgbImage, 2> halves;
    for (std::size_t i = 0; i < halves.size(); ++i)
        if (const RgbImage* half = find_layer(exr, half_names[i]))
            halves[i] = *half;
    return make_reference(file.string(), require_layer(exr, "", file), std::move(halves), scene_of(exr));
}

/// Returns the absolute file name, because saved settings contain it and may be read from another folder.
std::string absolute_name(const std::string& file) {
    std::error_code failed; // there is no current folder
    const std::filesystem::path path = std::filesystem::absolute(file, failed);
    return file.empty() || failed ? file : path.lexically_normal().string();
}

constexpr int coarse_divisor = 4; // a preview has 1/16 of the pixels

bool wants_first_hits(const ViewerState& state) {
    return std::any_of(state.panes.begin(), state.panes.end(), [](const PaneState& pane) {
        return family(pane.settings.buffer) == BufferFamily::first_hit;
    });
}

bool wants_footprints(const ViewerState& state) {
    return std::any_of(state.panes.begin(), state.panes.end(),
                       [](const PaneState& pane) { return is_footprint(pane.settings.buffer); });
}

} // namespace

void CompanionJobs::update(ViewerState& state, const std::function<void()>& wake) {
    update_reference(state, wake);
    check_reference(state, wake);
    update_first_hits(state, wake);
}

void CompanionJobs::read_reference(std::string file, const std::function<void()>& wake) {
    const Reading reading{std::move(file), std::make_shared<std::atomic<float>>(0.0f)};
    reference_.start(
        reading,
        [reading, wake](std::stop_token stop) {
            lower_priority();
            return load_reference(reading.file, [&, last_wake = Clock::now()](float fraction) mutable {
                *reading.fraction = fraction;
                if (wake && Clock::now() - last_wake > wake_interval) {
                    last_wake = Clock::now();
                    wake();
                }
                return !stop.stop_requested();
            });
        },
        wake);
}

void CompanionJobs::update_reference(ViewerState& state, const std::function<void()>& wake) {
    if (std::exchange(state.wishes.cancel_reference, false) && reference_.running()) {
        state.add_message(Message::Kind::note, "Reading " + reference_.asked()->file + " was cancelled.");
        reference_.cancel();
    }
    // A new reading starts after take(), so that it can be cancelled for at least one frame.
    const auto outcome = reference_.take();
    if (std::string file = absolute_name(std::exchange(state.wishes.open_reference, {})); !file.empty())
        read_reference(std::move(file), wake);
    state.reference_read =
        reference_.running() ? std::optional(reference_.asked()->fraction->load()) : std::nullopt;
    if (!outcome)
        return;
    if (!outcome->result) {
        state.add_message(Message::Kind::error, outcome->error);
        return;
    }
    state.companions.reference = *outcome->result;
    state.add_message(Message::Kind::note, "Loaded the reference " + short_path(state.companions.reference->name));
}

/// Compares the reference's checksums with the scene and the current camera. Does so once per pair of reference
/// and scene, when both are loaded.
void CompanionJobs::check_reference(ViewerState& state, const std::function<void()>& wake) {
    const auto& reference = state.companions.reference;
    const Check now{reference, state.scene};
    const auto outcome = check_.take();
    if (outcome && outcome->request == now && outcome->result && !outcome->result->empty())
        state.add_message(Message::Kind::error,
                          fmt::format("The reference and the panes differ in their {}, so errors against it mean "
                                      "little. The reference is {}",
                                      *outcome->result, short_path(reference->name)),
                          Message::Origin::scene);
    if (!reference || !reference->scene || !state.scene)
        return;
    check_.ask(
        now,
        [reference, scene = state.scene, camera = state.camera.camera()](std::stop_token) {
            lower_priority();
            return difference(*reference->scene, checksums_of(scene->description(), camera));
        },
        wake);
}

/// Returns the view of the panes at full size.
CompanionJobs::View CompanionJobs::view_of(const ViewerState& state) {
    return {state.scene, state.camera.camera(), state.request_size(), wants_footprints(state)};
}

/// Whether the view equals that of the panes, apart from its divisor.
bool CompanionJobs::is_current(const std::optional<View>& view, const ViewerState& state) {
    if (!view)
        return false;
    View shown = view_of(state);
    shown.divisor = view->divisor;
    return *view == shown;
}

void CompanionJobs::take_first_hits(ViewerState& state) {
    Companions& companions = state.companions;
    const Identity scene(state.scene);
    if (auto outcome = first_hits_.take()) {
        if (!outcome->result)
            state.add_message(Message::Kind::error, "Tracing the first hits has failed: " + outcome->error);
        else if (outcome->request.scene == scene) {
            companions.first_hits = *outcome->result;
            first_hits_view_ = outcome->request;
            state.wishes.redraw = true;
        }
    }
    // First hits of an older camera stay until newer ones replace them.
    if (!first_hits_view_ || first_hits_view_->scene != scene)
        companions.first_hits = nullptr;
    companions.first_hits_are_earlier = companions.first_hits && !is_current(first_hits_view_, state);
}

/// Traces first hits: a preview first, then all pixels. A preview is not cancelled when the camera moves, because
/// a late picture is better than none. A view that has failed is not retried.
void CompanionJobs::update_first_hits(ViewerState& state, const std::function<void()>& wake) {
    take_first_hits(state);
    const bool is_requested = is_current(first_hits_.asked(), state);
    const bool must_wait = first_hits_.running() && (is_requested || first_hits_.asked()->divisor > 1);
    if (!state.scene || must_wait || !wants_first_hits(state))
        return;
    View view = view_of(state);
    view.divisor = is_requested ? 1 : coarse_divisor;
    first_hits_.ask(
        view,
        [scene = state.scene, view](std::stop_token stop) {
            lower_priority();
            const glm::ivec2 size = (view.size + view.divisor - 1) / view.divisor;
            return std::make_shared<const FirstHits>(
                trace_first_hits(*scene, view.camera, size, view.with_footprints, stop));
        },
        wake);
}

} // namespace tessera
