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
constexpr std::chrono::milliseconds between_news(100);

std::shared_ptr<const Reference> load_reference(const std::filesystem::path& file, const ReadWatch& watch) {
    const ExrFile exr = read_exr(file, watch, {"", half_names[0], half_names[1]});
    std::array<RgbImage, 2> halves;
    for (std::size_t i = 0; i < halves.size(); ++i)
        if (const RgbImage* half = find_layer(exr, half_names[i]))
            halves[i] = *half;
    return make_reference(file.string(), require_layer(exr, "", file), std::move(halves), scene_of(exr));
}

/// The file by its full name: saved settings have it, and may be read from another folder.
std::string in_full(const std::string& file) {
    std::error_code gone; // the current folder
    const std::filesystem::path path = std::filesystem::absolute(file, gone);
    return file.empty() || gone ? file : path.lexically_normal().string();
}

constexpr int coarse_divisor = 4; // the first look has a sixteenth of the pixels

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
            work_in_background();
            return load_reference(reading.file, [&, told = Clock::now()](float now) mutable {
                *reading.share = now;
                if (wake && Clock::now() - told > between_news) {
                    told = Clock::now();
                    wake();
                }
                return !stop.stop_requested();
            });
        },
        wake);
}

void CompanionJobs::update_reference(ViewerState& state, const std::function<void()>& wake) {
    if (std::exchange(state.wishes.cancel_reference, false) && reference_.running()) {
        state.add_message(Message::Kind::note, "Reading " + reference_.asked()->file + " was given up.");
        reference_.cancel();
    }
    // Before the next one starts: that can be given up for a frame at least.
    const auto outcome = reference_.take();
    if (std::string file = in_full(std::exchange(state.wishes.open_reference, {})); !file.empty())
        read_reference(std::move(file), wake);
    state.reference_read = reference_.running() ? std::optional(reference_.asked()->share->load()) : std::nullopt;
    if (!outcome)
        return;
    if (!outcome->result) {
        state.add_message(Message::Kind::error, outcome->error);
        return;
    }
    state.companions.reference = *outcome->result;
    state.add_message(Message::Kind::note, "The reference is now " + short_path(state.companions.reference->name));
}

/// Checks once for each reference and scene, as either may come first; the camera is the one that it is seen with
/// then.
void CompanionJobs::check_reference(ViewerState& state, const std::function<void()>& wake) {
    const auto& reference = state.companions.reference;
    const Check now{reference, state.scene};
    const auto outcome = check_.take();
    if (outcome && outcome->request == now && outcome->result && !outcome->result->empty())
        state.add_message(Message::Kind::error,
                          fmt::format("The reference shows something else than the panes, in its {}: errors to it "
                                      "mean little. It is {}",
                                      *outcome->result, short_path(reference->name)),
                          Message::Origin::scene);
    if (!reference || !reference->scene || !state.scene)
        return;
    check_.ask(
        now,
        [reference, scene = state.scene, camera = state.camera.camera()](std::stop_token) {
            work_in_background();
            return difference(*reference->scene, checksums_of(scene->description(), camera));
        },
        wake);
}

/// What the panes show.
CompanionJobs::View CompanionJobs::view_of(const ViewerState& state) {
    return {state.scene, state.camera.camera(), state.request_size(), wants_footprints(state)};
}

/// Whether the view is what the panes show, at whatever fraction of the size it was traced.
bool CompanionJobs::is_of(const std::optional<View>& view, const ViewerState& state) {
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
            state.add_message(Message::Kind::error, "What is seen first: " + outcome->error);
        else if (outcome->request.scene == scene) {
            companions.first_hits = *outcome->result;
            hit_ = outcome->request;
            state.wishes.redraw = true;
        }
    }
    if (!hit_ || hit_->scene != scene) // of a camera moved on they may stay for the moment
        companions.first_hits = nullptr;
    companions.first_hits_are_earlier = companions.first_hits && !is_of(hit_, state);
}

/// A look at a fraction of the size first, which is not given up when the camera moves on: a picture somewhat late
/// is better than none. What failed is not tried again before the view is another.
void CompanionJobs::update_first_hits(ViewerState& state, const std::function<void()>& wake) {
    take_first_hits(state);
    const bool is_asked = is_of(first_hits_.asked(), state);
    const bool is_under_way = first_hits_.running() && (is_asked || first_hits_.asked()->divisor > 1);
    if (!state.scene || is_under_way || !wants_first_hits(state))
        return;
    View view = view_of(state);
    view.divisor = is_asked ? 1 : coarse_divisor;
    first_hits_.ask(
        view,
        [scene = state.scene, view](std::stop_token stop) {
            work_in_background();
            const glm::ivec2 size = (view.size + view.divisor - 1) / view.divisor;
            return std::make_shared<const FirstHits>(
                trace_first_hits(*scene, view.camera, size, view.with_footprints, stop));
        },
        wake);
}

} // namespace tessera
