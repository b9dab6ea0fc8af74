#pragma once

#include "app/scene_source.h"
#include "recon/image.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include <glm/vec2.hpp>

namespace tessera {

/// Where references lie, and how they are made.
struct ReferenceOptions {
    std::filesystem::path folder;
    glm::ivec2 size; ///< pixels
    int spp;         ///< of those that are made
};

/// The seeds of the two references of a scene: no picture to compare with them may have one of these.
inline constexpr std::array<std::uint64_t, 2> reference_seeds = {1001, 1002};

/// Two independent references of a scene, kept as SCENE-WxH-dDEPTH-1.exr and -2.exr.
class ReferencePair {
public:
    /// Reads those that exist. Throws BadInput for another size, std::runtime_error for files that cannot be read.
    ReferencePair(const ReferenceOptions& options, const std::string& scene_name, int max_depth);

    bool is_complete() const { return images_[0] && images_[1]; }
    /// Makes the folder. Throws BadInput where the missing ones cannot be written.
    void check_writable() const;
    /// Renders the missing ones, by G-PR with tiles of 8 and L2, and writes them. False: Ctrl-C ended it.
    bool make_missing(const SceneSource& source, const std::shared_ptr<const Scene>& scene, ThreadPool& pool);

    /// One of the two (0, 1), once complete.
    const RgbImage& operator[](std::size_t i) const { return *images_[i]; }

private:
    bool make(std::size_t i, const SceneSource& source, const std::shared_ptr<const Scene>& scene,
              ThreadPool& pool);

    ReferenceOptions options_;
    int max_depth_;
    std::array<std::filesystem::path, 2> paths_;
    std::array<std::optional<RgbImage>, 2> images_;
};

} // namespace tessera
