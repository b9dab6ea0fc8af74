#include "ui/viewer/overlays.h"

#include "ui/charts/charts.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include <glm/vec2.hpp>

namespace tessera {

void Overlays::follow_jobs(ViewerState& state, const ViewerOptions& options) {
    const std::filesystem::path folder = std::exchange(state.wishes.follow_jobs, {});
    if (folder.empty() || !options.read_jobs)
        return;
    std::error_code failed; // there is no current folder: the name stays as given
    const std::filesystem::path absolute = std::filesystem::absolute(folder, failed).lexically_normal();
    follower_.follow(failed ? folder : absolute, options.read_jobs(folder), options.wake);
    state.layout.show_jobs = true;
}

void Overlays::draw(const ScreenRect& pictures, Controls& controls, ViewerState& state,
                    const ViewerOptions& options, const SceneLoad& load, int thumbnails_stored) {
    if (state.layout.large_charts)
        draw_large_charts(pictures, controls, state);
    const glm::vec2 screen(state.layout.window_size);
    if (state.layout.show_jobs)
        jobs_panel_.draw(pictures, controls, state, follower_.view());
    if (state.reference_making.show)
        draw_reference_dialog(screen, controls, state);
    if (state.layout.sample_form.show)
        draw_sample_dialog(screen, controls, state);
    if (state.layout.show_help)
        help_.draw(screen, controls, state);
    if (load.running())
        draw_loading(pictures, controls, state, load.origin().name, load.progress(), load.seconds());
    else if (!state.scene && !state.scene_info.problem.text.empty())
        draw_no_scene(pictures, controls, state);
    if (state.layout.show_gallery)
        gallery_.draw(pictures, controls, state,
                      {options.gallery, options.preferences, thumbnails_stored, options.wake});
    palette_.draw(screen, controls, state);
    draw_toast(pictures, controls, state);
    file_dialog_.draw(screen, controls, state); // last, because a modal window must be the topmost
}

} // namespace tessera
