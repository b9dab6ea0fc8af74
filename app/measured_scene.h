#pragma once

#include "app/point.h"
#include "app/reference_folder.h"

#include <map>
#include <utility>

namespace tessera {

/// A scene to measure on, and the references it needs.
class MeasuredScene {
public:
    /// One reference for each size and depth of the points, in `folder`; those that are missing are made by the
    /// recipe, but for its size and depth. Throws BadInput for a file that is not there, and as FolderReference
    /// does.
    MeasuredScene(SceneSource source, const std::vector<Point>& points, const std::filesystem::path& folder,
                  const ReferenceRecipe& recipe);

    /// scene_name of its source.
    const std::string& name() const { return name_; }
    const SceneSource& source() const { return source_; }

    /// Throws std::runtime_error where a missing reference cannot be written.
    void check_writable() const;
    /// Throws BadInput where one of the seeds first, ..., first + count - 1 is a reference's.
    void check_seeds(std::uint64_t first, int count) const;
    /// Renders what references are missing. False: Ctrl-C ended it.
    bool make_references(const std::shared_ptr<const Scene>& scene, ThreadPool& pool);

    const ReferenceImage& reference(const PictureSettings& settings) const;
    /// In the order of size and depth.
    std::vector<const FolderReference*> references() const;

private:
    using Key = std::array<int, 3>; // width, height, depth
    static Key key_of(const PictureSettings& s) { return {s.size.x, s.size.y, s.render.max_depth}; }

    SceneSource source_;
    std::string name_;
    std::map<Key, FolderReference> references_;
};

/// Throws BadInput where two scenes have one name.
void check_names(const std::vector<MeasuredScene>& scenes);

} // namespace tessera
