#pragma once

#include "render/run/reference_render.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace tessera {

/// Renders a reference to `output` (see ReferenceRender), telling on the terminal how far it is. Empty: Ctrl-C
/// ended it (see InterruptGuard), after a last checkpoint. Throws as ReferenceRender does.
std::optional<ReferenceImage> render_reference(const std::filesystem::path& output, const SceneSource& source,
                                               const std::shared_ptr<const Scene>& scene,
                                               const ReferenceRecipe& recipe, ThreadPool& pool);

/// A reference in a folder of many: of one scene, in one size and to one depth.
class FolderReference {
public:
    /// Reads the file reference_file() if it is there. Throws BadInput for a picture of another size,
    /// std::runtime_error for a file that is no reference.
    FolderReference(const std::filesystem::path& folder, const std::string& scene_name, ReferenceRecipe recipe);

    bool is_complete() const { return image_.has_value(); }
    /// Makes the folder. Throws std::runtime_error where the reference cannot be written.
    void check_writable() const;
    /// Renders it if it is missing. Throws BadInput for one of another scene; one that does not say which it is of
    /// is taken, with a note. False: Ctrl-C ended it.
    bool make(const SceneSource& source, const std::shared_ptr<const Scene>& scene, ThreadPool& pool);

    const ReferenceImage& image() const { return *image_; } ///< once it is complete
    std::array<std::uint64_t, 2> seeds() const;             ///< those it has, or will have
    const std::filesystem::path& path() const { return path_; }

private:
    void check_scene(const SceneSource& source, const Scene& scene) const;

    std::filesystem::path path_;
    ReferenceRecipe recipe_;
    std::optional<ReferenceImage> image_;
};

} // namespace tessera
