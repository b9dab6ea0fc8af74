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

/// Does the same with the recipe's share of one, of which it writes the file that merge_shares reads. False:
/// Ctrl-C ended it.
bool render_share(const std::filesystem::path& output, const SceneSource& source,
                  const std::shared_ptr<const Scene>& scene, const ReferenceRecipe& recipe, ThreadPool& pool);

/// A reference in a folder of many: of one scene, in one size and to one depth.
class FolderReference {
public:
    /// Reads the file reference_file() if it is there. Throws BadInput for a picture of another size,
    /// std::runtime_error for a file that is no reference.
    FolderReference(const std::filesystem::path& folder, const std::string& scene_name, ReferenceRecipe recipe);

    bool is_complete() const { return image_.has_value(); }
    /// Whether it is complete by now: another process may have made it. Throws as the constructor does.
    bool look();
    /// Makes the folder. Throws std::runtime_error where the reference cannot be written.
    void check_writable() const;
    /// Renders it, and takes up what another has left of it. False: Ctrl-C ended it.
    bool render(const SceneSource& source, const std::shared_ptr<const Scene>& scene, ThreadPool& pool);
    /// Throws BadInput where it is complete and shows another scene; one that does not say what it shows is taken,
    /// with a note.
    void check_scene(const SceneSource& source, const Scene& scene) const;

    const ReferenceImage& image() const { return *image_; } ///< once it is complete
    std::uint32_t checksum() const { return checksum_; }    ///< of its pixels, once it is complete
    std::array<std::uint64_t, 2> seeds() const;             ///< those it has, or will have
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    ReferenceRecipe recipe_;
    std::optional<ReferenceImage> image_;
    std::uint32_t checksum_ = 0;
};

} // namespace tessera
