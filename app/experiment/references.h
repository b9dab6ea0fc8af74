#pragma once

#include "render/run/reference_render.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace tessera {

/// Renders a reference to `output` (ReferenceRender) and shows its progress on the terminal. Returns empty if
/// Ctrl-C interrupted it (InterruptGuard), after a last checkpoint. Throws as ReferenceRender does.
std::optional<ReferenceImage> render_reference(const std::filesystem::path& output, const SceneSource& source,
                                               const std::shared_ptr<const Scene>& scene,
                                               const ReferenceRecipe& recipe, ThreadPool& pool);

/// Renders the recipe's shard of a reference and writes the file that merge_shards reads. Returns false if Ctrl-C
/// interrupted it.
bool render_shard(const std::filesystem::path& output, const SceneSource& source,
                  const std::shared_ptr<const Scene>& scene, const ReferenceRecipe& recipe, ThreadPool& pool);

/// A reference in a folder of references, of one scene, size and depth.
class FolderReference {
public:
    /// Reads the file reference_file() if it exists. Throws BadInput for a picture of another size, and
    /// std::runtime_error for a file that is not a reference.
    FolderReference(const std::filesystem::path& folder, const std::string& scene_name, ReferenceRecipe recipe);

    bool is_complete() const { return image_.has_value(); }
    /// Reads the file if another process has made it since, and returns is_complete(). Throws as the constructor.
    bool look();
    /// Creates the folder. Throws std::runtime_error if the reference cannot be written.
    void check_writable() const;
    /// Renders the reference, from a checkpoint if there is one. Returns false if Ctrl-C interrupted it.
    bool render(const SceneSource& source, const std::shared_ptr<const Scene>& scene, ThreadPool& pool);
    /// Throws BadInput if the reference is complete and of another scene. Prints a note for a reference without
    /// scene checksums, and accepts it.
    void check_scene(const SceneSource& source, const Scene& scene) const;

    const ReferenceImage& image() const { return *image_; } ///< must be complete
    std::uint32_t checksum() const { return checksum_; }    ///< of the pixels; must be complete
    std::array<std::uint64_t, 2> seeds() const;             ///< of the halves, also if not rendered yet
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    ReferenceRecipe recipe_;
    std::optional<ReferenceImage> image_;
    std::uint32_t checksum_ = 0;
};

} // namespace tessera
