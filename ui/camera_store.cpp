#include "ui/camera_store.h"

#include "render/load/camera_file.h"

#include <exception>
#include <string>

namespace tessera {

std::filesystem::path store_camera(const std::filesystem::path& scene_file, const Camera& camera) {
    namespace fs = std::filesystem;
    const std::string stem = scene_file.empty() ? "tessera" : scene_file.stem().string();
    const fs::path name = stem + "-camera.json";
    const fs::path here = fs::current_path() / name;
    if (!scene_file.empty()) {
        const fs::path beside = fs::absolute(scene_file).parent_path() / name;
        try {
            write_camera(beside, camera);
            return beside;
        } catch (const std::exception&) {
            if (beside == here)
                throw; // there is no second place
        }
    }
    write_camera(here, camera);
    return here;
}

} // namespace tessera
