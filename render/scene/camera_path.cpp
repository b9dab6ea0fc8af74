#include "render/scene/camera_path.h"

#include "render/io/files.h"
#include "render/io/json_text.h"
#include "render/io/text.h"

#include <string>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace tessera {

std::vector<Camera> read_camera_path(const std::filesystem::path& file) {
    const std::string content = read_text(file), name = file.string();
    const JsonText text(content, name);
    const nlohmann::ordered_json list = text.parse();
    if (!list.is_array() || list.empty())
        text.fail_at(0, fmt::format("a camera path holds a list [...] of cameras, not {}",
                                    list.is_array() ? "an empty one" : list.type_name()));
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < list.size(); ++i)
        cameras.push_back(parse_camera(text.only(std::to_string(i)), name));
    return cameras;
}

} // namespace tessera
