#include "render/load/load_progress.h"

#include <stdexcept>

namespace tessera {

void LoadProgress::begin(Stage stage, int total) {
    check_wanted();
    const std::lock_guard lock(mutex_);
    state_ = {stage, 0, total};
}

void LoadProgress::step() {
    const std::lock_guard lock(mutex_);
    ++state_.done;
}

LoadProgress::State LoadProgress::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void LoadProgress::check_wanted() const {
    if (given_up())
        throw std::runtime_error("loading was given up");
}

std::string to_string(const LoadProgress::State& state) {
    std::string text;
    switch (state.stage) {
    case LoadProgress::Stage::xml:
        text = "scene file";
        break;
    case LoadProgress::Stage::files:
        text = "meshes and textures";
        break;
    case LoadProgress::Stage::bvh:
        text = "BVH";
        break;
    }
    if (state.total > 0 && state.stage == LoadProgress::Stage::bvh)
        text += ", " + std::to_string(100 * state.done / state.total) + " %";
    else if (state.total > 0)
        text += ", " + std::to_string(state.done) + " of " + std::to_string(state.total);
    return text;
}

} // namespace tessera
