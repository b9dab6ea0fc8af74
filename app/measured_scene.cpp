#include "app/measured_scene.h"

#include "app/exit_codes.h"
#include "app/scene_source.h"

#include <fmt/core.h>

namespace tessera {

MeasuredScene::MeasuredScene(SceneSource source, const std::vector<Point>& points,
                             const std::filesystem::path& folder, const ReferenceRecipe& recipe)
    : source_(std::move(source)), name_(scene_name(source_)) {
    check_scene_file(source_.file);
    for (const Point& point : points) {
        const Key key = key_of(point.settings);
        if (references_.count(key))
            continue;
        ReferenceRecipe of_point = recipe;
        of_point.size = point.settings.size;
        of_point.settings.max_depth = point.settings.render.max_depth;
        references_.emplace(key, FolderReference(folder, name_, of_point));
    }
}

void MeasuredScene::check_writable() const {
    for (const auto& [key, reference] : references_)
        reference.check_writable();
}

void MeasuredScene::check_seeds(std::uint64_t first, int count) const {
    for (const auto& [key, reference] : references_)
        for (std::uint64_t seed : reference.seeds())
            if (seed - first < static_cast<std::uint64_t>(count))
                throw BadInput(fmt::format("seed {} is that of {}: errors to it would be too small", seed,
                                           reference.path().string()));
}

bool MeasuredScene::make_references(const std::shared_ptr<const Scene>& scene, ThreadPool& pool) {
    for (auto& [key, reference] : references_)
        if (!reference.make(source_, scene, pool))
            return false;
    return true;
}

const ReferenceImage& MeasuredScene::reference(const PictureSettings& settings) const {
    return references_.at(key_of(settings)).image();
}

std::vector<const FolderReference*> MeasuredScene::references() const {
    std::vector<const FolderReference*> all;
    for (const auto& [key, reference] : references_)
        all.push_back(&reference);
    return all;
}

void check_names(const std::vector<MeasuredScene>& scenes) {
    std::map<std::string, std::filesystem::path> files;
    for (const MeasuredScene& scene : scenes)
        if (const auto [other, is_new] = files.emplace(scene.name(), scene.source().file); !is_new)
            throw BadInput(fmt::format("{} and {} are both named \"{}\"", other->second.string(),
                                       scene.source().file.string(), scene.name()));
}

} // namespace tessera
