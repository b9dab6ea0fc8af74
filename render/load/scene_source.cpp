#include "render/load/scene_source.h"

#include <cctype>
#include <stdexcept>

namespace tessera {

namespace {

/// Replaces characters that could have a meaning in a file name, as a value may be a path.
std::string file_name_part(const std::string& text) {
    std::string part = text;
    for (char& c : part)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-')
            c = '_';
    return part;
}

} // namespace

std::string to_string(const SceneSource& source) {
    return source.file.empty() ? "the built-in Cornell box" : source.file.string();
}

std::string scene_name(const SceneSource& source) {
    if (source.file.empty())
        return "cornell-box";
    const std::string stem = source.file.stem().string();
    const std::string folder =
        std::filesystem::absolute(source.file).lexically_normal().parent_path().filename().string();
    std::string name = stem.rfind("scene", 0) == 0 && !folder.empty() ? folder : stem;
    for (const auto& [variable, value] : source.variables)
        name += "-" + file_name_part(value);
    return name;
}

void LoadProgress::begin(Stage stage, int total) {
    throw_if_cancelled();
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

void LoadProgress::throw_if_cancelled() const {
    if (given_up())
        throw std::runtime_error("loading was cancelled");
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
